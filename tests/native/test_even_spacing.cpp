// SPDX-License-Identifier: GPL-3.0-or-later
//
// The spacing of a finished curve is the one that was asked for, by a measure that knows nothing of the flow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "api_flows.h"

namespace meander::test::even_spacing_tests {
namespace {

/// A node's own strand counts from this far along it, in r: nearer to it the curve touches any ball.
constexpr double kOwn = 1.125;

/// Nodes nearer than this to the boundary, in r, have nothing beyond it to be spaced from.
constexpr double kInside = 3;

/// How far the median may be from the spacing asked for, and the length from what fills the surface, as shares.
constexpr double kSpacingOff = 0.03, kLengthOff = 0.02;

/// Balls larger than this, in r, are not told apart.
constexpr double kLargest = 4;

/// The curve of a flow on a square in the plane z = 0: one closed strand.
struct Line {
  std::vector<Vec2> at;
  std::vector<double> arc;
  double length = 0;
};

Line line_of(const Flow& flow) {
  Line line;
  const Curve& curve = flow.curve();
  for (uint32_t i = 0; i < curve.size(); ++i) {
    const Vec3 p = position(flow.surface(), curve.nodes[i]);
    line.at.push_back({p.x(), p.y()});
  }
  for (size_t i = 0; i < line.at.size(); ++i) {
    line.arc.push_back(line.length);
    line.length += norm(line.at[(i + 1) % line.at.size()] - line.at[i]);
  }
  return line;
}

/// The radius of the largest disk that touches the line at node i on one side and holds no other node of it.
double tangent_disk(const Line& line, size_t i, Vec2 normal, double r) {
  double radius = kLargest * r;
  for (size_t j = 0; j < line.at.size(); ++j) {
    const Vec2 d = line.at[j] - line.at[i];
    const double across = dot(d, normal);
    if (!(across > 0) || dot(d, d) >= 2 * across * radius) continue;
    const double along = std::abs(line.arc[j] - line.arc[i]);
    if (std::min(along, line.length - along) < kOwn * r) continue;
    radius = dot(d, d) / (2 * across);
  }
  return radius;
}

/// The median of the distances of strands, over the spacing `2 r`, away from the boundary of the square.
double median_spacing(const Flow& flow) {
  const double r = flow.settings().radius;
  const Line line = line_of(flow);
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}, high = -low;
  for (uint32_t v = 0; v < flow.surface().vertex_count(); ++v) {
    const Vec3& p = flow.surface().position(v);
    low = {std::min(low.x, p.x()), std::min(low.y, p.y())};
    high = {std::max(high.x, p.x()), std::max(high.y, p.y())};
  }
  std::vector<double> radii;
  const size_t n = line.at.size();
  for (size_t i = 0; i < n; ++i) {
    const Vec2 p = line.at[i];
    if (std::min({p.x - low.x, p.y - low.y, high.x - p.x, high.y - p.y}) < kInside * r) continue;
    const Vec2 tangent = unit(line.at[(i + 1) % n] - line.at[(i + n - 1) % n]);
    for (const double side : {1.0, -1.0}) {
      radii.push_back(tangent_disk(line, i, side * Vec2{-tangent.y, tangent.x}, r) / r);
    }
  }
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return *middle;
}

TEST(EvenSpacing, IsTheOneAskedForInTheMedian) {
  const FlowHandle flow = make_flow(flat_grid(20), options_with(1.0 / 40, 1, MEANDER_PRESET_EVEN));
  ASSERT_EQ(meander_flow_run(flow.get(), nullptr, nullptr), MEANDER_STATUS_OK);
  ASSERT_EQ(flow->flow->curve().strands.size(), 1u);
  EXPECT_NEAR(median_spacing(*flow->flow), 1, kSpacingOff);
}

// Where nothing is done about it limp strands rest at .85 of the spacing, and those four times as stiff at 1.15.
TEST(EvenSpacing, IsTheOneAskedForHoweverStiffStrandsAre) {
  for (const double stiffness : {0.25, 4.0}) {
    SCOPED_TRACE(testing::Message() << "times the usual stiffness: " << stiffness);
    meander_flow_options options = options_with(1.0 / 32, 1, MEANDER_PRESET_EVEN);
    options.bending_weight *= stiffness;
    options.polish_bending_weight *= stiffness;
    const FlowHandle flow = make_flow(flat_grid(20), options);
    ASSERT_EQ(meander_flow_run(flow.get(), nullptr, nullptr), MEANDER_STATUS_OK);
    EXPECT_NEAR(median_spacing(*flow->flow), 1, 2 * kSpacingOff);
  }
}

// As a bend radius that is asked for needs it: whoever says where strands rest is not corrected back to the spacing.
TEST(EvenSpacing, IsAsMuchWiderAsStiffStrandsAreLetBe) {
  constexpr double kStiffness = 4;
  const double wider = std::pow(kStiffness, 1.0 / 9);
  meander_flow_options options = options_with(1.0 / 32, 1, MEANDER_PRESET_EVEN);
  options.bending_weight *= kStiffness;
  options.polish_bending_weight *= kStiffness;
  ASSERT_EQ(meander_flow_options_set_tuning(&options, "polish_rest", 0.968 / wider, nullptr), MEANDER_STATUS_OK);
  const FlowHandle flow = make_flow(flat_grid(20), options);
  ASSERT_EQ(meander_flow_run(flow.get(), nullptr, nullptr), MEANDER_STATUS_OK);
  EXPECT_NEAR(median_spacing(*flow->flow), wider, 2 * kSpacingOff);
}

// Strands that a field holds cannot give way: where nothing is done about it they rest at .94 when they have grown.
TEST(EvenSpacing, IsTheOneAskedForAlongAField) {
  for (const double weight : {2.0, 4.0}) {
    SCOPED_TRACE(testing::Message() << "weight " << weight);
    const Mesh mesh = flat_grid(20);
    meander_flow_options options = options_with(1.0 / 32, 1, MEANDER_PRESET_EVEN);
    options.alignment_weight = weight;
    const FlowHandle flow = make_flow(mesh, options);
    std::vector<double> along_x(3 * mesh.vertex_count(), 0);
    for (size_t k = 0; k < along_x.size(); k += 3) along_x[k] = 1;
    ASSERT_EQ(meander_flow_set_directions(flow.get(), along_x.data(), mesh.vertex_count(), 0, nullptr),
              MEANDER_STATUS_OK);
    ASSERT_EQ(meander_flow_run(flow.get(), nullptr, nullptr), MEANDER_STATUS_OK);
    EXPECT_NEAR(median_spacing(*flow->flow), 1, kSpacingOff);
  }
}

// Rows of a full start on a square are a whole number; a sphere takes any spacing.
TEST(EvenSpacing, MakesTheCurveAsLongAsTheSurfaceIsWideForIt) {
  for (const meander_preset preset : {MEANDER_PRESET_EVEN, MEANDER_PRESET_FINEST}) {
    for (const meander_start start : {MEANDER_START_GROW, MEANDER_START_FULL}) {
      if (preset == MEANDER_PRESET_FINEST && start == MEANDER_START_GROW) continue;
      SCOPED_TRACE(testing::Message() << "preset " << preset << ", start " << start);
      // Where lines of a full start end is a matter of a few percent; what grows has none.
      std::vector<double> radii{1.0 / 12};
      if (start == MEANDER_START_FULL) radii = {1.0 / 15, 1.0 / 16, 1.0 / 17};
      std::vector<double> packings;
      for (const double radius : radii) {
        meander_flow_options options = options_with(radius, 1, preset);
        options.start = start;
        const FlowHandle flow = make_flow(sphere(3), options);
        ASSERT_EQ(meander_flow_run(flow.get(), nullptr, nullptr), MEANDER_STATUS_OK);
        packings.push_back(packing(flow));
      }
      std::ranges::sort(packings);
      EXPECT_NEAR(packings[packings.size() / 2], 1, kLengthOff);
    }
  }
}

}  // namespace
}  // namespace meander::test::even_spacing_tests
