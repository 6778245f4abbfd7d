// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any list of triangles becomes surfaces: an independent check of what comes out of random ones, and which faces stay
// neighbours where more than two share an edge.
#include "mesh/sheets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <map>
#include <set>

#include "base/failure.h"
#include "base/thread_pool.h"
#include "mesh/mesh_faults.h"
#include "mesh/mesh_preparation.h"
#include "meshes.h"

namespace meander::test::sheets_tests {
namespace {

PrepareSettings all_repairs(double weld_distance = 0) {
  PrepareSettings settings;
  settings.drop_degenerate = settings.make_manifold = true;
  settings.weld_distance = weld_distance;
  return settings;
}

size_t count(const std::vector<MeshFault>& faults, FaultKind kind) {
  return static_cast<size_t>(std::ranges::count_if(faults, [&](const MeshFault& f) { return f.kind == kind; }));
}

/// Is every edge one of at most two faces, every vertex in the middle of one fan, and every component orientable? Asked
/// by following edges and nothing else.
void expect_surface(const std::vector<uint32_t>& faces) {
  using Edge = std::pair<uint32_t, uint32_t>;
  std::map<Edge, std::vector<size_t>> at_edge;
  std::map<uint32_t, std::set<size_t>> at_vertex;
  const auto edge = [&](size_t f, size_t k) {
    const uint32_t a = faces[3 * f + k], b = faces[3 * f + (k + 1) % 3];
    return Edge{std::min(a, b), std::max(a, b)};
  };
  for (size_t f = 0; f < faces.size() / 3; ++f) {
    ASSERT_EQ((std::set<uint32_t>{faces[3 * f], faces[3 * f + 1], faces[3 * f + 2]}.size()), 3u);
    for (size_t k = 0; k < 3; ++k) {
      at_edge[edge(f, k)].push_back(f);
      at_vertex[faces[3 * f + k]].insert(f);
    }
  }
  for (const auto& [e, sharing] : at_edge) ASSERT_LE(sharing.size(), 2u);
  for (const auto& [v, around] : at_vertex) {
    std::set<size_t> reached{*around.begin()};
    for (bool grown = true; grown;) {
      grown = false;
      for (const size_t f : around) {
        if (reached.contains(f)) continue;
        for (size_t k = 0; k < 3; ++k) {
          const Edge e = edge(f, k);
          if (e.first != v && e.second != v) continue;
          for (const size_t g : at_edge[e]) grown = grown || (reached.contains(g) && reached.insert(f).second);
        }
      }
    }
    ASSERT_EQ(reached.size(), around.size()) << "bow-tie at " << v;
  }
  std::map<size_t, bool> turned;
  for (size_t start = 0; start < faces.size() / 3; ++start) {
    if (turned.contains(start)) continue;
    turned[start] = false;
    std::vector<size_t> open{start};
    while (!open.empty()) {
      const size_t f = open.back();
      open.pop_back();
      for (size_t k = 0; k < 3; ++k) {
        for (const size_t g : at_edge[edge(f, k)]) {
          if (g == f) continue;
          size_t j = 0;
          while (edge(g, j) != edge(f, k)) ++j;
          const bool same = faces[3 * f + k] == faces[3 * g + j], wanted = turned[f] != same;
          if (turned.contains(g)) {
            ASSERT_EQ(turned[g], wanted) << "one-sided at face " << g;
          } else {
            turned[g] = wanted;
            open.push_back(g);
          }
        }
      }
    }
  }
}

TEST(Sheets, AnyTrianglesBecomeSurfaces) {
  Rng rng(17);
  size_t with_crowded = 0, with_opened = 0, with_ties = 0, with_welds = 0;
  for (int round = 0; round < 400; ++round) {
    Mesh mesh;
    const uint32_t vertices = 6 + rng.below(20), faces = 1 + rng.below(60);
    const bool lattice = rng.below(2) == 0;  // many in one place, on one line, in one plane
    for (uint32_t v = 0; v < vertices; ++v) {
      const auto x = [&] { return lattice ? static_cast<double>(rng.below(3)) : rng(); };
      const double a = x(), b = x(), c = x();
      mesh.add(a, b, c);
    }
    for (uint32_t f = 0; f < faces; ++f) mesh.face(rng.below(vertices), rng.below(vertices), rng.below(vertices));
    PrepareSettings settings = all_repairs(rng.below(2) * 1e-3);
    settings.cut_non_manifold = rng.below(4) == 0;
    PreparedMesh prepared;
    try {
      prepared = prepare_mesh(mesh.vertices, mesh.faces, settings);
    } catch (const Failure& failure) {
      ASSERT_EQ(failure.kind, FailureKind::kInvalidMesh);
      const auto faults = find_faults(mesh.vertices, mesh.faces, 0);  // nothing with an area is left
      ASSERT_EQ(count(faults, FaultKind::kNoArea) + count(faults, FaultKind::kDoubledFace), mesh.face_count());
      continue;
    }
    expect_surface(prepared.faces);
    ThreadPool pool(1);
    EXPECT_NO_THROW(check_mesh(prepared.vertices, prepared.faces, pool));
    with_crowded += prepared.counts.cut_edges > 0;
    with_opened += prepared.counts.opened_edges > 0;
    with_ties += prepared.counts.split_vertices > 0;
    with_welds += prepared.counts.welded_edges > 0;
    // Every corner still lies on the caller's face that it names.
    for (uint32_t f = 0; f < prepared.faces.size() / 3; ++f) {
      const uint32_t* corners = &mesh.faces[3 * prepared.map.face(f)];
      for (size_t k = 0; k < 3; ++k) {
        MeshMap::Weights w{};
        w[k] = 1;
        w = prepared.map.weights(f, w);
        const Vec3 on_face = w[0] * mesh.at(corners[0]) + w[1] * mesh.at(corners[1]) + w[2] * mesh.at(corners[2]);
        const double* x = &prepared.vertices[3 * prepared.faces[3 * f + k]];
        EXPECT_LE((on_face - Vec3(x[0], x[1], x[2])).norm(), 1e-2);
      }
    }
  }
  EXPECT_GT(with_crowded, 50u);
  EXPECT_GT(with_opened, 20u);
  EXPECT_GT(with_ties, 50u);
  EXPECT_GT(with_welds, 20u);
}

/// A floor of two faces and a wall on the edge between them. `turned`: one half of the floor agrees with the wall in
/// how it is wound, and not with the other half.
Mesh floor_and_wall(bool turned) {
  Mesh mesh;
  for (const double x : {-1.0, 0.0, 1.0}) mesh.add(x, x == 0 ? 0 : 1, 0);
  mesh.add(0, 2, 0);
  mesh.add(0, 1, 1);
  if (turned) {
    mesh.face(1, 0, 3);
    mesh.face(1, 3, 4);
  } else {
    mesh.face(1, 3, 0);
    mesh.face(1, 4, 3);
  }
  mesh.face(1, 2, 3);
  return mesh;
}

TEST(Sheets, WhatContinuesStaysJoined) {
  for (const bool turned : {false, true}) {
    const Mesh mesh = floor_and_wall(turned);
    const PreparedMesh prepared = prepare_mesh(mesh.vertices, mesh.faces, all_repairs());
    EXPECT_EQ(prepared.counts.cut_edges, 1u);
    ThreadPool pool(1);
    const CheckedMesh checked = check_mesh(prepared.vertices, prepared.faces, pool);
    EXPECT_EQ(checked.component_count, 2u);
    EXPECT_EQ(checked.component[0], checked.component[turned ? 1 : 2]);
    EXPECT_NE(checked.component[1], checked.component[2]);
  }
}

TEST(Sheets, TwoSolidsThatShareAnEdgeStayTwo) {
  // Two tetrahedra on either side of an edge, all faces outwards.
  Mesh mesh;
  mesh.add(0, 0, 0);
  mesh.add(0, 0, 1);
  for (const double s : {1.0, -1.0}) {
    const uint32_t a = mesh.add(s, 0.3 * s, 0.5), b = mesh.add(0.3 * s, s, 0.5);
    const uint32_t faces[4][3] = {{0, 1, a}, {1, 0, b}, {0, a, b}, {1, b, a}};
    for (const auto& f : faces) mesh.face(f[0], f[1], f[2]);
  }
  const PreparedMesh prepared = prepare_mesh(mesh.vertices, mesh.faces, all_repairs());
  ThreadPool pool(1);
  const CheckedMesh checked = check_mesh(prepared.vertices, prepared.faces, pool);
  EXPECT_EQ(checked.component_count, 2u);
  EXPECT_TRUE(std::ranges::all_of(checked.twin, [](uint32_t e) { return e != kNoTwin; }));
}

TEST(Sheets, WhereAOneSidedPartLiesOnItselfItIsPartedAndNoFaceIsTurned) {
  // A band in the plane that comes back to its first edge from the same side, all faces counter-clockwise.
  Mesh mesh;
  for (const auto& [x, y] :
       {std::pair{0.0, 0.0}, {1, 0}, {0.3, 1}, {0.6, 1.1}, {1.5, 1}, {0.8, 2}, {-0.5, 1.2}, {-1, 2}}) {
    mesh.add(x, y, 0);
  }
  const uint32_t a = 0, b = 1, c = 2, d = 3, e = 4, h = 5, k = 6, p = 7;
  const uint32_t band[8][3] = {{a, b, c}, {c, b, e}, {c, e, h}, {c, h, k}, {k, h, p}, {k, p, a}, {a, d, k}, {a, b, d}};
  for (const uint32_t first : {0u, 3u, 7u}) {  // whichever face is the first
    Mesh turned = mesh;
    for (uint32_t f = 0; f < 8; ++f) {
      const auto& t = band[(first + f) % 8];
      turned.face(t[0], t[1], t[2]);
    }
    const auto faults = find_faults(turned.vertices, turned.faces, 0);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].kind, FaultKind::kOneSided);
    EXPECT_EQ((VertexPair{faults[0].element, faults[0].element2}), (VertexPair{a, b}));
    const PreparedMesh prepared = prepare_mesh(turned.vertices, turned.faces, all_repairs());
    expect_surface(prepared.faces);
    EXPECT_EQ(prepared.counts.opened_edges, 1u);
    ThreadPool pool(1);
    const CheckedMesh checked = check_mesh(prepared.vertices, prepared.faces, pool);
    EXPECT_EQ(checked.component_count, 1u);
    EXPECT_TRUE(std::ranges::none_of(checked.flipped, [](auto flipped) { return flipped != 0; }));
  }
}

