// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distances from the curve that are found once for many points, against those found for single points.
#include <gtest/gtest.h>

#include <vector>

#include "geodesic/geodesic_trace.h"
#include "geodesic/patch_comparison.h"
#include "outputs/emptiness.h"
#include "curves.h"

namespace meander::test::emptiness_tests {
namespace {

constexpr double kRadius = 0.02;

/// Sizes that differ by less than this share count as equal in a climb.
constexpr double kEqual = 1e-9;

using Size = Emptiness::Size;

struct Scene {
  Scene(const Mesh& mesh, const RadiusField& r) : surface(make_surface(mesh)), radius(r) {
    Rng rng(17);
    for (int k = 0; k < 30; ++k) add_walk(surface, curve, random_point(surface, rng), 0.01, 15, 0.5, rng);
    for (const SurfacePoint& p : curve.nodes) nodes.push_back(position(surface, p));
  }
  Surface surface;
  RadiusField radius;
  Curve curve;
  std::vector<Vec3> nodes;
};

SurfacePoint walked(const Surface& surface, const SurfacePoint& start, Vec2 displacement) {
  Path path;
  return trace_geodesic(surface, start, displacement, path).end;
}

/// Climbs from random places, with steps of many lengths in all directions.
void expect_same_as_single_points(const Scene& scene, bool along_surface) {
  ThreadPool pool(1);
  const SurfacePatches patches = compared_patches(scene.surface, scene.radius, 3, pool);
  const Emptiness emptiness(scene.surface, scene.curve, scene.nodes, scene.radius, along_surface ? &patches : nullptr);
  Rng rng(23);
  int found = 0, surely = 0;
  for (int climb = 0; climb < 40; ++climb) {
    EmptinessNearby nearby(emptiness);
    Gap best = emptiness.at(random_point(scene.surface, rng));
    const auto compare = [&](double low, double high) {
      return emptiness.compare(best.centre, low * best.radius, high * best.radius);
    };
    EXPECT_EQ(compare(0.9, 0.99), Size::kAbove);
    EXPECT_EQ(compare(0.99, 1.01), Size::kBetween);
    EXPECT_EQ(compare(1.01, 1.1), Size::kBelow);
    EXPECT_EQ(compare(1.01, 1.01), Size::kBelow);
    for (int k = 0; k < 100; ++k) {
      const double r = scene.radius.at(scene.surface, best.centre);
      const Vec2 step = (r * std::pow(2, rng.in(-8, 2))) * rng.direction();
      const SurfacePoint end = walked(scene.surface, best.centre, step);
      const Gap gap = emptiness.at(end);
      const double size = best.size * rng.in(0.9, 1);
      if (nearby.surely_below(best.centre, step, size)) {
        ++surely;
        EXPECT_LT(gap.size, size);
      }
      const std::optional<Gap> above = nearby.above(end, size);
      if (above) {
        ++found;
        EXPECT_EQ(above->radius, gap.radius);
        EXPECT_EQ(above->size, gap.size);
        EXPECT_GE(above->size, size * (1 - kEqual));
        if (above->size > best.size) best = *above;
      } else {
        EXPECT_LE(gap.size, size * (1 + kEqual));
      }
    }
  }
  EXPECT_GT(found, 400);
  if (!along_surface) {
    EXPECT_GT(surely, 100);
  }
}

TEST(Emptiness, NearbyIsThatOfSinglePoints) {
  for (const Mesh& mesh : {bumpy_grid(12), flat_grid(1), torus(30, 15)}) {
    const Scene scene(mesh, RadiusField(kRadius));
    for (const bool along_surface : {false, true}) expect_same_as_single_points(scene, along_surface);
  }
}

TEST(Emptiness, NearbyIsThatOfSinglePointsUnderADensity) {
  const Mesh mesh = bumpy_grid(12);
  VertexData<double> density(mesh.vertex_count());
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) density[v] = 1 + 8 * mesh.at(v).x();
  const Scene scene(mesh, RadiusField(2 * kRadius, density));
  for (const bool along_surface : {false, true}) expect_same_as_single_points(scene, along_surface);
}

}  // namespace
}  // namespace meander::test::emptiness_tests
