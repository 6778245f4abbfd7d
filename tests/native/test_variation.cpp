// SPDX-License-Identifier: GPL-3.0-or-later
//
// Variations: other curves of the same settings, each the same every time and as sound as the first.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <vector>

#include "api/flow_options.h"
#include "base/variation.h"
#include "flow/flow.h"
#include "medial/boundary_reach.h"
#include "seed/regions.h"
#include "curves.h"

namespace meander::test::variation_tests {
namespace {

std::vector<double> bytes_after(const std::shared_ptr<const Surface>& surface, meander_start start,
                                uint32_t variation, uint32_t threads, meander_preset preset = MEANDER_PRESET_EVEN) {
  meander_flow_options options = default_options(preset);
  options.radius = 0.1;
  options.start = start;
  options.variation = variation;
  options.threads = threads;
  Flow flow(surface, nullptr, {}, checked_settings(options, *surface));
  for (int k = 0; k < 12; ++k) flow.step(CancelToken());
  EXPECT_TRUE(whole(*surface, flow.curve()));
  EXPECT_TRUE(exact_crossings(*surface, flow.curve()).empty());
  EXPECT_EQ(flow.curve().strands.size(), surface->component_count());
  std::vector<double> bytes;
  for (const SurfacePoint& p : flow.curve().nodes) bytes.insert(bytes.end(), {double(p.face), p.b.x, p.b.y});
  return bytes;
}

/// A large face has room for many first circles, and so has a surface of several parts.
TEST(Variation, IsAnotherCurveThatIsTheSameEveryTime) {
  for (const Mesh& mesh : {flat_grid(1), joined(sphere(3), torus(24, 12), 4)}) {
    const auto surface = std::make_shared<const Surface>(make_surface(mesh));
    for (const meander_start start : {MEANDER_START_GROW, MEANDER_START_FULL}) {
      std::set<std::vector<double>> found;
      for (const uint32_t variation : {0u, 1u, 2u, 3u, 0xffffffffu}) {
        const std::vector<double> bytes = bytes_after(surface, start, variation, 1);
        EXPECT_EQ(bytes, bytes_after(surface, start, variation, 3));
        found.insert(bytes);
      }
      EXPECT_EQ(found.size(), 5u);
    }
  }
}

TEST(Variation, BeginsElsewhereInThePresetPaper) {
  const auto surface = std::make_shared<const Surface>(make_surface(sphere(3)));
  EXPECT_NE(bytes_after(surface, MEANDER_START_GROW, 0, 1, MEANDER_PRESET_PAPER),
            bytes_after(surface, MEANDER_START_GROW, 1, 1, MEANDER_PRESET_PAPER));
}

/// Beside a boundary that strands keep far from no curve begins, whatever the variation.
TEST(Variation, BeginsAnywhereButInStripsThatStayEmpty) {
  const Surface surface = make_surface(flat_grid(20, 0));
  const double r = 0.05 / surface.scale();
  const RadiusField radius(r);
  const BoundaryObstacle boundary(surface, 0.5 * r);
  std::vector<Vec3> places;
  for (uint32_t variation = 0; variation < 40; ++variation) {
    const std::vector<Region> regions = find_regions(surface, Curve(), radius, &boundary.tree(), 3, variation);
    ASSERT_EQ(regions.size(), 1u);
    const Vec3 place = position(surface, regions[0].middle);
    EXPECT_GT(std::sqrt(boundary.tree().nearest(place)->squared_distance), 3 * r);
    places.push_back(place);
  }
  Vec3 low = places[1], high = places[1];
  for (const Vec3& place : places) low = low.cwiseMin(place), high = high.cwiseMax(place);
  EXPECT_GT((high - low).head<2>().minCoeff(), 0.4 / surface.scale()) << "they lie together";
}

TEST(Variation, OfAFlowThatHasBegunStays) {
  const auto surface = std::make_shared<const Surface>(make_surface(sphere(2)));
  meander_flow_options options = default_options(MEANDER_PRESET_EVEN);
  options.radius = 0.2;
  options.variation = 2;
  Flow flow(surface, nullptr, {}, checked_settings(options, *surface));
  flow.step(CancelToken());
  options.variation = 5;
  options.bending_weight = 2;
  flow.revise(checked_settings(options, *surface));
  EXPECT_EQ(flow.settings().variation, 2u);
}

TEST(Variation, HasSharesFarFromThoseBefore) {
  EXPECT_EQ(share_of_variation(0), 0);
  for (uint32_t k = 1; k < 8; ++k) {
    const double share = share_of_variation(k);
    EXPECT_TRUE(share >= 0 && share < 1);
    for (uint32_t j = 0; j < k; ++j) {
      const double apart = std::abs(share - share_of_variation(j));
      EXPECT_GT(std::min(apart, 1 - apart), 0.35 / k);
    }
  }
}

}  // namespace
}  // namespace meander::test::variation_tests