TEST(Sheets, FacesOfAnEdgeWithVeryManyAllEndThere) {
  // As a book's pages; in pairs they would need memory with the square of their number.
  Mesh book;
  book.add(0, 0, 0);
  book.add(0, 0, 1);
  constexpr uint32_t kPages = 20000;
  for (uint32_t i = 0; i < kPages; ++i) {
    const double angle = 6.0 * i / kPages;
    book.face(0, 1, book.add(std::cos(angle), std::sin(angle), 0.5));
  }
  const PreparedMesh prepared = prepare_mesh(book.vertices, book.faces, all_repairs());
  EXPECT_EQ(prepared.counts.cut_edges, 1u);
  EXPECT_EQ(prepared.vertices.size(), 9 * kPages);
}

TEST(Seams, AWideDistanceTakesHardlyMoreTimeThanANarrowOne) {
  Mesh soup;
  constexpr uint32_t kSide = 100;
  for (uint32_t i = 0; i < kSide; ++i) {
    for (uint32_t j = 0; j < kSide; ++j) {
      const double x = i, y = j;
      soup.face(soup.add(x, y, 0), soup.add(x + 1, y, 0), soup.add(x + 1, y + 1, 0));
      soup.face(soup.add(x, y, 0), soup.add(x + 1, y + 1, 0), soup.add(x, y + 1, 0));
    }
  }
  const auto seconds = [&](double distance) {
    const std::clock_t begin = std::clock();
    EXPECT_FALSE(find_faults(soup.vertices, soup.faces, distance).empty());
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  };
  // Were all points compared with all others, it would be a hundred times as much.
  EXPECT_LT(seconds(1e9), 0.2 + 5 * seconds(1e-3));
}

