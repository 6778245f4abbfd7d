// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which meshes are refused, and that the right element is named; what becomes of a mesh that is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>


#include "base/failure.h"
#include "base/thread_pool.h"
#include "mesh/constants.h"
#include "mesh/mesh_check.h"
#include "meshes.h"

namespace meander::test::mesh_check_tests {
namespace {

/// Tries to make a surface and returns the failure; a test failure if there is none.
Failure refusal(const Mesh& mesh) {
  try {
    make_surface(mesh);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.kind, FailureKind::kInvalidMesh);
    EXPECT_GT(std::string(failure.what()).size(), 20u) << "a sentence is wanted";
    return failure;
  }
  ADD_FAILURE() << "the mesh was not refused";
  return Failure(FailureKind::kInternal, "nothing was refused");
}

void expect_refused(const Mesh& mesh, ElementKind kind, uint32_t index = 0) {
  const Failure failure = refusal(mesh);
  EXPECT_EQ(failure.element, kind) << failure.what();
  EXPECT_EQ(failure.index, index) << failure.what();
  if (kind != ElementKind::kNoElement) {
    EXPECT_NE(std::string(failure.what()).find(std::to_string(index)), std::string::npos)
        << failure.what();
  }
}

TEST(Refusal, NoFaces) {
  Mesh m = sphere(0);
  m.faces.clear();
  expect_refused(m, ElementKind::kNoElement);
  expect_refused(Mesh{}, ElementKind::kNoElement);
}

TEST(Refusal, NumbersThatAreNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    for (size_t k = 0; k < 3; ++k) {
      Mesh m = sphere(1);
      m.vertices[3 * 17 + k] = bad;
      m.vertices[3 * 20 + k] = bad;
      expect_refused(m, ElementKind::kVertex, 17);
    }
  }
}

TEST(Refusal, AnIndexOutOfRange) {
  Mesh m = sphere(1);
  m.faces[3 * 11 + 1] = m.vertex_count();
  expect_refused(m, ElementKind::kFace, 11);
  m.faces[3 * 11 + 1] = UINT32_MAX;
  expect_refused(m, ElementKind::kFace, 11);
}

TEST(Refusal, AVertexTwiceInAFace) {
  for (size_t k = 0; k < 3; ++k) {
    Mesh m = sphere(1);
    m.faces[3 * 11 + k] = m.faces[3 * 11 + (k + 1) % 3];
    expect_refused(m, ElementKind::kFace, 11);
  }
}

TEST(Refusal, AFaceWithoutArea) {
  Mesh m = flat_grid(4, 0);
  const uint32_t a = m.add(0, 2, 0), b = m.add(1, 2, 0), c = m.add(3, 2, 0);
  m.face(a, b, c);
  expect_refused(m, ElementKind::kFace, m.face_count() - 1);

  // At any size of the mesh, and for two corners in one place.
  for (const double factor : {1e-6, 1.0, 1e6}) {
    Mesh n = scaled(sphere(1), factor);
    const uint32_t p = n.add(0, 0, 0), q = n.add(0, 0, 0), r = n.add(factor, 0, 0);
    n.face(p, q, r);
    expect_refused(n, ElementKind::kFace, n.face_count() - 1);
  }
}

TEST(Refusal, AllInOnePlace) {
  Mesh m;
  for (int k = 0; k < 3; ++k) m.add(1, 2, 3);
  m.face(0, 1, 2);
  EXPECT_EQ(refusal(m).kind, FailureKind::kInvalidMesh);
}

TEST(Refusal, AnEdgeWithThreeFaces) {
  Mesh m = sphere(1);
  const uint32_t a = m.faces[3 * 9], b = m.faces[3 * 9 + 1];
  m.face(a, b, m.add(3, 3, 3));
  const Failure failure = refusal(m);
  EXPECT_EQ(failure.element, ElementKind::kEdge);
  EXPECT_EQ((std::set{failure.index, failure.index2}), (std::set{a, b}));
}

