// SPDX-License-Identifier: GPL-3.0-or-later
//
// Geodesic distances on surfaces whose unrolling is known, and the properties of any distance.
#include <gtest/gtest.h>

#include "geodesic_distance.h"
#include "curves.h"
#include "unrolled_surfaces.h"

namespace meander::test::geodesic_distance_tests {
namespace {

FlatPoint in_plane(const Surface& s, const SurfacePoint& p) { return {p.face, flat(s, p)}; }

GeodesicDistance::Target target(const Surface& s, const SurfacePoint& p, double most) {
  return {in_plane(s, p), position(s, p), most, {}, false};
}

constexpr double kFar = 10;

/// Vertices are rounded to 2^-30 of the mesh, and distances may add up a few of them.
constexpr double kGridRounding = 256 * 0x1p-30;

double distance(const Surface& s, GeodesicDistance& geodesic, const SurfacePoint& a, const SurfacePoint& b) {
  auto t = target(s, b, kFar);
  geodesic.measure(in_plane(s, a), {&t, 1});
  EXPECT_TRUE(t.reached);
  return t.distance;
}

TEST(GeodesicDistance, IsThatOfTheUnrolledSurface) {
  for (const auto& unrolled : unrolled_surfaces()) {
    SCOPED_TRACE(unrolled->name());
    const Surface& s = unrolled->surface();
    GeodesicDistance geodesic(s);
    Rng rng(41);
    for (int k = 0; k < 400; ++k) {
      const SurfacePoint a = random_point(s, rng), b = random_point(s, rng);
      const double expected = unrolled->distance(a, b);
      if (expected < 0) continue;  // beyond the formula
      EXPECT_NEAR(distance(s, geodesic, a, b), expected, kGridRounding);
    }
  }
}

TEST(GeodesicDistance, LeavesTowardsItsEnd) {
  for (const Mesh& mesh : {torus(20, 10), with_noise(sphere(3), 0.2, 4), cube()}) {
    const Surface s = make_surface(mesh);
    GeodesicDistance geodesic(s);
    Rng rng(42);
    for (int k = 0; k < 200; ++k) {
      const SurfacePoint a = random_point(s, rng), b = random_point(s, rng);
      auto t = target(s, b, kFar);
      geodesic.measure(in_plane(s, a), {&t, 1});
      ASSERT_TRUE(t.reached);
      ASSERT_GE(t.distance, (position(s, a) - position(s, b)).norm() - kGridRounding);
      Path path;
      const Trace trace = trace_geodesic(s, a, t.distance * t.direction, path);
      const double missed = (position(s, trace.end) - position(s, b)).norm();
      // A path that bends at a vertex starts towards the vertex.
      if (missed > kGridRounding) {
        bool bends = false;
        for (uint32_t v = 0; v < s.vertex_count(); ++v) bends |= s.total_angle(v) > 2 * kPi;
        EXPECT_TRUE(bends);
      }
    }
  }
}

TEST(GeodesicDistance, IsSymmetricTriangularAndNoLongerThanAnyPath) {
  for (const Mesh& mesh : {torus(16, 8), with_noise(sphere(3), 0.3, 6), grid_with_hole(9), bumpy_grid(9),
                           cone(7, 4, 2), cone(12, 3, 0.7, true)}) {
    const Surface s = make_surface(mesh);
    GeodesicDistance geodesic(s);
    PathShortener shortener(s);
    Rng rng(43);
    for (int k = 0; k < 60; ++k) {
      const SurfacePoint a = random_point(s, rng), b = random_point(s, rng), c = random_point(s, rng);
      const double ab = distance(s, geodesic, a, b), bc = distance(s, geodesic, b, c), ac = distance(s, geodesic, a, c);
      EXPECT_NEAR(ab, distance(s, geodesic, b, a), kGridRounding);
      EXPECT_LE(ac, ab + bc + kGridRounding);
      // The end of a straight walk is no farther than the walk is long.
      Path path;
      const Trace trace = trace_geodesic(s, a, 0.4 * rng.direction(), path);
      const double walked = distance(s, geodesic, a, trace.end);
      EXPECT_LE(walked, trace.length + kGridRounding);
      EXPECT_LE(walked, shortener.shorten(a, trace.end, path).length + kGridRounding);
    }
  }
}

TEST(GeodesicDistance, ManyTargetsAreAsOne) {
  const Surface s = make_surface(with_noise(sphere(4), 0.3, 8));
  GeodesicDistance many(s), one(s);
  Rng rng(44);
  for (int k = 0; k < 20; ++k) {
    const SurfacePoint a = random_point(s, rng);
    std::vector<GeodesicDistance::Target> targets;
    for (int t = 0; t < 12; ++t) targets.push_back(target(s, random_point(s, rng), rng.in(0.1, 0.5)));
    std::vector<GeodesicDistance::Target> nearest = targets, all = targets;
    many.measure(in_plane(s, a), all);
    many.measure(in_plane(s, a), nearest, true);
    double least = kFar, found = kFar;
    for (size_t t = 0; t < targets.size(); ++t) {
      auto alone = targets[t];
      one.measure(in_plane(s, a), {&alone, 1});
      EXPECT_EQ(alone.reached, all[t].reached);
      EXPECT_EQ(alone.distance, all[t].distance);
      if (alone.reached) least = std::min(least, alone.distance);
      if (nearest[t].reached) found = std::min(found, nearest[t].distance);
    }
    EXPECT_EQ(least, found);
  }
}

}  // namespace
}  // namespace meander::test::geodesic_distance_tests
