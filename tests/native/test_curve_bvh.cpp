// SPDX-License-Identifier: GPL-3.0-or-later
//
// The largest balls that the hierarchy finds, one by one and for neighbours together, against all points.
#include <gtest/gtest.h>

#include "medial/curve_bvh.h"
#include "test_meshes.h"

namespace meander::test {
namespace {

using Sides = std::array<Vec3, 2>;
using Balls = std::array<double, 2>;

/// Squares and sums are rounded before they are compared, so of two points that limit a ball equally
/// either may be found.
constexpr double kRounding = 1e-14;

double brute_force(const std::vector<Vec3>& points, const Vec3& x, const Vec3& b, double most) {
  double radius = most;
  for (const Vec3& p : points) {
    const double ahead = (p - x).dot(b);
    if (ahead > 0) radius = std::min(radius, (p - x).squaredNorm() / (2 * ahead));
  }
  return radius;
}

Vec3 random_direction(Rng& rng) { return Vec3(rng.in(-1, 1), rng.in(-1, 1), rng.in(-1, 1)).normalized(); }

/// Points of a curve that winds at random: some consecutive, some not.
std::vector<Vec3> winding(size_t count, double step, Rng& rng) {
  std::vector<Vec3> points;
  Vec3 at(0, 0, 0), direction = random_direction(rng);
  for (size_t i = 0; i < count; ++i) {
    if (i % 37 == 0) at = Vec3(rng.in(-0.5, 0.5), rng.in(-0.5, 0.5), rng.in(-0.1, 0.1));
    direction = (direction + 0.3 * random_direction(rng)).normalized();
    at = (at + step * direction).cwiseMax(-1).cwiseMin(1);
    points.push_back(at);
  }
  return points;
}

TEST(CurveBvh, BallsOfNeighboursEqualBruteForce) {
  Rng rng(7);
  ThreadPool pool(2);
  size_t limited = 0, clamped = 0;
  for (const size_t count : {1, 2, 7, 8, 9, 64, 500, 3001}) {
    const std::vector<Vec3> points = winding(count, 0.01, rng);
    const CurveBvh tree(points, pool);
    std::vector<Sides> b(count);
    for (Sides& sides : b) {
      const Vec3 along = random_direction(rng);
      sides = {along, rng.in(0, 1) < 0.5 ? Vec3(-along) : random_direction(rng)};
    }
    // The last of these meets hundreds of runs, more than are kept for neighbours.
    for (const double most : {0.004, 0.03, 0.2, 4.0}) {
      std::vector<Balls> start(count);
      for (Balls& balls : start) {
        for (double& r : balls) r = rng.in(0, 1) < 0.1 ? 0 : rng.in(0.2, 1) * most;
      }
      std::vector<Balls> together = start, parts = start;
      tree.largest_balls(0, count, b, together);
      for (size_t first = 0; first < count; first += 13) {
        tree.largest_balls(first, std::min(count, first + 13), b, parts);
      }
      EXPECT_EQ(parts, together);
      for (size_t i = 0; i < count; ++i) {
        for (size_t side = 0; side < 2; ++side) {
          const double expected = start[i][side] > 0 ? brute_force(points, points[i], b[i][side], start[i][side]) : 0;
          ASSERT_NEAR(together[i][side], expected, kRounding * expected) << count << " points, ball " << i;
          if (start[i][side] == 0) continue;
          const double alone = tree.largest_ball(points[i], b[i][side], start[i][side]);
          EXPECT_NEAR(alone, expected, kRounding * expected);
          uint32_t touched = 0;
          EXPECT_NEAR(tree.largest_ball(points[i], b[i][side], start[i][side], &touched), expected,
                      kRounding * expected);
          EXPECT_EQ(touched == UINT32_MAX, expected == start[i][side]);
          ++(expected < start[i][side] ? limited : clamped);
        }
      }
    }
  }
  EXPECT_GT(limited, 1000u);
  EXPECT_GT(clamped, 1000u);
}

/// Points at even distances, where many limit a ball equally.
TEST(CurveBvh, BallsOfAGridEqualBruteForce) {
  ThreadPool pool(1);
  std::vector<Vec3> points;
  for (int row = 0; row < 12; ++row) {
    for (int k = 0; k < 40; ++k) points.emplace_back(0.0125 * (row % 2 ? 39 - k : k), 0.05 * row, 0);
  }
  const CurveBvh tree(points, pool);
  const std::vector<Sides> b(points.size(), Sides{Vec3(0, 1, 0), Vec3(0, -1, 0)});
  std::vector<Balls> radii(points.size(), Balls{0.1, 0.1});
  tree.largest_balls(0, points.size(), b, radii);
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t side = 0; side < 2; ++side) {
      const double expected = brute_force(points, points[i], b[i][side], 0.1);
      EXPECT_NEAR(radii[i][side], expected, kRounding * expected);
    }
  }
}

TEST(CurveBvh, InsideEqualsBruteForce) {
  Rng rng(8);
  ThreadPool pool(1);
  const std::vector<Vec3> points = winding(900, 0.01, rng);
  const CurveBvh tree(points, pool);
  std::vector<uint32_t> found;
  for (int k = 0; k < 100; ++k) {
    const Vec3 centre(rng.in(-1, 1), rng.in(-1, 1), rng.in(-1, 1));
    const double radius = rng.in(0, 1);
    std::vector<uint32_t> expected;
    for (uint32_t i = 0; i < points.size(); ++i) {
      if ((points[i] - centre).squaredNorm() < radius * radius) expected.push_back(i);
    }
    tree.inside(centre, radius, found);
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace meander::test