/// The whole sentence, with the right numbers in it, for the first and another element of each kind.
TEST(Refusal, SaysWhatIsWrongAndWhatToDo) {
  const auto sentence = [](const Mesh& mesh) { return std::string(refusal(mesh).what()); };
  const Mesh good = octahedron();  // 6 vertices, 8 faces
  EXPECT_EQ(sentence(Mesh{}), "The mesh has no faces; give a mesh with at least one triangle.");
  for (const uint32_t f : {0u, 5u}) {
    const std::string face = "Face " + std::to_string(f);
    for (uint32_t k = 0; k < 3; ++k) {
      Mesh m = good;
      m.faces[3 * f + k] = 6;
      EXPECT_EQ(sentence(m),
                face + " refers to vertex 6, but there are only 6 vertices (counted from 0); repair the face list.");
      m = good;
      const uint32_t twice = m.faces[3 * f + (k + 1) % 3];
      m.faces[3 * f + k] = twice;
      EXPECT_EQ(sentence(m), face + " uses vertex " + std::to_string(twice) +
                                 " twice; remove the face or merge its vertices.");
    }
  }
  for (const size_t at : {0, 2, 15}) {
    Mesh m = good;
    m.vertices[at] = std::nan("");
    EXPECT_EQ(sentence(m), "Vertex " + std::to_string(at / 3) +
                               " has a coordinate that is not a finite number; repair or remove it.");
  }
  EXPECT_EQ(sentence(scaled(good, 0)), "All vertices of the mesh are in one place; it has no surface.");
  EXPECT_EQ(sentence(scaled(good, 1.5e308)), "The mesh is too large to measure; scale it down.");
  // More and more faces on an edge between vertices that come first and last; the ones before it are sound.
  for (const uint32_t faces : {3u, 4u, 5u}) {
    Mesh m;
    for (uint32_t k = 0; k < faces + 5; ++k) m.add(k, k * k, k % 3);
    m.face(faces + 2, faces + 3, faces + 4);
    for (uint32_t k = 0; k < faces; ++k) m.face(0, faces + 1, k + 1);
    EXPECT_EQ(sentence(m), "The edge between vertices 0 and " + std::to_string(faces + 1) + " has " +
                               std::to_string(faces) + " faces (1, 2, 3" + (faces > 3 ? ", ..." : "") +
                               "); a surface has at most 2 there: remove the extra ones.");
  }
}

/// By its height over its longest side, whichever that is, as a share of the mesh's size.
TEST(Refusal, AFaceIsFlatByItsHeight) {
  ThreadPool pool(1);
  for (const double size : {1.0, 8.0}) {
    for (const double height : {0.7, 1.4}) {
      for (const double apex : {0.5, 0.125}) {
        for (uint32_t first = 0; first < 3; ++first) {
          Mesh m;
          m.add(0, 0, 0);
          m.add(1, 0, 0);
          m.add(apex, height * size * kFlatFace, 0);
          m.face(first, (first + 1) % 3, (first + 2) % 3);
          // A larger face beside it makes the mesh `size` across.
          if (size > 1) m.face(m.add(0, 1, 0), m.add(size, 1, 0), m.add(0.5 * size, 2, 0));
          const auto check = [&] { return check_mesh(m.vertices, m.faces, pool); };
          if (height > 1.2) {
            EXPECT_NO_THROW(check()) << size << " " << apex << " " << first;
          } else {
            EXPECT_THROW(check(), Failure) << size << " " << apex << " " << first;
          }
        }
      }
    }
  }
}

/// What moves is checked again, and the vertices that no face uses do not count.
TEST(Placement, IsThatOfTheUsedVertices) {
  ThreadPool pool(1);
  Mesh m;
  m.add(99, -99, 50);
  m.add(3, 5, -7);
  m.add(4, 5, -5);
  m.add(3, 8, -7);
  m.add(-40, 60, 70);
  m.face(1, 2, 3);
  const CheckedMesh checked = check_mesh(m.vertices, m.faces, pool);
  const auto expect_box = [](const Placement& p) {
    EXPECT_EQ(p.low, (std::array<double, 3>{3, 5, -7}));
    EXPECT_EQ(p.diagonal, std::sqrt(1.0 + 9 + 4));
  };
  expect_box(checked.placement);
  EXPECT_EQ(checked.used_vertices, 3u);
  expect_box(check_placement(m.vertices, checked.faces, pool));
  const auto refused = [&](const std::vector<double>& vertices) {
    try {
      check_placement(vertices, checked.faces, pool);
    } catch (const Failure& failure) {
      return std::string(failure.what());
    }
    return std::string();
  };
  std::vector<double> moved = m.vertices;
  moved[3] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refused(moved), "Vertex 1 has a coordinate that is not a finite number; repair or remove it.");
  moved = m.vertices;
  for (size_t k = 0; k < 3; ++k) moved[9 + k] = moved[6 + k];
  EXPECT_EQ(refused(moved), "Face 0 has no area (its corners lie on a line); dissolve degenerate faces.");
}