TEST(Seams, ASoupBecomesWholeAtEveryScaleAndSheetsInOnePlaceStay) {
  const Mesh whole = sphere(2);
  for (const double scale : {1e-3, 1.0, 1e3}) {
    Mesh soup;
    Rng rng(5);
    for (const uint32_t v : whole.faces) {
      const auto nudged = [&](double x) { return scale * (x + 1e-6 * (rng() - 0.5)); };
      const Vec3 p = whole.at(v);
      const double x = nudged(p.x()), y = nudged(p.y()), z = nudged(p.z());
      soup.add(x, y, z);
      const auto count = soup.vertex_count();
      if (count % 3 == 0) soup.face(count - 3, count - 2, count - 1);
    }
    const PreparedMesh prepared = prepare_mesh(soup.vertices, soup.faces, all_repairs(1e-4 * scale));
    EXPECT_EQ(prepared.faces.size(), whole.faces.size());
    EXPECT_EQ(prepared.vertices.size(), whole.vertices.size());
    EXPECT_EQ(prepared.counts.welded_edges, whole.face_count() * 3 / 2);
    // Whatever the distance, nothing collapses.
    const PreparedMesh wide = prepare_mesh(soup.vertices, soup.faces, all_repairs(10 * scale));
    EXPECT_EQ(wide.faces.size(), whole.faces.size());
  }
  // Two sheets in one place, back to back: neither is lost, and they are not sewn together.
  Mesh sheets;
  for (const uint32_t first : {0u, 4u}) {
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) sheets.add(x, y, 0);
    const bool back = first > 0;
    sheets.face(first, first + (back ? 2 : 1), first + (back ? 1 : 2));
    sheets.face(first, first + (back ? 3 : 2), first + (back ? 2 : 3));
  }
  const PreparedMesh prepared = prepare_mesh(sheets.vertices, sheets.faces, all_repairs(1e-3));
  EXPECT_EQ(prepared.faces, sheets.faces);
  EXPECT_EQ(prepared.counts.welded_edges, 0u);
}

