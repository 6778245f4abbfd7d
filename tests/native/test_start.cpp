// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a run begins is part of its state: what was decided in between is kept, and what fails has never happened.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "api_flows.h"
#include "outputs/polylines.h"
#include "test_seeds.h"

namespace meander::test::start_tests {
namespace {

/// A curve as a seed.
SeedStrands seed_of(const Surface& surface, const Curve& curve) {
  SeedStrands seed;
  seed.offsets.push_back(0);
  for (const Strand& strand : curve.strands) {
    for (uint32_t i = strand.first; i < strand.end(); ++i) {
      const SurfacePoint& p = curve.nodes[i];
      seed.points.push_back(caller_point(surface, p.face, {p.weight(0), p.b.x, p.b.y}));
    }
    seed.offsets.push_back(static_cast<uint32_t>(seed.points.size()));
    seed.closed.push_back(strand.closed);
  }
  seed.fixed.resize(seed.points.size(), 0);
  return seed;
}

FlowSettings full_settings(const Surface& surface, double spacing, meander_preset preset = MEANDER_PRESET_EVEN) {
  meander_flow_options options = options_of(spacing, preset);
  options.start = MEANDER_START_FULL;
  return checked_settings(options, surface);
}

/// Nothing is laid where a curve fills the surface already, and that growing ends there was decided when it moved.
TEST(Start, AFinishedCurveOnAMovedSurfaceNeverGrowsFromScratch) {
  const auto surface = std::make_shared<const Surface>(make_surface(sphere(3)));
  const FlowSettings even = checked_settings(options_of(0.25), *surface);
  Flow grown(surface, nullptr, {}, even);
  ASSERT_EQ(grown.run(kNeverCancelled, [](double) {}), StopReason::kConverged);
  const SeedStrands seed = seed_of(*surface, grown.curve());
  std::vector<double> moved = sphere(3).vertices;
  for (size_t k = 0; k < moved.size(); k += 3) moved[k] *= 1.01;

  Flow flow(surface, &seed, {}, full_settings(*surface, 0.25, MEANDER_PRESET_FINEST));
  flow.set_vertices(moved);
  const double before = flow.length() * flow.surface().scale();
  for (int k = 0; k < 12; ++k) {
    ASSERT_TRUE(flow.step(kNeverCancelled));
    EXPECT_TRUE(flow.polishing());
    EXPECT_GT(flow.length() * flow.surface().scale(), 0.99 * before) << "iteration " << k;
  }
  EXPECT_TRUE(flow.start().full_asked);
  EXPECT_EQ(flow.start().full_parts(), 0u);
}

/// Whenever the first iteration is cancelled, also once the start has been laid: it takes more asks than the start.
TEST(Start, ACancelledFirstIterationHasNeverHappened) {
  const auto surface = std::make_shared<const Surface>(make_surface(sphere(4)));
  Flow flow(surface, nullptr, {}, full_settings(*surface, 0.1));
  const Curve before = flow.curve();
  int cancelled = 0, most = 0;
  for (int at = 1; at < 1 << 20; at += 1 + at / 3) {
    int asked = 0;
    const bool done = flow.step([&] { return ++asked > at; });
    most = std::max(most, asked);
    if (done) break;
    ++cancelled;
    ASSERT_TRUE(same_nodes(before, flow.curve())) << "ask " << at;
    ASSERT_TRUE(flow.history().empty());
    ASSERT_TRUE(flow.start().strands.empty());
    EXPECT_EQ(flow.stop_reason(), StopReason::kCancelled);
  }
  EXPECT_GT(cancelled, 10);
  EXPECT_EQ(flow.start().full_parts(), 1u);
  Flow other(surface, nullptr, {}, full_settings(*surface, 0.1));
  ASSERT_TRUE(other.step(kNeverCancelled));
  EXPECT_TRUE(same_nodes(other.curve(), flow.curve())) << "the same, however often it was cancelled";
}

/// The header names options without effect on a flow that has begun.
TEST(Start, WhatOnlyABeginningNeedsDoesNotMakeAFinishedFlowRunAgain) {
  for (const meander_start start : {MEANDER_START_GROW, MEANDER_START_FULL}) {
    meander_flow_options options = options_with(0.3);
    options.start = start;
    const FlowHandle flow = make_flow(sphere(3), options);
    ASSERT_EQ(meander_flow_run(flow.get(), nullptr, nullptr), MEANDER_STATUS_OK);
    const Curve before = flow->flow->curve();
    meander_flow_options others = options;
    others.widen_loops = 1 - others.widen_loops;
    others.start_spacing_factor = 3;
    others.start = start == MEANDER_START_GROW ? MEANDER_START_FULL : MEANDER_START_GROW;
    others.threads = 2;
    if (start == MEANDER_START_FULL) others.hairpin_removal_iterations += 5;
    ASSERT_EQ(meander_flow_set_options(flow.get(), &others, nullptr), MEANDER_STATUS_OK);
    EXPECT_EQ(meander_flow_stop_reason(flow.get()), MEANDER_STOP_REASON_CONVERGED);
    EXPECT_TRUE(same_nodes(before, flow->flow->curve()));
  }
}

TEST(Start, ARevisionBeforeTheFirstIterationLeavesTheStartToCome) {
  const auto surface = std::make_shared<const Surface>(make_surface(sphere(4)));
  Flow flow(surface, nullptr, {}, full_settings(*surface, 0.12));
  flow.revise(flow.settings().with_radius(0.8 * flow.settings().radius));
  ASSERT_TRUE(flow.step(kNeverCancelled));
  EXPECT_EQ(flow.start().full_parts(), 1u);
  EXPECT_GT(flow.curve().length() * 2 * flow.settings().radius, 0.8 * surface->area());
}

TEST(Start, FiguresSayHowItBegan) {
  const auto figures_of = [](const FlowHandle& flow) {
    auto figures = prepared<meander_flow_statistics>();
    EXPECT_EQ(meander_flow_compute_statistics(flow.get(), &figures, nullptr, nullptr), MEANDER_STATUS_OK);
    return figures;
  };
  meander_flow_options options = options_with(0.3);
  const FlowHandle grown = make_flow(sphere(3), options);
  step(grown, 1);
  EXPECT_EQ(figures_of(grown).start_asked_full, 0u);
  EXPECT_EQ(figures_of(grown).start_full_parts + figures_of(grown).start_grown_parts, 0u);
  options.start = MEANDER_START_FULL;
  // One part of two has no room for a line.
  const FlowHandle full = make_flow(joined(sphere(3), scaled(octahedron(), 0.01), 4), options);
  EXPECT_EQ(figures_of(full).start_asked_full, 1u);
  EXPECT_EQ(figures_of(full).start_full_parts, 0u);
  step(full, 1);
  const meander_flow_statistics figures = figures_of(full);
  EXPECT_EQ(figures.start_full_parts, 1u);
  EXPECT_EQ(figures.start_grown_parts, 1u);
  EXPECT_EQ(figures.start_no_room_parts + figures.start_crossing_parts, 1u);
}

}  // namespace
}  // namespace meander::test::start_tests