TEST(Refusal, ABowTie) {
  Mesh m;
  m.add(0, 0, 0);
  m.add(1, 0, 0);
  m.add(1, 1, 0);
  m.add(-1, 0, 0);
  m.add(-1, -1, 0);
  m.face(0, 1, 2);
  m.face(0, 3, 4);
  expect_refused(m, ElementKind::kVertex, 0);

  // Two closed surfaces that share a vertex.
  Mesh n = joined(sphere(1), sphere(1), 4);
  const uint32_t shared = 5, other = n.vertex_count() / 2 + 3;
  for (uint32_t& v : n.faces) {
    if (v == other) v = shared;
  }
  expect_refused(n, ElementKind::kVertex, shared);
}

TEST(Refusal, OneSided) {
  for (const uint32_t around : {5u, 12u, 31u}) {
    const Failure failure = refusal(moebius(around));
    EXPECT_EQ(failure.element, ElementKind::kFace);
    EXPECT_LT(failure.index, moebius(around).face_count());
  }
}

/// The number of closed chains that the half-edges without a neighbour form.
uint32_t count_loops(const Surface& s) {
  std::map<uint32_t, uint32_t> next;
  for (const HalfEdge e : s.boundary()) {
    const Triangle& t = s.face(face_of(e));
    EXPECT_TRUE(next.emplace(t[corner_of(e)], t[next_corner(corner_of(e))]).second);
  }
  uint32_t loops = 0;
  while (!next.empty()) {
    ++loops;
    for (auto at = next.begin(); at != next.end();) {
      const uint32_t to = at->second;
      next.erase(at);
      at = next.find(to);
    }
  }
  return loops;
}

struct Expected {
  const char* name;
  Mesh mesh;
  uint32_t components, loops, genus;  // genus: of all components together
};

std::vector<Expected> good_meshes() {
  Mesh loose = sphere(1);
  loose.add(100, 0, 0);  // used by no face
  return {{"sphere", sphere(2), 1, 0, 0},
          {"octahedron", octahedron(), 1, 0, 0},
          {"cube", cube(), 1, 0, 0},
          {"torus", torus(9, 5), 1, 0, 1},
          {"grid", flat_grid(5), 1, 1, 0},
          {"one_face", Mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}}, 1, 1, 0},
          {"grid_with_hole", grid_with_hole(6), 1, 2, 0},
          {"cylinder", cylinder(8, 3, 2), 1, 2, 0},
          {"cone", cone(7, 3, 1), 1, 1, 0},
          {"two_spheres", joined(sphere(1), sphere(1), 4), 2, 0, 0},
          {"torus_and_grid", joined(torus(9, 5), flat_grid(3), 4), 2, 1, 1},
          {"unused_vertex", loose, 1, 0, 0}};
}

