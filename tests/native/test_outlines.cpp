// SPDX-License-Identifier: GPL-3.0-or-later
//
// The half-edge copy of a surface, the distance from the boundary on it, and the outlines along its level lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/failure.h"
#include "geodesic/boundary_distance.h"
#include "mesh/refined_surface.h"
#include "seed/outline.h"
#include "meshes.h"

namespace meander::test::outlines_tests {
namespace {

/// Two faces.
Mesh square() {
  Mesh m;
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) m.add(x, y, 0);
  m.face(0, 1, 2);
  m.face(0, 2, 3);
  return m;
}

/// The square of side 2 without its upper right quarter: four faces, and a corner that points inwards.
Mesh angle() {
  Mesh m;
  for (const auto& [x, y] : {std::pair{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}) m.add(x, y, 0);
  for (const uint32_t k : {1u, 2u, 3u, 4u}) m.face(0, k, k + 1);
  return m;
}

/// Every face has three half-edges in a ring, and circulating round the vertices meets each of them once.
void expect_whole(const RefinedSurface& mesh) {
  std::set<HalfEdge> of_faces, of_vertices;
  for (uint32_t f = 0; f < mesh.face_count(); ++f) {
    const auto [a, b, c] = mesh.corners(f);
    EXPECT_EQ(mesh.next(a), b);
    EXPECT_EQ(mesh.next(b), c);
    EXPECT_EQ(mesh.next(c), a);
    EXPECT_EQ(mesh.prev(a), c);
    for (const HalfEdge h : {a, b, c}) {
      EXPECT_EQ(mesh.face(h), f);
      EXPECT_EQ(mesh.to(h), mesh.from(mesh.next(h)));
      EXPECT_EQ(mesh.to(h), mesh.from(RefinedSurface::opposite(h)));
      EXPECT_TRUE(of_faces.insert(h).second);
    }
  }
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    mesh.each_leaving(v, [&](HalfEdge h) {
      EXPECT_EQ(mesh.from(h), v);
      EXPECT_TRUE(of_vertices.insert(h).second);
    });
  }
  EXPECT_EQ(of_vertices, of_faces);
}

double area(const RefinedSurface& mesh) {
  double sum = 0;
  for (uint32_t f = 0; f < mesh.face_count(); ++f) {
    const HalfEdge h = mesh.first(f);
    const Vec3& apex = mesh.position(mesh.to(mesh.next(h)));
    sum += 0.5 * (mesh.position(mesh.from(h)) - apex).cross(mesh.position(mesh.to(h)) - apex).norm();
  }
  return sum;
}

/// Every corner is where its weights say, in the face of the surface that it came from.
void expect_weights(const Surface& s, const RefinedSurface& mesh) {
  for (uint32_t f = 0; f < mesh.face_count(); ++f) {
    for (const HalfEdge h : mesh.corners(f)) {
      const SurfacePoint at{mesh.origin(f), mesh.at(h)};
      EXPECT_LT((position(s, at) - mesh.position(mesh.from(h))).norm(), 1e-14);
    }
  }
}

TEST(RefinedSurface, IsTheSurface) {
  Mesh with_unused = grid(5, 0.2, [](double x, double y) { return Vec3(x, y, x * y); }, no_hole);
  with_unused.add(0.3, 0.4, 0.5);
  for (const Mesh& m : {sphere(1), with_unused, joined(square(), angle(), 3)}) {
    const Surface s = make_surface(m);
    const RefinedSurface mesh(s);
    EXPECT_EQ(mesh.vertex_count(), s.vertex_count());
    EXPECT_EQ(mesh.half_edge_count(), 3 * s.face_count() + s.boundary().size());
    expect_whole(mesh);
    for (uint32_t f = 0; f < s.face_count(); ++f) {
      HalfEdge h = mesh.first(f);
      for (uint32_t k = 0; k < 3; ++k, h = mesh.next(h)) {
        EXPECT_EQ(mesh.from(h), s.face(f)[k]);
        const HalfEdge twin = s.twin(3 * f + k);
        EXPECT_EQ(mesh.face(RefinedSurface::opposite(h)), twin == kNone ? kNone : face_of(twin));
      }
    }
  }
}

TEST(RefinedSurface, KeepsItsShapeWhenEdgesAreSplit) {
  constexpr double kRounding = 1e-12;
  for (const Mesh& m : {square(), angle(), sphere(1)}) {
    const Surface s = make_surface(m);
    RefinedSurface mesh(s);
    const auto euler = [&] {
      return int(mesh.vertex_count()) - int(mesh.half_edge_count() / 2) + int(mesh.face_count());
    };
    const int euler_before = euler();
    Rng rng(5);
    for (int k = 0; k < 300; ++k) {
      const auto h = static_cast<HalfEdge>(rng.below(mesh.half_edge_count()));
      const Vec3 middle = mesh.middle(h);
      const uint32_t v = mesh.add_vertex(middle);
      mesh.split_edge(h, v, 0.5);
      EXPECT_FALSE(mesh.isolated(v));
    }
    expect_weights(s, mesh);
    expect_whole(mesh);
    EXPECT_EQ(euler(), euler_before);
    EXPECT_NEAR(area(mesh), s.area(), kRounding);
  }
}

TEST(RefinedSurface, HasNoPlaceBeyondTheBoundary) {
  const RefinedSurface mesh(make_surface(square()));
  for (HalfEdge h = 0; h < mesh.half_edge_count(); ++h) {
    if (mesh.face(h) != kNone) continue;
    EXPECT_EQ(mesh.at(h).x, 0);
    EXPECT_EQ(mesh.at(h).y, 0);
  }
}

TEST(RefinedSurface, KeepsItsShapeWhenFacesAreSplitAndEdgesFlipped) {
  for (const Mesh& m : {square(), angle(), sphere(1)}) {
    const Surface s = make_surface(m);
    RefinedSurface mesh(s);
    mesh.fix(0);
    Rng rng(6);
    for (int k = 0; k < 100; ++k) {
      const auto f = static_cast<uint32_t>(rng.below(mesh.face_count()));
      const auto [a, b, c] = mesh.corners(f);
      const Vec2 at = (1.0 / 3) * (mesh.at(a) + mesh.at(b) + mesh.at(c));
      const Vec3 x = position(s, SurfacePoint{mesh.origin(f), at});
      mesh.split_face(f, mesh.add_vertex(x), at);
    }
    EXPECT_FALSE(mesh.inside(0));
    size_t flipped = 0;
    for (HalfEdge h = 0; h < mesh.half_edge_count(); ++h) {
      const HalfEdge o = RefinedSurface::opposite(h);
      if (!mesh.inside(h) || orientation(mesh.at(h), mesh.at(mesh.prev(o)), mesh.at(mesh.prev(h))) <= 0 ||
          orientation(mesh.at(o), mesh.at(mesh.prev(h)), mesh.at(mesh.prev(o))) <= 0) {
        continue;
      }
      mesh.flip(h);
      ++flipped;
    }
    EXPECT_GT(flipped, 20u);
    expect_whole(mesh);
    expect_weights(s, mesh);
    EXPECT_NEAR(area(mesh), s.area(), 1e-12);
  }
}

TEST(BoundaryDistance, IsExactAlongStraightBoundaries) {
  constexpr double kRounding = 1e-9;
  const Surface s = make_surface(square());
  const double side = 1 / s.scale();
  const double reach = 0.1 * side;
  const BoundaryDistance d(s, reach, reach / 4, {});
  for (uint32_t v = 0; v < d.mesh().vertex_count(); ++v) {
    const Vec3& p = d.mesh().position(v);
    const double exact = std::min({p.x(), p.y(), side - p.x(), side - p.y()});
    if (exact < reach) {
      EXPECT_NEAR(d.at(v), exact, kRounding * side);
    }
  }
  for (HalfEdge h = 0; h < d.mesh().half_edge_count(); h += 2) {
    const Vec3 m = d.mesh().middle(h);
    if (std::min({m.x(), m.y(), side - m.x(), side - m.y()}) < reach) {
      EXPECT_LE(d.mesh().length(h), reach / 4);
    }
  }
}

TEST(BoundaryDistance, CutsUpAStripWhoseFacesGrowWithItsLength) {
  const Surface s = make_surface(square());
  constexpr double kMostFaces = 200;  // on a stretch of the boundary as long as the distance
  for (const double reach : {0.01, 0.005, 0.0025, 0.001}) {
    const BoundaryDistance d(s, reach, reach / 4, {});
    EXPECT_LT(static_cast<double>(d.mesh().face_count()), kMostFaces * 4 / s.scale() / reach);
  }
}

TEST(Outlines, KeepTheirDistanceRoundACornerThatPointsInwards) {
  const Surface s = make_surface(angle());
  for (const double distance : {0.05, 0.1, 0.2}) {
    const Outlines o = find_outlines(s, distance / s.scale(), 0.5 * distance / s.scale(), {});
    ASSERT_EQ(o.closed, std::vector<uint8_t>{1});
    double sum = 0;
    for (const Vec3& p : o.points) {
      // The upper right quarter is not part of the surface: its corner is the nearest place beyond the walls.
      const double walls = std::min({p.x(), p.y(), 2 - p.x(), 2 - p.y()});
      const double quarter = std::hypot(std::max(0.0, 1 - p.x()), std::max(0.0, 1 - p.y()));
      const double away = std::min(walls, quarter) / distance;
      EXPECT_NEAR(away, 1, 0.05);
      sum += std::abs(away - 1);
    }
    EXPECT_LT(sum / static_cast<double>(o.points.size()), 0.003);
  }
}

/// Where a line of points crosses itself or another one in the plane.
bool cross_each_other(const Outlines& o) {
  std::vector<std::pair<Vec2, Vec2>> pieces;
  for (size_t s = 0; s < o.closed.size(); ++s) {
    const uint32_t first = o.offsets[s], n = o.offsets[s + 1] - first;
    for (uint32_t k = 0; k + (o.closed[s] ? 0 : 1) < n; ++k) {
      const Vec3 &a = o.points[first + k], &b = o.points[first + (k + 1) % n];
      pieces.emplace_back(Vec2{a.x(), a.y()}, Vec2{b.x(), b.y()});
    }
  }
  for (size_t i = 0; i < pieces.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      const auto& [a, b] = pieces[i];
      const auto& [c, d] = pieces[j];
      const auto side = [](Vec2 p, Vec2 q, Vec2 x) { return cross(q - p, x - p); };
      if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return true;
    }
  }
  return false;
}

