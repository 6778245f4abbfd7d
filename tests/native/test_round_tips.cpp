// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tips of hairpins are round, by a measure that knows nothing of the flow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "api_flows.h"

namespace meander::test::round_tips_tests {
namespace {

/// A line turns sharply where it turns by more than 45 degrees within .3 spacings.
constexpr double kSharp = kPi / 4, kWithin = 0.3;

/// No more of its length may turn so, as a share: grown, and of a full start.
constexpr double kMostSharp = 0.022, kMostSharpOfFull = 0.0158;

struct Turning {
  double length = 0, sharp = 0;
};

/// Of the closed line of a flow on a square in the plane z = 0: how much of it lies in the middle of a sharp turn.
Turning turning_of(const Flow& flow) {
  const Curve& curve = flow.curve();
  const size_t n = curve.size();
  std::vector<Vec2> at;
  for (const SurfacePoint& node : curve.nodes) {
    const Vec3 p = position(flow.surface(), node);
    at.push_back({p.x(), p.y()});
  }
  std::vector<double> arc{0}, turn;
  for (size_t i = 0; i < n; ++i) {
    const Vec2 before = at[i] - at[(i + n - 1) % n], after = at[(i + 1) % n] - at[i];
    turn.push_back(std::atan2(before.x * after.y - before.y * after.x, dot(before, after)));
    arc.push_back(arc.back() + norm(after));
  }
  Turning found{arc.back(), 0};
  const double half = kWithin * flow.settings().radius, step = half / 3;  // a spacing is 2 r
  for (double s = 0; s < found.length; s += step) {
    double sum = 0;
    for (size_t i = 0; i < n; ++i) {
      const double away = std::abs(arc[i] - s);
      if (std::min(away, found.length - away) <= half) sum += turn[i];
    }
    if (std::abs(sum) > kSharp) found.sharp += step;
  }
  return found;
}

TEST(RoundTips, HardlyAnyOfTheLineTurnsSharply) {
  for (const auto& [start, most] :
       {std::pair{MEANDER_START_GROW, kMostSharp}, {MEANDER_START_FULL, kMostSharpOfFull}}) {
    Turning all;
    for (const double radius : {1.0 / 36, 1.0 / 40, 1.0 / 44}) {
      meander_flow_options options = options_with(radius, 1, MEANDER_PRESET_EVEN);
      options.start = start;
      const FlowHandle flow = make_flow(flat_grid(20), options);
      ASSERT_EQ(meander_flow_run(flow.get(), nullptr, nullptr), MEANDER_STATUS_OK);
      ASSERT_EQ(flow->flow->curve().strands.size(), 1u);
      const Turning found = turning_of(*flow->flow);
      all.length += found.length;
      all.sharp += found.sharp;
    }
    EXPECT_LT(all.sharp, most * all.length) << start;
  }
}

}  // namespace
}  // namespace meander::test::round_tips_tests