TEST(GoodMesh, HasTheTopologyOfItsShape) {
  for (const Expected& m : good_meshes()) {
    SCOPED_TRACE(m.name);
    const Surface s = make_surface(m.mesh);
    EXPECT_EQ(s.component_count(), m.components);
    EXPECT_EQ(s.boundary_loop_count(), m.loops);
    EXPECT_EQ(count_loops(s), m.loops);
    EXPECT_EQ(s.flipped_count(), 0u);
    std::set<uint32_t> used(m.mesh.faces.begin(), m.mesh.faces.end());
    EXPECT_EQ(s.used_vertices(), used.size());
    // Euler: V - E + F = 2 C - 2 g - b.
    int64_t half_edges = 0, twice_inner = 0;
    for (HalfEdge e = 0; e < 3 * s.face_count(); ++e) {
      ++half_edges;
      if (s.twin(e) == kNone) continue;
      ++twice_inner;
      EXPECT_EQ(s.twin(s.twin(e)), e);
      const Triangle &a = s.face(face_of(e)), &b = s.face(face_of(s.twin(e)));
      EXPECT_EQ(a[corner_of(e)], b[next_corner(corner_of(s.twin(e)))]);
      EXPECT_EQ(a[next_corner(corner_of(e))], b[corner_of(s.twin(e))]);
    }
    const int64_t edges = half_edges - twice_inner / 2;
    EXPECT_EQ(static_cast<int64_t>(used.size()) - edges + static_cast<int64_t>(s.face_count()),
              int64_t{2} * m.components - int64_t{2} * m.genus - int64_t{m.loops});
    const bool spheres = m.genus == 0 && m.loops == 0;
    const bool one_disc = m.genus == 0 && m.loops == 1 && m.components == 1;
    EXPECT_EQ(s.simply_connected(), spheres || one_disc);
  }
}

TEST(GoodMesh, FacesAreLaidOutIsometricallyWithUnfoldingTransitions) {
  // Lengths in the plane and in space differ by rounding of numbers of the order of 1.
  constexpr double kRounding = 1e-14;
  for (const Expected& m : good_meshes()) {
    SCOPED_TRACE(m.name);
    const Surface s = make_surface(m.mesh);
    double area = 0;
    for (uint32_t f = 0; f < s.face_count(); ++f) {
      const Triangle& t = s.face(f);
      const Vec3 u = s.position(t[1]) - s.position(t[0]), v = s.position(t[2]) - s.position(t[0]);
      area += 0.5 * u.cross(v).norm();
      for (uint32_t k = 0; k < 3; ++k) {
        const Vec2 side = s.corner(f, next_corner(k)) - s.corner(f, k);
        const Vec3 edge = s.position(t[next_corner(k)]) - s.position(t[k]);
        EXPECT_NEAR((s.to_space(f, side) - edge).norm(), 0, kRounding);
        const HalfEdge e = 3 * f + k, o = s.twin(e);
        if (o == kNone) continue;
        // The edge itself, mapped across, is the same edge seen from the other face.
        const Vec3 carried = s.to_space(face_of(o), side * s.transition(e));
        EXPECT_NEAR((carried - edge).norm(), 0, kRounding);
        EXPECT_NEAR(norm(s.transition(e) * s.transition(o) - Vec2{1, 0}), 0, kRounding);
      }
    }
    EXPECT_NEAR(s.area(), area, kRounding * static_cast<double>(s.face_count()));
  }
}

TEST(GoodMesh, TurnedFacesAreCountedAndOriented) {
  for (const Expected& m : good_meshes()) {
    SCOPED_TRACE(m.name);
    Mesh mesh = m.mesh;
    Rng rng(mesh.face_count());
    std::vector<uint8_t> flipped(mesh.face_count(), 0);
    for (uint32_t f = 0; f < mesh.face_count(); ++f) {
      flipped[f] = rng() < 0.3;
      if (flipped[f]) std::swap(mesh.faces[3 * f + 1], mesh.faces[3 * f + 2]);
    }
    const Surface s = make_surface(mesh);
    // The first face of every component decides.
    std::map<uint32_t, uint8_t> first;
    for (uint32_t f = 0; f < s.face_count(); ++f) first.try_emplace(s.component(f), flipped[f]);
    uint32_t expected = 0;
    for (uint32_t f = 0; f < s.face_count(); ++f) {
      const bool turned = flipped[f] != first[s.component(f)];
      expected += turned;
      EXPECT_EQ(s.flipped(f), turned);
      const bool swapped = s.face(f)[1] == mesh.faces[3 * f + 2];
      EXPECT_EQ(swapped, turned);
      for (uint32_t k = 0; k < 3; ++k) {
        const HalfEdge o = s.twin(3 * f + k);
        if (o != kNone) {
          EXPECT_EQ(s.face(f)[k], s.face(face_of(o))[next_corner(corner_of(o))]);
        }
      }
    }
    EXPECT_EQ(s.flipped_count(), expected);
  }
}

