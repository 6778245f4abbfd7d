// SPDX-License-Identifier: GPL-3.0-or-later
// What is asked about a curve while it grows changes nothing of what becomes of it.
#include <gtest/gtest.h>

#include <memory>

#include "api_flows.h"
#include "flow/flow.h"
#include "test_seeds.h"

namespace meander::test::asking_tests {
namespace {

NodeData<Radii> own_radii(Flow& flow) {
  return flow.ask([](const Flow::Present& present) { return present.state.nodes.radii; });
}

/// The next medial axis is searched from the radii of the one before, so these are not to be those of an answer.
TEST(Asking, LeavesTheFlowTheRadiiItGoesOnFrom) {
  const auto surface = std::make_shared<const Surface>(make_surface(sphere(3)));
  Flow flow(surface, nullptr, {}, checked_settings(options_of(0.25, MEANDER_PRESET_EVEN), *surface));
  bool differ = false;
  for (int k = 0; k < 30; ++k) {
    ASSERT_TRUE(flow.step(kNeverCancelled));
    const NodeData<Radii> own = own_radii(flow), again = own_radii(flow), told = flow.radii();
    ASSERT_EQ(own.size(), flow.curve().size());
    ASSERT_EQ(told.size(), own.size());
    for (uint32_t i = 0; i < own.size(); ++i) {
      EXPECT_EQ(own[i], again[i]);
      differ = differ || own[i] != told[i];
    }
  }
  EXPECT_TRUE(differ) << "what is told is of the curve as it is";
}

}  // namespace
}  // namespace meander::test::asking_tests
