// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces cut along curves, against the surface and the curve themselves.
#include <gtest/gtest.h>

#include <set>

#include "base/disjoint_sets.h"
#include "curve/crossings.h"
#include "geodesic_distance.h"
#include "outputs/cut_mesh.h"
#include "outputs/line_fields.h"
#include "outputs/middle_lines.h"
#include "curves.h"

namespace meander::test::cut_mesh_tests {
namespace {

/// Twice the area of a face, along its normal.
Vec3 span_of(const CutMesh& m, uint32_t f) {
  const auto [a, b, c] = m.corners(f);
  const Vec3 start = m.position(m.from(a));
  return (m.position(m.from(b)) - start).cross(m.position(m.from(c)) - start);
}

/// A closed line in each of several rings and an open one, without crossings; the same for the same seed.
Curve drawn(const Surface& s, uint64_t seed, int rings, double radius) {
  Rng rng(seed);
  ThreadPool pool(1);
  CrossingTest crossings;
  Curve curve;
  for (int k = 0; k < 20 * rings && static_cast<int>(curve.strands.size()) < rings; ++k) {
    Curve next = curve;
    const SurfacePoint centre = random_point(s, rng);
    if (k % 3 == 2) {
      add_walk(s, next, centre, radius, 6, 0.5, rng);
    } else if (!add_ring(s, next, centre, radius, 24, 0.1, rng)) {
      continue;
    }
    if (crossings.find(s, next, pool).empty()) curve = next;
  }
  EXPECT_GE(curve.strands.size(), 2u);
  return curve;
}

/// What holds for every cut surface.
void check(const Surface& s, const Curve& curve, const CutMesh& m) {
  // The same surface: every face keeps its area and its side up, the edges are those of a manifold with the same
  // Euler characteristic, and no triangle has turned over.
  std::vector<double> area(s.face_count(), 0);
  std::set<std::pair<uint32_t, uint32_t>> directed, undirected;
  std::set<uint32_t> used;
  for (uint32_t f = 0; f < m.face_count(); ++f) {
    const uint32_t origin = m.origin(f);
    area[origin] += 0.5 * span_of(m, f).norm();
    EXPECT_GT(span_of(m, f).dot(s.face_normal(origin)), -1e-15);
    for (const HalfEdge h : m.corners(f)) {
      const uint32_t p = m.from(h), q = m.to(h);
      EXPECT_TRUE(directed.insert({p, q}).second) << "an edge is used twice in one direction";
      undirected.insert(std::minmax(p, q));
      used.insert(p);
      EXPECT_EQ(m.face(h), f);
      EXPECT_EQ(m.to(m.opposite(h)), p);
      // Corners are where their weights say.
      const SurfacePoint at{origin, m.at(h)};
      EXPECT_LT((position(s, at) - m.position(p)).norm(), 1e-14);
    }
  }
  for (uint32_t f = 0; f < s.face_count(); ++f) EXPECT_NEAR(area[f], s.face_area(f), 1e-12);
  EXPECT_EQ(used.size(), m.vertex_count());
  std::set<std::pair<uint32_t, uint32_t>> edges;
  std::set<uint32_t> vertices;
  for (uint32_t f = 0; f < s.face_count(); ++f) {
    for (uint32_t k = 0; k < 3; ++k) {
      edges.insert(std::minmax(s.face(f)[k], s.face(f)[next_corner(k)]));
      vertices.insert(s.face(f)[k]);
    }
  }
  EXPECT_EQ(static_cast<int64_t>(used.size()) - static_cast<int64_t>(undirected.size()) +
                static_cast<int64_t>(m.face_count()),
            static_cast<int64_t>(vertices.size()) - static_cast<int64_t>(edges.size()) +
                static_cast<int64_t>(s.face_count()));
  size_t open = 0;
  for (HalfEdge h = 0; h < m.half_edge_count(); ++h) open += m.face(h) == kNone;
  size_t boundary = 0;
  for (const auto& [p, q] : directed) boundary += !directed.contains({q, p});
  EXPECT_EQ(open, boundary);
  // Every piece of the curve is an edge.
  size_t pieces = 0, line_edges = 0;
  for (uint32_t p = 0; p < m.vertex_count(); ++p) {
    if (m.line_point(p) == kNone || m.next_point(m.line_point(p)) == kNone) continue;
    ++line_edges;
    EXPECT_TRUE(undirected.contains(std::minmax(p, m.line_vertex(m.next_point(m.line_point(p))))));
  }
  double length = 0;
  for (const CutMesh::LineStrand& strand : m.strands()) length += strand.length;
  for (uint32_t i = 0; i < curve.size(); ++i) {
    if (curve.has_segment(i)) curve.pieces_of(i, [&](const Piece&) { ++pieces; });
  }
  EXPECT_EQ(pieces, line_edges);
  EXPECT_NEAR(length, curve.length(), 1e-9 * length);
}

size_t regions(const CutMesh& m) {
  DisjointSets sets(m.face_count());
  for (HalfEdge h = 0; h < m.half_edge_count(); ++h) {
    const uint32_t f = m.face(h), beyond = m.face(m.opposite(h));
    if (f != kNone && beyond != kNone && m.line_side(h) == 0) sets.join(f, beyond);
  }
  size_t count = 0;
  for (uint32_t f = 0; f < m.face_count(); ++f) count += sets.find(f) == f;
  return count;
}

/// With middle lines, faces do not reach from one turn of the line to another: along the line their corners are about
/// as far apart as on the surface, but for the few in which several middle lines end.
void check_turns(const CutMesh& m, const LineFields& fields) {
  size_t torn = 0;
  for (uint32_t f = 0; f < m.face_count(); ++f) {
    const FaceLine& line = fields.of_face(f);
    const std::array<HalfEdge, 3> corners = m.corners(f);
    double most = 0, edge = 0;
    for (uint32_t k = 0; k < 3; ++k) {
      most = std::max(most, std::abs(line.along[k] - line.along[next_corner(k)]));
      edge = std::max(edge, m.length(corners[k]));
      EXPECT_GE(line.distance[k], 0);
    }
    torn += most > 4.01 * edge;
    // The two sides of an edge of the line are its left and its right.
    for (const HalfEdge h : corners) {
      if (m.line_side(h) == 0) continue;
      EXPECT_EQ(line.nearest_side, m.line_side(h));
      if (fields.sides_differ(f)) {
        const FaceLine& beyond = fields.of_face(m.face(m.opposite(h)));
        EXPECT_EQ(line.side, -beyond.side);
        EXPECT_NE(line.region, beyond.region);
      }
    }
  }
  EXPECT_LT(static_cast<double>(torn), 0.02 * static_cast<double>(m.face_count()));
}

TEST(CutMesh, IsTheSurfaceWithTheCurveAmongItsEdges) {
  for (const Mesh& mesh : {sphere(2), cube(), octahedron(), flat_grid(6, 0.2), cylinder(7, 3, 2)}) {
    const Surface s = make_surface(mesh);
    for (uint64_t seed = 1; seed <= 4; ++seed) {
      const Curve curve = drawn(s, seed, 5, 0.04 * static_cast<double>(seed));
      for (const double detail : {0.0, 0.05}) {
        CutMesh m(s, curve, detail);
        check(s, curve, m);
        LineDistance distance(m);
        add_middle_lines(m, distance);
        check(s, curve, m);
        const LineFields fields(m, distance);
        EXPECT_EQ(fields.region_count(), regions(m));
        check_turns(m, fields);
      }
    }
  }
}

TEST(CutMesh, RingsPartASphere) {
  const Surface s = make_surface(sphere(2));
  Rng rng(3);
  Curve curve;
  ASSERT_TRUE(add_ring(s, curve, make_point(5, 1, 1, 1), 0.2, 40, 0, rng));
  ASSERT_TRUE(add_ring(s, curve, make_point(5, 1, 1, 1), 0.1, 30, 0, rng));
  EXPECT_EQ(regions(CutMesh(s, curve, 0)), 3u);
}

/// The distance in the plane from the nearest piece of the line.
double by_force(const CutMesh& m, const Vec3& x) {
  double best = 1e300;
  for (const CutMesh::LineStrand& s : m.strands()) {
    for (uint32_t p = s.first; p < s.first + s.count; ++p) {
      const uint32_t q = m.next_point(p);
      if (q == kNone) continue;
      const Vec3 a = m.position(m.line_vertex(p)), u = m.position(m.line_vertex(q)) - a;
      const double t = std::clamp((x - a).dot(u) / u.squaredNorm(), 0.0, 1.0);
      best = std::min(best, (a + t * u - x).norm());
    }
  }
  return best;
}

TEST(LineDistance, IsThatInThePlane) {
  const Surface s = make_surface(flat_grid(8, 0.2));
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    const Curve curve = drawn(s, seed, 3, 0.1);
    for (const double detail : {0.0, 0.02}) {
      CutMesh m(s, curve, detail);
      LineDistance distance(m);
      if (detail > 0) add_middle_lines(m, distance);
      size_t exact = 0;
      for (uint32_t v = 0; v < m.vertex_count(); ++v) {
        const NearestOnLine& n = distance.at(v);
        const double true_distance = by_force(m, m.position(v));
        EXPECT_GE(n.distance, true_distance * (1 - 1e-9) - 1e-15);
        EXPECT_LT(n.distance, true_distance + 0.01);
        exact += n.distance <= true_distance * (1 + 1e-9) + 1e-12;
        if (m.line_point(v) != kNone) {
          EXPECT_EQ(n.distance, 0);
        }
        // It is the distance from the place that is named.
        const uint32_t p = m.point_before(n.strand, n.along);
        const Vec3 a = m.position(m.line_vertex(p)), u = m.position(m.line_vertex(m.next_point(p))) - a;
        const Vec3 place = a + (n.along - m.arc_length(p)) * u.normalized();
        EXPECT_NEAR((place - m.position(v)).norm(), n.distance, 1e-9);
      }
      // Of a thousand vertices a few may have been reached from the wrong turn first.
      EXPECT_GE(static_cast<double>(exact), 0.97 * static_cast<double>(m.vertex_count()));
    }
  }
}

/// Against exact geodesic distances from all points of the line.
TEST(LineDistance, GoesAlongTheSurface) {
  for (const Mesh& mesh : {cube(), sphere(2)}) {
    const Surface s = make_surface(mesh);
    const Curve curve = drawn(s, 2, 4, 0.1);
    const CutMesh m(s, curve, 0.06);
    const LineDistance distance(m);
    GeodesicDistance geodesics(s);
    // Strictly inside of faces, as the reference wants them.
    const auto inside = [&](uint32_t face, Vec2 at) {
      const SurfacePoint p = make_point(face, 1 - at.x - at.y, at.x, at.y);
      return FlatPoint{p.face, flat(s, p)};
    };
    std::vector<GeodesicDistance::Target> line;
    for (HalfEdge h = 0; h < m.half_edge_count(); ++h) {
      if (m.line_side(h) != 1) continue;
      for (int k = 0; k <= 10; ++k) {
        const FlatPoint p = inside(m.origin(m.face(h)), m.at_share(h, 0.1 * k));
        line.push_back({p, position(s, point_at(s, p.face, p.place)), 0, {}, false});
      }
    }
    size_t near = 0, tested = 0;
    for (uint32_t v = 0; v < m.vertex_count(); v += 7) {
      if (m.line_point(v) != kNone) continue;
      for (auto& target : line) {
        target.distance = 10;
        target.reached = false;
      }
      geodesics.measure(inside(m.place(v).face, m.place(v).at), line, true);
      double least = 10;
      for (const auto& target : line) least = std::min(least, target.distance);
      // Where the surface bends slowly distances are straight.
      EXPECT_GT(distance.at(v).distance, 0.98 * least);
      EXPECT_LT(distance.at(v).distance, 1.15 * least);
      near += distance.at(v).distance < 1.02 * least;
      ++tested;
    }
    EXPECT_GT(tested, 20u);
    EXPECT_GT(static_cast<double>(near), 0.8 * static_cast<double>(tested));
  }
}

}  // namespace
}  // namespace meander::test::cut_mesh_tests