/// A table of all edges finds the same neighbours, and the same boundary loops.
TEST(GoodMesh, NeighboursShareAnEdge) {
  for (const Expected& m : good_meshes()) {
    SCOPED_TRACE(m.name);
    Mesh mesh = m.mesh;
    Rng rng(mesh.face_count() + 1);
    for (uint32_t f = 0; f < mesh.face_count(); ++f) {
      if (rng() < 0.3) std::swap(mesh.faces[3 * f + 1], mesh.faces[3 * f + 2]);
    }
    const Surface s = make_surface(mesh);

    std::map<std::pair<uint32_t, uint32_t>, uint32_t> face_left_of;
    for (uint32_t f = 0; f < s.face_count(); ++f) {
      const Triangle& t = s.face(f);
      for (uint32_t k = 0; k < 3; ++k) ASSERT_TRUE(face_left_of.emplace(std::pair(t[k], t[next_corner(k)]), f).second);
    }
    std::map<uint32_t, uint32_t> boundary_after;
    for (const auto& [edge, f] : face_left_of) {
      const auto beyond = face_left_of.find({edge.second, edge.first});
      const Triangle& t = s.face(f);
      const uint32_t k = static_cast<uint32_t>(std::find(t.begin(), t.end(), edge.first) - t.begin());
      const HalfEdge twin = s.twin(3 * f + k);
      ASSERT_EQ(twin == kNone, beyond == face_left_of.end());
      if (twin == kNone) {
        ASSERT_TRUE(boundary_after.insert(edge).second);
        continue;
      }
      ASSERT_EQ(face_of(twin), beyond->second);
      ASSERT_EQ(s.face(face_of(twin))[corner_of(twin)], edge.second);
    }
    EXPECT_EQ(s.boundary().size(), boundary_after.size());
    for (uint32_t v = 0; v < s.vertex_count(); ++v) EXPECT_EQ(s.on_boundary(v), boundary_after.contains(v));
    uint32_t loops = 0;
    for (; !boundary_after.empty(); ++loops) {
      for (auto at = boundary_after.begin(); at != boundary_after.end();) {
        const uint32_t next = at->second;
        boundary_after.erase(at);
        at = boundary_after.find(next);
      }
    }
    EXPECT_EQ(s.boundary_loop_count(), loops);
  }
}

/// A mesh of more faces than one thread takes at once.
TEST(GoodMesh, IsTheSameForAnyNumberOfThreads) {
  const Mesh mesh = with_noise(grid_with_hole(60), 0.2, 5);
  const Surface one(mesh.vertices, mesh.faces, 1);
  ASSERT_GT(one.face_count(), 2 * 4096u - 2000);
  for (const unsigned threads : {2u, 3u, 0u}) {
    const Surface other(mesh.vertices, mesh.faces, threads);
    EXPECT_EQ(one.area(), other.area());
    EXPECT_EQ(one.mean_edge_length(), other.mean_edge_length());
    EXPECT_EQ(one.boundary(), other.boundary());
    for (uint32_t v = 0; v < one.vertex_count(); ++v) EXPECT_EQ(one.total_angle(v), other.total_angle(v));
    for (HalfEdge e = 0; e < 3 * one.face_count(); ++e) {
      EXPECT_EQ(one.twin(e), other.twin(e));
      EXPECT_EQ(one.along(e).x, other.along(e).x);
      EXPECT_EQ(one.along(e).y, other.along(e).y);
    }
  }
}

