// SPDX-License-Identifier: GPL-3.0-or-later
//
// First curves of surfaces of very many parts, and of very small ones. With a time that grows with the square of
// their number these tests take minutes.
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

#include "curve/crossings.h"
#include "medial/boundary_reach.h"
#include "seed/first_curve.h"
#include "seed/regions.h"
#include "curves.h"

namespace meander::test::first_curve_tests {
namespace {

/// Copies of a mesh in rows, `distance` apart.
Mesh copies(const Mesh& part, uint32_t count, double distance) {
  const uint32_t row = static_cast<uint32_t>(std::ceil(std::sqrt(count)));
  Mesh all;
  for (uint32_t k = 0; k < count; ++k) {
    const uint32_t first = all.vertex_count();
    for (uint32_t v = 0; v < part.vertex_count(); ++v) {
      const Vec3 p = part.at(v) + distance * Vec3(k % row, k / row, 0);
      all.add(p.x(), p.y(), p.z());
    }
    for (const uint32_t v : part.faces) all.faces.push_back(first + v);
  }
  return all;
}

TEST(FirstCurve, HasACircleOnEachOfManySpheres) {
  constexpr uint32_t kCount = 10000;
  const Surface surface = make_surface(copies(octahedron(), kCount, 3));
  ThreadPool pool(2);
  const double r = 0.6 / surface.scale();
  const Curve curve = first_curve(surface, nullptr, RadiusField(r), true, PointTree({}), 1, pool);
  ASSERT_EQ(curve.strands.size(), kCount);
  for (uint32_t s = 0; s < kCount; ++s) {
    const Strand& strand = curve.strands[s];
    ASSERT_EQ(strand.count, curve.strands[0].count);
    ASSERT_GT(strand.count, 3u) << "the outline of a face";
    for (uint32_t i = strand.first; i < strand.end(); ++i) {
      ASSERT_EQ(surface.component(curve.nodes[i].face), s);
      const uint32_t next = curve.next(i);
      ASSERT_TRUE(next == i + 1 || (next == strand.first && i + 1 == strand.end()));
      ASSERT_TRUE(chains(surface, curve.nodes[i].face, curve.nodes[next].face, curve.paths[i]));
    }
  }
  EXPECT_TRUE(CrossingTest().find(surface, curve, pool).empty());
}

TEST(FirstCurve, BeginsBeyondTheStripsOfManySquares) {
  constexpr uint32_t kCount = 3000;
  const Mesh square = flat_grid(5, 0);
  const Surface surface = make_surface(copies(square, kCount, 2));
  const double r = 0.2 / surface.scale();
  const RadiusField radius(r);
  const BoundaryObstacle boundary(surface, 0.5 * r);
  const std::vector<Region> regions = find_regions(surface, Curve(), radius, &boundary.tree(), 1.5);
  ASSERT_EQ(regions.size(), kCount);
  for (uint32_t c = 0; c < kCount; ++c) {
    ASSERT_EQ(surface.component(regions[c].middle.face), c);
    const double distance =
        std::sqrt(boundary.tree().nearest(position(surface, regions[c].middle))->squared_distance);
    ASSERT_GT(distance, 0.4 / surface.scale());  // a square is 1 wide, its inmost faces are 0.2
  }
}

/// In the corner of a sheet there is no room for a circle.
TEST(FirstCurve, BeginsWhereTheBoundaryLeavesRoom) {
  const Surface surface = make_surface(flat_grid(40, 0));
  const Vec3 first = position(surface, make_point(0, 1, 1, 1));
  ThreadPool pool(2);
  for (const double spacing : {0.06, 0.1, 0.2}) {
    const double r = spacing / 2 / surface.scale();
    const Curve curve = first_curve(surface, nullptr, RadiusField(r), true, PointTree({}), 1, pool);
    ASSERT_EQ(curve.strands.size(), 1u);
    Vec3 middle = Vec3::Zero();
    for (const SurfacePoint& node : curve.nodes) middle += position(surface, node) / curve.size();
    EXPECT_GT((first - middle).norm(), 0.5 * r) << "it fits around the first face after all";
    EXPECT_LT((first - middle).norm(), 6 * r) << "there is room nearer";
    for (const SurfacePoint& node : curve.nodes) {
      EXPECT_NEAR((position(surface, node) - middle).norm(), 1.5 * r, 1e-9 * r);
    }
  }
}

/// Rays as long as the circle is wide would wind thousands of times round the small ones, which took minutes.
TEST(FirstCurve, OfComponentsFarSmallerThanTheSpacingIsFoundAtOnce) {
  Mesh mesh = cube();
  constexpr uint32_t kSmall = 10;
  for (uint32_t k = 1; k <= kSmall; ++k) {
    mesh = joined(mesh, scaled(cube(), 1e-3 / k), 3.0 * k);
  }
  const Surface surface = make_surface(mesh);
  const double r = 0.4 / surface.scale();
  ThreadPool pool(1);
  const std::clock_t begin = std::clock();
  const Curve curve = first_curve(surface, nullptr, RadiusField(r), true, PointTree({}), 1, pool);
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 1.0);  // measured: .002
  EXPECT_EQ(curve.strands.size(), 1 + kSmall);
  EXPECT_TRUE(CrossingTest().find(surface, curve, pool).empty());
}

}  // namespace
}  // namespace meander::test::first_curve_tests
