// SPDX-License-Identifier: GPL-3.0-or-later
//
// Straightest geodesics on surfaces that can be unfolded, where they are straight lines.
#include <gtest/gtest.h>

#include "curves.h"

namespace meander::test::geodesic_trace_tests {
namespace {

/// Vertices are rounded to 2^-30 of the mesh, so a flat mesh is flat to within a few times that.
constexpr double kGridRounding = 16 * 0x1p-30;

/// The square of n x n cells folded like an accordion along its lines of equal x; `fold` 0 is flat.
Mesh folded(uint32_t n, double fold) {
  return grid(
      n, 0,
      [=](double x, double y) {
        const double cells = x * n, down = std::abs(std::fmod(cells, 2) - 1) / n;
        return Vec3(x * std::cos(fold), y, down * std::sin(fold));
      },
      no_hole);
}

/// Where a point of the folded square lies in the unfolded one, by the corners of its face.
Vec2 unfolded(const Surface& s, const Mesh& flat, uint32_t face, std::array<double, 3> w) {
  Vec2 p;
  for (uint32_t k = 0; k < 3; ++k) {
    const Vec3 c = flat.at(s.face(face)[k]);
    p = p + w[k] * Vec2{c.x(), c.y()};
  }
  return p;
}

TEST(Trace, IsAStraightLineOnAFoldedSquare) {
  constexpr uint32_t kCells = 12;
  const Mesh flat = folded(kCells, 0);
  for (const double fold : {0.0, 0.7, 1.4}) {
    const Surface s = make_surface(folded(kCells, fold));
    Rng rng(11);
    for (int k = 0; k < 300; ++k) {
      const SurfacePoint start = random_point(s, rng);
      const Vec2 along = rng.direction();
      const Vec2 displacement = rng.in(0, 0.8) * along;  // inside units are the diagonal of the box
      const double wanted = norm(displacement);
      Path path;
      const Trace trace = trace_geodesic(s, start, displacement, path);
      ASSERT_TRUE(chains(s, start.face, trace.end.face, path));
      ASSERT_TRUE(inside_face(s, trace.end));

      // The direction in the unfolded square: that of a short step inside the first face.
      const auto weights = [](const SurfacePoint& p) {
        return std::array{p.weight(0), p.b.x, p.b.y};
      };
      const Vec2 from = unfolded(s, flat, start.face, weights(start));
      const Vec2 c1 = s.corner(start.face, 1), c2 = s.corner(start.face, 2);
      const double w2 = along.y / c2.y, w1 = (along.x - w2 * c2.x) / c1.x;
      const Vec2 direction = unit(unfolded(s, flat, start.face, {-w1 - w2, w1, w2}));
      const Vec2 to = unfolded(s, flat, trace.end.face, weights(trace.end));
      const Vec2 expected = from + trace.length * s.scale() * direction;
      EXPECT_NEAR(norm(to - expected), 0, kGridRounding * (1 + static_cast<double>(path.size())));
      for (const Crossing& c : path) {
        std::array<double, 3> w{0, 0, 0};
        w[corner_of(c.e)] = 1 - c.t;
        w[next_corner(corner_of(c.e))] = c.t;
        EXPECT_NEAR(cross(unfolded(s, flat, face_of(c.e), w) - from, direction), 0,
                    kGridRounding * (1 + static_cast<double>(path.size())));
      }
      if (trace.hit_boundary) {
        EXPECT_LE(trace.length, wanted);
        const double inside = std::min({to.x, to.y, 1 - to.x, 1 - to.y});
        EXPECT_NEAR(inside, 0, kGridRounding);
      } else {
        EXPECT_EQ(trace.length, wanted);
        EXPECT_NEAR(norm(to - from), wanted * s.scale(),
                    kGridRounding * (1 + static_cast<double>(path.size())));
      }
    }
  }
}

/// Clearance and snapping of the crossings move a path by at most this in each face (edges are at
/// most 1).
constexpr double kClearing = 2 * kClearance;

TEST(Trace, HasTheLengthAskedForOnAnySurface) {
  for (const Mesh& mesh :
       {sphere(3), torus(20, 10), cube(), octahedron(), with_noise(sphere(2), 0.3, 5)}) {
    const Surface s = make_surface(mesh);
    Rng rng(12);
    for (int k = 0; k < 200; ++k) {
      const SurfacePoint start = random_point(s, rng);
      const Vec2 displacement = rng.in(0, 2) * rng.direction();
      const double wanted = norm(displacement);
      Path path;
      const Trace trace = trace_geodesic(s, start, displacement, path);
      ASSERT_TRUE(chains(s, start.face, trace.end.face, path));
      EXPECT_FALSE(trace.hit_boundary);
      EXPECT_EQ(trace.length, wanted);
      const PathShape shape = measure_path(s, start, trace.end, path);
      EXPECT_NEAR(shape.length, wanted, kClearing * (1 + static_cast<double>(path.size())));
    }
  }
}

TEST(Trace, ComesBackWhenTurnedRound) {
  // Each face passed may turn the path by rounding, and increases the effect of earlier turns.
  constexpr double kReturn = 1e-9;
  const Surface s = make_surface(bumpy_grid(15));
  Rng rng(13);
  int returned = 0;
  for (int k = 0; k < 300; ++k) {
    const SurfacePoint start = random_point(s, rng);
    Path there, back;
    const Trace trace = trace_geodesic(s, start, 0.3 * rng.direction(), there);
    if (trace.hit_boundary) continue;
    const Trace home = trace_geodesic(s, trace.end, -0.3 * trace.direction, back);
    if (there.size() != back.size()) continue;  // the path passed a vertex within rounding
    ++returned;
    ASSERT_EQ(home.end.face, start.face);
    EXPECT_NEAR(norm(flat(s, home.end) - flat(s, start)), 0, kReturn);
  }
  EXPECT_GT(returned, 0);
}

TEST(Trace, IsAHelixOnACylinder) {
  constexpr uint32_t kSides = 40;
  constexpr double kHeight = 20;
  const Surface s = make_surface(cylinder(kSides, 10, kHeight));
  const double around = kSides * 2 * std::sin(kPi / kSides);  // of the prism
  const SurfacePoint start = make_point(0, 0.4, 0.3, 0.3);
  // Three times around while climbing half the height, in the plane of face 0: its first edge runs
  // around.
  const double climb = 0.5 * kHeight;
  const Vec2 displacement = (1 / s.scale()) * Vec2{3 * around, climb};
  Path path;
  const Trace trace = trace_geodesic(s, start, displacement, path);
  ASSERT_FALSE(trace.hit_boundary);
  const Vec3 from = position(s, start), to = position(s, trace.end);
  const double tolerance = kGridRounding * static_cast<double>(path.size());
  EXPECT_NEAR((to - from - Vec3(0, 0, climb / s.scale())).norm(), 0, tolerance);
  EXPECT_EQ(trace.length, norm(displacement));
}

TEST(Trace, DoesNotDependOnTheMeshesScale) {
  for (const double factor : {0x1p-10, 0x1p7, 1e-3, 1e3}) {
    const Surface a = make_surface(sphere(2)), b = make_surface(scaled(sphere(2), factor));
    Rng rng(14);
    for (int k = 0; k < 50; ++k) {
      const SurfacePoint start = random_point(a, rng);
      const Vec2 displacement = rng.in(0, 1) * rng.direction();
      Path pa, pb;
      const Trace ta = trace_geodesic(a, start, displacement, pa), tb = trace_geodesic(b, start, displacement, pb);
      EXPECT_TRUE(same_bytes(ta.end, tb.end));
      ASSERT_EQ(pa.size(), pb.size());
      for (size_t c = 0; c < pa.size(); ++c) EXPECT_EQ(pa[c].t, pb[c].t);
    }
  }
}

TEST(Trace, TheOtherWayIsThatOfTheOppositeDisplacement) {
  const auto expect_same = [](GeodesicWalk& a, GeodesicWalk& b) {
    while (a.step()) {
      ASSERT_TRUE(b.step());
      EXPECT_EQ(a.crossing().e, b.crossing().e);
      EXPECT_EQ(a.crossing().t, b.crossing().t);
    }
    EXPECT_FALSE(b.step());
    EXPECT_EQ(a.end().face, b.end().face);
    EXPECT_EQ(a.end().b.x, b.end().b.x);
    EXPECT_EQ(a.end().b.y, b.end().b.y);
    EXPECT_EQ(a.length(), b.length());
    EXPECT_EQ(a.hit_boundary(), b.hit_boundary());
  };
  for (const Mesh& mesh : {sphere(2), folded(12, 0.7)}) {
    const Surface s = make_surface(mesh);
    Rng rng(13);
    for (int k = 0; k < 300; ++k) {
      const SurfacePoint start = random_point(s, rng);
      const Vec2 displacement = k == 0 ? Vec2{} : rng.in(0, 0.8) * rng.direction();
      GeodesicWalk there(s, start, displacement);
      GeodesicWalk other_way = there.other_way(), opposite(s, start, -displacement);
      expect_same(other_way, opposite);
      GeodesicWalk back_again = GeodesicWalk(s, start, displacement).other_way().other_way();
      expect_same(there, back_again);
    }
  }
}

TEST(Trace, NowhereIsWhereItStarted) {
  const Surface s = make_surface(sphere(1));
  Rng rng(15);
  const SurfacePoint start = random_point(s, rng);
  Path path;
  const Trace trace = trace_geodesic(s, start, {0, 0}, path);
  EXPECT_TRUE(same_bytes(trace.end, start));
  EXPECT_TRUE(path.empty());
  EXPECT_EQ(trace.length, 0);
}

/// step() says false from the end of a walk on, and nothing changes any more.
TEST(Trace, StaysAtItsEnd) {
  for (const Mesh& mesh : {sphere(2), flat_grid(5)}) {
    const Surface s = make_surface(mesh);
    Rng rng(17);
    for (int k = 0; k < 50; ++k) {
      GeodesicWalk walk(s, random_point(s, rng), rng.in(0, 1.5) * rng.direction());
      while (walk.step()) {
      }
      const SurfacePoint end = walk.end();
      const double length = walk.length();
      for (int again = 0; again < 3; ++again) EXPECT_FALSE(walk.step());
      EXPECT_TRUE(same_bytes(walk.end(), end));
      EXPECT_EQ(walk.length(), length);
    }
  }
}

/// However long a displacement is, a walk has an end, which is on the surface.
TEST(Trace, OfAnyLengthIsCutShortSomewhere) {
  const Surface s = make_surface(octahedron());
  Path path;
  const SurfacePoint start = make_point(0, 0.2, 0.3, 0.5);
  const Trace trace = trace_geodesic(s, start, 1e9 * Vec2{0.6, 0.8}, path);
  EXPECT_LE(path.size(), 100000u);
  ASSERT_TRUE(chains(s, start.face, trace.end.face, path));
  ASSERT_TRUE(inside_face(s, trace.end));
}

TEST(Trace, EndsOnTheBoundaryOfACoarseSquare) {
  const Surface s = make_surface(flat_grid(1));
  Rng rng(16);
  for (int k = 0; k < 500; ++k) {
    const SurfacePoint start = random_point(s, rng);
    Path path;
    const Vec2 direction = rng.direction();
    const Trace trace = trace_geodesic(s, start, 3 * direction, path);
    EXPECT_TRUE(trace.hit_boundary);
    ASSERT_TRUE(chains(s, start.face, trace.end.face, path));
    // From a point of the boundary towards it there is nowhere to go, and nothing breaks.
    path.clear();
    const Trace again = trace_geodesic(s, trace.end, 3 * trace.direction, path);
    EXPECT_TRUE(again.hit_boundary);
    EXPECT_NEAR(again.length, 0, kClearing * 4);
    ASSERT_TRUE(chains(s, trace.end.face, again.end.face, path));
  }
}

}  // namespace
}  // namespace meander::test::geodesic_trace_tests