/// Components are numbered by their first faces, however their faces are scattered over the list.
TEST(GoodMesh, ComponentsAreWhatAFloodFillFinds) {
  const Mesh tidy = joined(joined(sphere(4), torus(60, 40), 4), flat_grid(30), 8);
  ASSERT_GT(tidy.face_count(), 2 * 4096u);
  Rng rng(79);
  for (const uint32_t reach : {1u, 50u, 20000u}) {
    Mesh mesh = tidy;
    for (uint32_t f = 0; f < mesh.face_count(); ++f) {
      const uint32_t other = std::min(f + rng.below(reach), mesh.face_count() - 1);
      std::swap_ranges(&mesh.faces[3 * f], &mesh.faces[3 * f] + 3, &mesh.faces[3 * other]);
    }
    const Surface one(mesh.vertices, mesh.faces, 1), two(mesh.vertices, mesh.faces, 2);
    std::vector<uint32_t> number(one.face_count(), kNone);
    uint32_t count = 0;
    for (uint32_t first = 0; first < number.size(); ++first) {
      if (number[first] != kNone) continue;
      std::vector<uint32_t> open{first};
      for (number[first] = count; !open.empty();) {
        const uint32_t f = open.back();
        open.pop_back();
        for (HalfEdge e = 3 * f; e < 3 * f + 3; ++e) {
          if (one.twin(e) == kNone || number[face_of(one.twin(e))] != kNone) continue;
          number[face_of(one.twin(e))] = count;
          open.push_back(face_of(one.twin(e)));
        }
      }
      ++count;
    }
    EXPECT_EQ(count, 3u);
    for (const Surface* s : {&one, &two}) {
      EXPECT_EQ(s->component_count(), count);
      for (uint32_t f = 0; f < number.size(); ++f) ASSERT_EQ(s->component(f), number[f]);
    }
  }
}

/// Of several faults of one kind the first is named, whichever thread finds it.
TEST(Refusal, IsOfTheFirstElementForAnyNumberOfThreads) {
  Mesh mesh = flat_grid(120);
  ASSERT_GT(mesh.face_count(), 20000u);
  for (const uint32_t f : {9001u, 17003u, 25005u}) {  // a corner on the opposite edge
    for (int j = 0; j < 3; ++j) {
      mesh.vertices[3 * mesh.faces[3 * f] + j] =
          0.5 * (mesh.vertices[3 * mesh.faces[3 * f + 1] + j] + mesh.vertices[3 * mesh.faces[3 * f + 2] + j]);
    }
  }
  std::set<std::string> sentences;
  for (const unsigned threads : {1u, 2u, 3u, 2u, 3u}) {
    try {
      Surface(mesh.vertices, mesh.faces, threads);
      ADD_FAILURE() << "the mesh was not refused";
    } catch (const Failure& failure) {
      sentences.insert(failure.what());
    }
  }
  EXPECT_EQ(sentences.size(), 1u);
}

TEST(GoodMesh, ScaleChangesNothingInside) {
  for (const Expected& m : good_meshes()) {
    SCOPED_TRACE(m.name);
    const Surface one = make_surface(m.mesh);
    for (const double factor : {1e-3, 1e3, 0.1, 0x1p-20, 12345.678}) {
      const Surface other = make_surface(scaled(m.mesh, factor));
      for (const uint32_t v : m.mesh.faces)
        EXPECT_EQ((one.position(v) - other.position(v)).norm(), 0) << factor;
    }
  }
}

TEST(GoodMesh, AnglesAroundAVertexAddUp) {
  // Nearly exact angles; the vertices are rounded to 2^-30 of the mesh.
  constexpr double kGrid = 1e-7;
  const Surface flat = make_surface(flat_grid(6));
  for (uint32_t v = 0; v < flat.vertex_count(); ++v) {
    if (!flat.on_boundary(v)) {
      EXPECT_NEAR(flat.total_angle(v), 2 * kPi, kGrid);
    }
  }
  const Surface box = make_surface(cube());
  for (uint32_t v = 0; v < 8; ++v) EXPECT_NEAR(box.total_angle(v), 1.5 * kPi, kGrid);
  // Gauss and Bonnet: the missing angles of a closed surface add up to 2 pi times its Euler number.
  for (const auto& [mesh, euler] :
       {std::pair{with_noise(sphere(2), 0.2, 3), 2}, {torus(9, 6), 0}}) {
    const Surface s = make_surface(mesh);
    double missing = 0;
    for (uint32_t v = 0; v < s.vertex_count(); ++v) missing += 2 * kPi - s.total_angle(v);
    EXPECT_NEAR(missing, 2 * kPi * euler, kGrid);
  }
}

}  // namespace
}  // namespace meander::test::mesh_check_tests
