// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a tree of points finds, against all points.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/point_tree.h"
#include "meshes.h"

namespace meander::test::point_tree_tests {
namespace {

Vec3 random_place(Rng& rng) { return {rng(), rng(), 0.2 * rng()}; }

TEST(PointTree, FindsWhatALookAtAllPointsFinds) {
  Rng rng(81);
  for (const uint32_t count : {1u, 7u, 9u, 300u}) {
    std::vector<Vec3> points;
    for (uint32_t k = 0; k < count; ++k) points.push_back(random_place(rng));
    const PointTree tree(points);
    for (int k = 0; k < 500; ++k) {
      const Vec3 q = k % 10 == 0 ? points[rng.below(count)] : random_place(rng);
      const auto squared = [&](const Vec3& p) { return (p - q).squaredNorm(); };
      const double least = squared(*std::min_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
        return squared(a) < squared(b);
      }));
      EXPECT_EQ(tree.nearest(q)->squared_distance, least);
      // Bounds below which there is no point, the nearest distance itself among them, and wider ones.
      for (const double bound : {0.25 * least, least, 1.0001 * least + 1e-300, 0.01, 10.0}) {
        std::vector<uint32_t> close, found;
        for (uint32_t i = 0; i < count; ++i) {
          if (squared(points[i]) < bound) close.push_back(i);
        }
        tree.within(q, bound, found);
        EXPECT_EQ(found, close);
        EXPECT_EQ(tree.nearest(q, bound).has_value(), !close.empty());
        EXPECT_EQ(tree.any_within(q, bound), !close.empty());
      }
    }
  }
}

TEST(PointTree, OfNoPointsFindsNothing) {
  const PointTree tree({});
  std::vector<uint32_t> found{1};
  tree.within(Vec3::Zero(), 1, found);
  EXPECT_TRUE(found.empty());
  EXPECT_FALSE(tree.nearest(Vec3::Zero()));
  EXPECT_FALSE(tree.any_within(Vec3::Zero(), 1));
}

}  // namespace
}  // namespace meander::test::point_tree_tests