TEST(Faults, AllOfEveryKindAreFound) {
  Mesh mesh = floor_and_wall(false);                            // vertices 0 to 4, edge 1 3
  const uint32_t far = mesh.add(-2, 0, 0), far2 = mesh.add(-2, -1, 0);
  mesh.face(0, far, far2);                                      // a bow-tie at 0
  mesh.face(1, 3, 1);                                           // without area
  mesh.face(2, 3, 1);                                           // the face of the floor again
  const uint32_t lost = mesh.add(std::nan(""), 0, 0);
  mesh.face(lost, 0, 1);
  const uint32_t a = mesh.add(-2, 0, 0), b = mesh.add(-2, -1, 0), c = mesh.add(-3, -0.5, 0);
  mesh.face(b, a, c);                                           // beside far, far2: a seam
  const std::vector<MeshFault> faults = find_faults(mesh.vertices, mesh.faces, 1e-3);
  const auto at = [&](FaultKind kind) {
    std::vector<VertexPair> found;
    for (const MeshFault& f : faults) {
      if (f.kind == kind) found.push_back({f.element, f.element2});
    }
    return found;
  };
  using Found = std::vector<VertexPair>;
  EXPECT_EQ(at(FaultKind::kNotFinite), (Found{{lost, lost}}));
  EXPECT_EQ(at(FaultKind::kNoArea), (Found{{4, 4}}));
  EXPECT_EQ(at(FaultKind::kDoubledFace), (Found{{5, 5}}));
  EXPECT_EQ(at(FaultKind::kCrowdedEdge), (Found{{1, 3}}));
  EXPECT_EQ(at(FaultKind::kBowTie), (Found{{0, 0}}));
  EXPECT_EQ(at(FaultKind::kOneSided), Found{});
  EXPECT_EQ(at(FaultKind::kSeam), (Found{{far, far2}, {a, b}}));
  EXPECT_TRUE(find_faults(sphere(2).vertices, sphere(2).faces, 1e-3).empty());
}

}  // namespace
}  // namespace meander::test::sheets_tests