TEST(Outlines, DoNotCrossAndLieTheSameInEveryScale) {
  const Mesh holed = grid_with_hole(13);
  for (const double distance : {0.02, 0.05, 0.11}) {
    const Surface s = make_surface(holed), large = make_surface(scaled(holed, 1024));
    const Outlines o = find_outlines(s, distance / s.scale(), 0.02 / s.scale(), {});
    EXPECT_EQ(o.closed.size(), 2u);
    EXPECT_FALSE(cross_each_other(o));
    const Outlines other = find_outlines(large, 1024 * distance / large.scale(), 1024 * 0.02 / large.scale(), {});
    ASSERT_EQ(other.points.size(), o.points.size());
    for (size_t k = 0; k < o.points.size(); ++k) EXPECT_EQ(other.points[k], Vec3(1024 * o.points[k]));
  }
}

TEST(Outlines, StopSoonWhenTheyAreCancelled) {
  const Surface s = make_surface(square());
  const double distance = 0.002;
  size_t questions = 0;
  find_outlines(s, distance, 0.5 * distance, [&] { return ++questions, false; });
  // A third of a second on a slow machine; the questions are about evenly spaced.
  EXPECT_GT(questions, 500u);
  for (const double share : {0.0, 0.3, 0.6, 0.9}) {
    const auto last = static_cast<size_t>(share * static_cast<double>(questions));
    size_t asked = 0;
    try {
      find_outlines(s, distance, 0.5 * distance, [&] { return asked++ == last; });
      FAIL() << "not cancelled";
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.kind, FailureKind::kCancelled);
    }
    EXPECT_EQ(asked, last + 1);
  }
}

}  // namespace
}  // namespace meander::test::outlines_tests
