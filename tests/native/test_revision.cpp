// SPDX-License-Identifier: GPL-3.0-or-later
//
// Another spacing, density or weights for a flow that has a curve: it goes on from where it is, and soon fits.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "api_flows.h"
#include "outputs/statistics.h"
#include "curves.h"

namespace meander::test::revision_tests {
namespace {

void run(const FlowHandle& flow) { ASSERT_EQ(meander_flow_run(flow.get(), nullptr, nullptr), MEANDER_STATUS_OK); }

/// The sentence of a refusal; empty where there was none.
std::string set_spacing(const FlowHandle& flow, double spacing) {
  auto error = prepared<meander_error>();
  return meander_flow_set_radius(flow.get(), 0.5 * spacing, &error) == MEANDER_STATUS_OK ? "" : error.text;
}

std::string set_density(const FlowHandle& flow, const std::vector<double>& density) {
  auto error = prepared<meander_error>();
  const double* values = density.empty() ? nullptr : density.data();
  return meander_flow_set_density(flow.get(), values, density.size(), &error) == MEANDER_STATUS_OK ? "" : error.text;
}

std::string set_options(const FlowHandle& flow, const meander_flow_options& options) {
  auto error = prepared<meander_error>();
  return meander_flow_set_options(flow.get(), &options, &error) == MEANDER_STATUS_OK ? "" : error.text;
}

/// Of both sides of all nodes, the share with a medial radius within a fifth of r.
double near_target(const FlowHandle& flow) {
  const Statistics measure = statistics_of(*flow->flow);
  const double wanted = 2 * flow->flow->settings().radius;
  double near = 0;
  for (const double spacing : measure.spacing) near += std::abs(spacing / wanted - 1) <= 0.2;
  return near / static_cast<double>(measure.spacing.size());
}

/// Where a node is, in the units of the mesh that the flow was made with.
Vec3 caller_point(const FlowHandle& flow, const SurfacePoint& p) {
  const Surface& s = flow->flow->surface();
  Vec3 at = Vec3::Zero();
  for (uint32_t k = 0; k < 3; ++k) at += p.weight(k) * s.caller_position(s.face(p.face)[k]);
  return at;
}

/// Four where a point of the unit sphere lies above the middle, else one.
std::vector<double> denser_above(const Mesh& mesh) {
  std::vector<double> density(mesh.vertex_count());
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) density[v] = mesh.at(v).z() > 0 ? 4 : 1;
  return density;
}

TEST(Revision, AFinishedCurveFitsAnotherSpacingSoon) {
  const FlowHandle flow = make_flow(sphere(3), options_with(0.2));
  run(flow);
  const size_t from_scratch = flow->flow->history().size();
  const double before = near_target(flow);
  for (const double spacing : {0.18, 0.2}) {  // closer, where the curve grows, and wider, where it shrinks
    const size_t done = flow->flow->history().size();
    const double length = flow->flow->curve().length();
    ASSERT_EQ(set_spacing(flow, spacing), "");
    EXPECT_EQ(meander_flow_stop_reason(flow.get()), MEANDER_STOP_REASON_RUNNING);
    expect_valid(flow);
    run(flow);
    expect_valid(flow);
    EXPECT_EQ(meander_flow_stop_reason(flow.get()), MEANDER_STOP_REASON_CONVERGED);
    EXPECT_LT(4 * (flow->flow->history().size() - done), from_scratch);
    EXPECT_EQ(flow->flow->curve().length() > length, spacing < 0.2);
    EXPECT_GT(packing(flow), 0.92);
    EXPECT_LT(packing(flow), 1.06);
    EXPECT_GT(near_target(flow), before - 0.04);
    EXPECT_EQ(flow->flow->curve().strands.size(), 1u);
  }
}

/// Fitted again and again, a curve would become uneven.
TEST(Revision, ManySmallChangesLetItGrowAgain) {
  const FlowHandle flow = make_flow(sphere(3), options_with(0.4));
  run(flow);
  int grown = 0;
  for (int k = 1; k <= 10; ++k) {
    ASSERT_EQ(set_spacing(flow, 0.4 * std::pow(0.94, k)), "");
    grown += !flow->flow->polishing();
    run(flow);
  }
  EXPECT_GE(grown, 2);
  EXPECT_LE(grown, 4);
  expect_valid(flow);
}

TEST(Revision, DensityChangesTheSpacingWhereItDoes) {
  const Mesh mesh = sphere(4);
  const FlowHandle flow = make_flow(mesh, options_with(0.3));
  run(flow);
  ASSERT_EQ(set_density(flow, denser_above(mesh)), "");
  run(flow);
  expect_valid(flow);
  double above = 0, below = 0;
  const Curve& curve = flow->flow->curve();
  for (uint32_t i = 0; i < curve.size(); ++i) {
    if (!curve.has_segment(i)) continue;
    const double z = caller_point(flow, curve.nodes[i]).z();
    (z > 0 ? above : below) += curve.shapes[i].length;
  }
  // Strands twice as close: twice the length on the same area.
  EXPECT_NEAR(above / below, 2, 0.2);
  EXPECT_GT(near_target(flow), 0.8);
  // And taken back again.
  ASSERT_EQ(set_density(flow, {}), "");
  run(flow);
  expect_valid(flow);
  EXPECT_NEAR(packing(flow), 1, 0.08);
}

TEST(Revision, OtherWeightsOfGrowthLetItGrowAgain) {
  const FlowHandle flow = make_flow(sphere(3), options_with(0.3));
  run(flow);
  meander_flow_options options = options_with(0.3);
  options.polish_bending_weight = 3;
  ASSERT_EQ(set_options(flow, options), "");
  EXPECT_TRUE(flow->flow->polishing());
  options.length_weight = 0.5;
  ASSERT_EQ(set_options(flow, options), "");
  EXPECT_FALSE(flow->flow->polishing());
  run(flow);
  expect_valid(flow);
  EXPECT_TRUE(flow->flow->polishing());
  // As published: no polish, which begins with growth too.
  ASSERT_EQ(set_options(flow, options_with(0.3, 1, MEANDER_PRESET_PAPER)), "");
  EXPECT_FALSE(flow->flow->polishing());
  step(flow, 3);
  expect_valid(flow);
}

TEST(Revision, WhatIsThereAlreadyChangesNothing) {
  const Mesh mesh = sphere(3);
  const meander_flow_options options = options_with(0.3);
  const FlowHandle flow = make_flow(mesh, options);
  run(flow);
  const Curve before = flow->flow->curve();
  EXPECT_EQ(set_spacing(flow, 0.3), "");
  EXPECT_EQ(set_density(flow, {}), "");
  EXPECT_EQ(set_options(flow, options), "");
  EXPECT_EQ(meander_flow_stop_reason(flow.get()), MEANDER_STOP_REASON_CONVERGED);
  EXPECT_TRUE(same_nodes(before, flow->flow->curve()));
}

TEST(Revision, WhatIsRefusedLeavesTheFlowAsItWas) {
  const Mesh mesh = sphere(3);
  const FlowHandle flow = make_flow(mesh, options_with(0.3)), other = make_flow(mesh, options_with(0.3));
  step(flow, 40);
  step(other, 40);
  for (const double spacing : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1e9, 1e-9}) {
    EXPECT_NE(set_spacing(flow, spacing), "") << spacing;
  }
  std::vector<double> density(mesh.vertex_count(), 1);
  EXPECT_NE(set_density(flow, {1.0, 2.0}), "");
  density[5] = -1;
  EXPECT_NE(set_density(flow, density).find("vertex 5"), std::string::npos);
  density[5] = 1e-3;
  EXPECT_NE(set_density(flow, density).find("vertex 5"), std::string::npos);
  meander_flow_options options = options_with(0.3);
  options.length_weight = -1;
  EXPECT_NE(set_options(flow, options), "");
  EXPECT_EQ(meander_flow_set_options(flow.get(), nullptr, nullptr), MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(meander_flow_set_radius(nullptr, 1, nullptr), MEANDER_STATUS_INVALID_ARGUMENT);
  step(flow, 5);
  step(other, 5);
  EXPECT_TRUE(same_nodes(flow->flow->curve(), other->flow->curve()));
}

TEST(Revision, IsRefusedWhileARunIsGoing) {
  const FlowHandle flow = make_flow(sphere(3), options_with(0.3));
  ASSERT_EQ(meander_flow_start(flow.get(), nullptr, nullptr), MEANDER_STATUS_OK);
  EXPECT_NE(set_spacing(flow, 0.25).find("meander_flow_wait"), std::string::npos);
  EXPECT_NE(set_density(flow, {}), "");
  EXPECT_NE(set_options(flow, options_with(0.25)), "");
  EXPECT_EQ(meander_flow_wait(flow.get(), nullptr), MEANDER_STATUS_OK);
  EXPECT_EQ(set_spacing(flow, 0.25), "");
}

TEST(Revision, FixedNodesAndGuidesStay) {
  const Mesh mesh = flat_grid(12);
  const double points[] = {0.2, 0.2, 0, 0.5, 0.25, 0, 0.8, 0.2, 0, 0.2, 0.7, 0, 0.8, 0.75, 0};
  const uint64_t offsets[] = {0, 3, 5};
  const uint8_t closed[] = {0, 0}, fixed[] = {1, 0, 1, 0, 0}, guides[] = {0, 1};
  const meander_seed seed = seed_in(points, offsets, closed, fixed, guides);
  const FlowHandle flow = make_flow(mesh, options_with(0.1), &seed);
  step(flow, 30);
  const Curve before = flow->flow->curve();
  const auto ends = [](const Curve& c, uint32_t strand) {
    return std::vector{c.nodes[c.strands[strand].first], c.nodes[c.strands[strand].end() - 1]};
  };
  for (const double spacing : {0.06, 0.12}) {
    ASSERT_EQ(set_spacing(flow, spacing), "");
    step(flow, 10);
    expect_valid(flow);
    const Curve& after = flow->flow->curve();
    for (uint32_t s = 0; s < 2; ++s) {
      for (uint32_t k = 0; k < 2; ++k) EXPECT_TRUE(same_bytes(ends(before, s)[k], ends(after, s)[k]));
    }
    ASSERT_TRUE(after.strands[1].guide);
    for (uint32_t i = after.strands[1].first; i < after.strands[1].end(); ++i) {
      const Vec3 p = caller_point(flow, after.nodes[i]);
      EXPECT_NEAR(p.y(), 0.7 + (p.x() - 0.2) / 12, 1e-9);
    }
  }
}

/// Whatever the number of threads, and the unit of the mesh.
TEST(Revision, GivesTheSameBytes) {
  const Mesh mesh = sphere(3);
  Mesh large = mesh;
  for (double& x : large.vertices) x *= 1000;
  const auto flow_after = [](const Mesh& m, double unit, uint32_t threads) {
    FlowHandle flow = make_flow(m, options_with(0.3 * unit, threads));
    step(flow, 20);  // while it grows
    EXPECT_EQ(set_spacing(flow, 0.27 * unit), "");
    run(flow);
    std::vector<double> density(m.vertex_count());
    for (uint32_t v = 0; v < m.vertex_count(); ++v) density[v] = 1 + 0.2 * m.at(v).z() / unit;
    EXPECT_EQ(set_density(flow, density), "");
    step(flow, 10);
    EXPECT_EQ(set_spacing(flow, 0.28 * unit), "");
    run(flow);
    return flow;
  };
  const FlowHandle one = flow_after(mesh, 1, 1), three = flow_after(mesh, 1, 3), scaled = flow_after(large, 1000, 2);
  EXPECT_TRUE(same_nodes(one->flow->curve(), three->flow->curve()));
  EXPECT_EQ(one->flow->curve().size(), scaled->flow->curve().size());
  expect_valid(three);
}

}  // namespace
}  // namespace meander::test::revision_tests
