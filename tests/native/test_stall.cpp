// SPDX-License-Identifier: GPL-3.0-or-later
//
// A flow in which nothing can move ends, and says so; one at rest has converged.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "test_seeds.h"

namespace meander::test::stall_tests {
namespace {

const auto kNobodyLooks = [](double) {};

/// A stroke in a closed guide that leaves it a slot narrower than anything it would do: medial balls see the guide's
/// nodes only, and are far wider.
std::vector<Line> stroke_in_slot(bool fixed_ends) {
  constexpr double kWidth = 1e-4;
  return {{{{0.27, 0.503 - kWidth, 0}, {0.75, 0.507 - kWidth, 0}, {0.74, 0.507 + kWidth, 0}, {0.25, 0.503 + kWidth, 0}},
           true, true, false},
          {{{0.3, 0.5034, 0}, {0.7, 0.5066, 0}}, false, false, fixed_ends}};
}

TEST(Stall, OfAStrokeInAGuideIsSeenInEveryPreset) {
  const auto surface = std::make_shared<const Surface>(make_surface(flat_grid(6)));
  for (const uint32_t preset : {MEANDER_PRESET_EVEN, MEANDER_PRESET_PAPER, MEANDER_PRESET_FINEST}) {
    for (const double spacing : {0.05, 0.1}) {
      for (const bool fixed_ends : {false, true}) {
        SCOPED_TRACE(testing::Message() << "preset " << preset << ", spacing " << spacing
                                        << (fixed_ends ? ", fixed ends" : ""));
        Flow flow = flow_on(surface, stroke_in_slot(fixed_ends), false, spacing, preset);
        EXPECT_EQ(flow.run(kNeverCancelled, kNobodyLooks), StopReason::kStalled);
        // All but the paper's rule try once to lay what is left, and see then that nothing moves.
        const size_t tries = preset == MEANDER_PRESET_PAPER ? 0 : 1;
        EXPECT_EQ(flow.history().size(), 5 + tries) << "it did not move at all";
        EXPECT_GT(flow.history().back().mean_step, 0.1 * flow.settings().radius) << "though it was to";
        EXPECT_TRUE(crossings_of_what_grows(*surface, flow.curve()).empty());
      }
    }
  }
}

/// What is stuck in a closed guide does not hold what is free outside of it.
TEST(Stall, OfOneStrandDoesNotEndTheOthers) {
  const auto surface = std::make_shared<const Surface>(make_surface(flat_grid(6)));
  std::vector<Line> lines = stroke_in_slot(true);
  lines.push_back({{{0.2, 0.2, 0}, {0.4, 0.2, 0}, {0.3, 0.3, 0}}, true, false, false});
  Flow flow = flow_on(surface, lines, false, 0.1, MEANDER_PRESET_PAPER);
  const double length = flow.curve().growing_length();
  for (int k = 0; k < 30; ++k) {
    ASSERT_EQ(flow.stop_reason(), StopReason::kRunning) << "iteration " << k;
    flow.step(kNeverCancelled);
  }
  EXPECT_GT(flow.curve().growing_length(), 3 * length);
}

/// Nothing can move here either, but nothing is asked to.
TEST(Stall, IsNotWhereTheCurveIsAtRest) {
  const auto surface = std::make_shared<const Surface>(make_surface(flat_grid(6)));
  const std::vector<Line> lines{{{{0.49, 0.5, 0}, {0.51, 0.5, 0}}, false, false, true}};
  for (const uint32_t preset : {MEANDER_PRESET_EVEN, MEANDER_PRESET_PAPER}) {
    Flow flow = flow_on(surface, lines, false, 0.4, preset);
    ASSERT_EQ(flow.curve().size(), 2u);
    EXPECT_EQ(flow.run(kNeverCancelled, kNobodyLooks), StopReason::kConverged) << preset;
  }
}

}  // namespace
}  // namespace meander::test::stall_tests
