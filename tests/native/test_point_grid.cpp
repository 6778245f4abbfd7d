// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a grid of points finds, against all points, for queries of one size and of very different ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/point_grid.h"
#include "meshes.h"

namespace meander::test::point_grid_tests {
namespace {

using Found = std::vector<std::pair<uint32_t, double>>;

Found all_near(const std::vector<Vec3>& points, const Vec3& q, double radius) {
  Found found;
  for (uint32_t i = 0; i < points.size(); ++i) {
    const double squared = (points[i] - q).squaredNorm();
    if (squared < radius * radius) found.emplace_back(i, squared);
  }
  return found;
}

Found near(const PointGrid& grid, const Vec3& q, double radius) {
  Found found;
  grid.near(q, radius, [&](uint32_t i, double squared) { found.emplace_back(i, squared); });
  std::ranges::sort(found);
  return found;
}

/// From a few in a large room to many in a small one, about as far apart as queries are wide.
std::vector<Vec3> points_of_any_density(double least, uint32_t count, Rng& rng) {
  std::vector<Vec3> points;
  for (uint32_t k = 0; k < count; ++k) {
    const double room = std::pow(least, rng.in(0, 1));
    points.emplace_back(room * rng.in(-1, 1), room * rng.in(-1, 1), 0.2 * room * rng.in(-1, 1));
  }
  return points;
}

TEST(PointGrid, FindsWhatALookAtAllPointsFinds) {
  Rng rng(82);
  // The last two are more than it has sizes of cubes for.
  for (const double least : {1.0, 0.7, 0.1, 1e-3, 1e-6, 1e-9}) {
    for (const uint32_t count : {1u, 20u, 2000u}) {
      const std::vector<Vec3> points = points_of_any_density(least, count, rng);
      const PointGrid grid(points, 0.1 * least, 0.1);
      size_t found = 0;
      for (int k = 0; k < 200; ++k) {
        const double radius = 0.1 * std::pow(least, rng.in(0, 1)) * rng.in(0.4, 1);
        const Vec3 q = points[rng.below(count)] + radius * Vec3(rng.in(-1, 1), rng.in(-1, 1), rng.in(-1, 1));
        const Found near_q = near(grid, q, radius);
        ASSERT_EQ(near_q, all_near(points, q, radius)) << least << " " << radius;
        found += near_q.size();
      }
      EXPECT_GT(found, 20u);
    }
  }
}

TEST(PointGrid, OfNoPointsFindsNothing) {
  EXPECT_TRUE(near(PointGrid({}, 1), Vec3::Zero(), 1).empty());
  EXPECT_TRUE(near(PointGrid({}, 1e-3, 1), Vec3::Zero(), 1).empty());
}

}  // namespace
}  // namespace meander::test::point_grid_tests
