// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a run says of how far it has come.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "api/lasting.h"
#include "api_flows.h"
#include "flow/progress.h"
#include "test_seeds.h"

namespace meander::test::progress_tests {
namespace {

FlowSettings with_polish() {
  FlowSettings settings;
  settings.polish = true;
  settings.growth_coarsening = 2;
  settings.hairpin_removal_iterations = 60;
  settings.iteration_limit = 600;
  return settings;
}

ProgressFigures at(Phase phase, uint32_t iterations_in_phase, double length) {
  return {phase, iterations_in_phase, length, 1, 0, 0};
}

TEST(Progress, RisesThroughAllPhases) {
  const FlowSettings settings = with_polish();
  double last = 0;
  const auto rises = [&](const ProgressFigures& figures) {
    const double progress = progress_of(settings, figures);
    EXPECT_GE(progress, last);
    EXPECT_LE(progress, 1);
    last = progress;
  };
  EXPECT_EQ(progress_of(settings, at(Phase::kGrowing, 0, 0)), 0);
  for (double length = 0; length < 1.3; length += 0.01) rises(at(Phase::kGrowing, 5, length));
  for (const Phase phase : {Phase::kHairpinRemoval, Phase::kPolishing, Phase::kFinishing}) {
    for (uint32_t k = 0; k < 200; ++k) {
      const double before = last;
      rises(at(phase, k, 1));
      if (phase == Phase::kFinishing && k > 0 && k < 60) {
        EXPECT_GT(last, before) << "it is to go on as long as the curve settles";
      }
    }
  }
  EXPECT_LT(last, 1) << "the curve has still to cool";
  for (uint32_t k = 0; k <= 6; ++k) rises(at(Phase::kCooling, k, 1));
  EXPECT_NEAR(last, 1, 1e-12);
}

TEST(Progress, OfALaidCurveRisesThroughAllPhases) {
  const FlowSettings settings = with_polish();
  double last = 0;
  const auto rises = [&](Phase phase, uint32_t iterations, double laid) {
    ProgressFigures figures = at(phase, iterations, 1);
    figures.full = true;
    figures.laid = laid;
    const double progress = progress_of(settings, figures);
    EXPECT_GE(progress, last);
    last = progress;
  };
  for (double laid = 0; laid < 1; laid += 0.1) rises(Phase::kStarting, 0, laid);
  for (const Phase phase : {Phase::kGrowing, Phase::kPolishing, Phase::kFinishing}) {
    for (uint32_t k = 0; k < 100; ++k) rises(phase, k, 1);
    EXPECT_LT(last, 1);
  }
  for (uint32_t k = 0; k <= 6; ++k) rises(Phase::kCooling, k, 1);
  EXPECT_NEAR(last, 1, 1e-12);
}

TEST(Progress, IsNoLessThanTheShareOfTheLimit) {
  FlowSettings settings = with_polish();
  settings.iteration_limit = 40;
  ProgressFigures figures = at(Phase::kGrowing, 30, 0.01);
  figures.iterations = 30;
  EXPECT_DOUBLE_EQ(progress_of(settings, figures), 0.75);
  figures.iterations = 40;
  EXPECT_EQ(progress_of(settings, figures), 1);
}

TEST(Progress, CountsTheIterationsThatAreAskedFor) {
  FlowSettings settings = with_polish();
  const double usual = progress_of(settings, at(Phase::kPolishing, 0, 1));
  settings.hairpin_removal_iterations = 300;
  EXPECT_GT(progress_of(settings, at(Phase::kPolishing, 0, 1)), usual);
  EXPECT_LT(progress_of(settings, at(Phase::kHairpinRemoval, 60, 1)), usual);
  settings = with_polish();
  settings.hairpin_removal_gentleness = 1;  // with a longer polish
  EXPECT_LT(progress_of(settings, at(Phase::kPolishing, 0, 1)), usual);
}

/// On a mesh of many faces a node most of the time passes until the first curve is laid.
TEST(Progress, OfALaidCurveKnowsTheFaces) {
  const FlowSettings settings = with_polish();
  const auto when_laid = [&](double faces_a_node) {
    ProgressFigures figures = at(Phase::kStarting, 0, 0);
    figures.full = true;
    figures.faces_a_node = faces_a_node;
    figures.laid = 1;
    const double laid = progress_of(settings, figures);
    figures.phase = Phase::kGrowing;
    EXPECT_DOUBLE_EQ(progress_of(settings, figures), laid);
    return laid;
  };
  const double few = when_laid(0.1);
  EXPECT_DOUBLE_EQ(when_laid(1), few);
  EXPECT_LT(few, 0.5);
  EXPECT_GT(when_laid(50), 0.6);
  EXPECT_GT(when_laid(200), when_laid(50));
  EXPECT_LT(when_laid(200), 1);
}

TEST(Progress, OfASurfaceAndAFlowRisesToOne) {
  const Mesh mesh = sphere(4);
  std::vector<double> told;
  const Tell tell = [&](double share) { told.push_back(share); };
  const auto check = [&](const char* what) {
    SCOPED_TRACE(what);
    EXPECT_GE(told.size(), 2u);
    EXPECT_TRUE(std::ranges::is_sorted(told));
    EXPECT_TRUE(std::ranges::all_of(told, [](double share) { return share > 0 && share <= 1; }));
    told.clear();
  };
  const auto surface = std::make_shared<const Surface>(mesh.vertices, mesh.faces, 1, CancelToken(), tell);
  check("surface");
  FlowSettings settings = with_polish();
  settings.radius = 0.1;
  const Flow flow(surface, nullptr, {}, settings, {}, tell);
  check("flow");
}

/// Of many faces no part stands still for more than a quarter of the way: neither while a surface is made and looked
/// through, nor while it is mended, nor while it is smoothed and cut into patches.
TEST(Progress, OfManyFacesNeverStandsLong) {
  const Mesh smooth = sphere(6), rough = with_noise(smooth, 0.3, 1);
  Mesh doubled = smooth;
  doubled.faces.insert(doubled.faces.end(), smooth.faces.begin(), smooth.faces.begin() + 3);
  auto options = prepared<meander_surface_options>();
  options.drop_doubled = options.drop_degenerate = options.make_manifold = 1;
  options.weld_distance = 1e-6;
  options.threads = 1;
  const std::vector<std::pair<std::string, Mesh>> cases{{"smooth", smooth}, {"rough", rough}, {"doubled", doubled}};
  for (const auto& [name, mesh] : cases) {
    SCOPED_TRACE(name);
    double last = 0, largest = 0;
    const Tell tell = [&](double share) {
      EXPECT_GE(share, last);
      largest = std::max(largest, share - last);
      last = share;
    };
    const auto check = [&](const char* what) {
      SCOPED_TRACE(what);
      EXPECT_LE(last, 1);
      EXPECT_LE(std::max(largest, 1 - last), 0.25);
      last = largest = 0;
    };
    const auto made = new_surface(mesh.vertices.data(), mesh.vertex_count(), mesh.faces.data(), mesh.face_count(),
                                  &options, {}, tell);
    check("surface");
    FlowSettings settings = with_polish();
    settings.threads = 1;  // of several the one that tells may have little to do
    settings.radius = 0.02;
    settings.segment_length = 0.5 * settings.radius;
    settings.max_radius = 3 * settings.radius;
    settings.medial_axis = MedialAxis::kGeodesic;
    settings.roughness = 0;
    const Flow flow(made->surface, nullptr, {}, settings, {}, tell);
    EXPECT_EQ(flow.roughness().smoothing > 0, name == "rough");
    check("flow");
  }
}

/// Without a polish the quiet iterations, at whose number the paper's rule ends a run, lead to the end.
TEST(Progress, OfThePapersRuleEndsWithItsQuietIterations) {
  FlowSettings settings;
  settings.stop_rule = StopRule::kPaper;
  settings.iteration_limit = 300;
  ProgressFigures figures = at(Phase::kGrowing, 20, 0.97);
  double last = progress_of(settings, figures);
  EXPECT_LT(last, 0.7);
  for (figures.quiet_iterations = 1; figures.quiet_iterations <= 10; ++figures.quiet_iterations) {
    const double progress = progress_of(settings, figures);
    EXPECT_GT(progress, last);
    last = progress;
  }
  EXPECT_EQ(last, 1);
}

/// At x % of the work, counted in nodes, about x % of it has been told, through all phases to the end.
TEST(Progress, OfARunFollowsItsWork) {
  for (const uint32_t preset : {MEANDER_PRESET_EVEN, MEANDER_PRESET_PAPER}) {
    for (const bool dense : {false, true}) {
      // Of the whole, in the mean over the iterations; a run of the paper's has only some thirty.
      const double most_off = preset == MEANDER_PRESET_PAPER ? 0.15 : 0.1;
      SCOPED_TRACE(testing::Message() << "preset " << preset << (dense ? ", density" : ""));
      const auto surface = std::make_shared<const Surface>(make_surface(sphere(3)));
      VertexData<double> density(dense ? surface->vertex_count() : 0);
      for (uint32_t v = 0; v < density.size(); ++v) density[v] = surface->position(v).z() > 0 ? 4 : 1;
      Flow flow(surface, nullptr, density, checked_settings(options_of(0.25, preset), *surface));
      std::vector<double> told;
      flow.run(kNeverCancelled, [&](double progress) { told.push_back(progress); });
      ASSERT_EQ(told.size(), flow.history().size() + 1);
      EXPECT_EQ(told.back(), 1);
      EXPECT_LT(told.front(), 0.1);
      double work = 0, done = 0, off = 0;
      for (const IterationRecord& record : flow.history()) work += record.nodes;
      for (size_t k = 0; k < flow.history().size(); ++k) {
        done += flow.history()[k].nodes;
        EXPECT_GE(told[k], k > 0 ? told[k - 1] : 0);
        off += std::abs(told[k] - done / work) / static_cast<double>(flow.history().size());
      }
      EXPECT_LT(off, most_off);
    }
  }
}

Flow flow_that_begins_full() {
  auto surface = std::make_shared<const Surface>(make_surface(sphere(3)));
  meander_flow_options options = options_of(0.1);
  options.start = MEANDER_START_FULL;
  const FlowSettings settings = checked_settings(options, *surface);
  return Flow(std::move(surface), nullptr, {}, settings);
}

/// Of a long run laying takes a third.
TEST(Progress, IsToldWhileAFirstCurveIsLaid) {
  Flow flow = flow_that_begins_full();
  std::vector<double> told{0};
  ASSERT_TRUE(flow.step(kNeverCancelled, [&](double progress) { told.push_back(progress); }));
  ASSERT_GT(told.size(), 5u);
  for (size_t k = 1; k < told.size(); ++k) EXPECT_GT(told[k], told[k - 1]);
  EXPECT_GT(told.back(), 0.2);
  EXPECT_LT(told.back(), flow.progress());
}

/// No step of laying stands still for long, nor do the iterations after it in which the curve grows no more.
TEST(Progress, MovesAllTheWayOfACurveThatBeginsFull) {
  Flow flow = flow_that_begins_full();
  std::vector<double> told{0};
  const auto note = [&](double progress) { told.push_back(progress); };
  ASSERT_TRUE(flow.step(kNeverCancelled, note));
  double longest = 0;
  for (size_t k = 1; k < told.size(); ++k) longest = std::max(longest, told[k] - told[k - 1]);
  EXPECT_LT(longest, 0.25 * told.back());
  told = {flow.progress()};
  while (flow.stop_reason() == StopReason::kRunning) {
    ASSERT_TRUE(flow.step(kNeverCancelled, note));
    told.push_back(flow.progress());
  }
  size_t still = 0;
  for (size_t k = 1; k < told.size(); ++k) still += !(told[k] > told[k - 1]);
  EXPECT_LE(still, 1u) << "of " << told.size();
}

TEST(Progress, IsOneAtTheEndOfARunThatThrows) {
  const auto surface = std::make_shared<const Surface>(make_surface(sphere(2)));
  Flow flow(surface, nullptr, {}, checked_settings(options_of(0.3), *surface));
  int asked = 0;
  double told = 0;
  const auto fail = [&]() -> bool {
    if (++asked == 8) throw std::runtime_error("no more");
    return false;
  };
  EXPECT_THROW(flow.run(fail, [&](double progress) { told = progress; }), std::runtime_error);
  EXPECT_EQ(told, 1);
}

// A host without threads steps, and shows the progress.
TEST(Progress, OfStepsIsToldToTheirContext) {
  const FlowHandle flow = make_flow(sphere(2), options_with(0.6));
  meander_context* made = nullptr;
  ASSERT_EQ(meander_context_create(&made, nullptr), MEANDER_STATUS_OK);
  const ContextHandle context(made);
  double told = 0;
  while (meander_flow_stop_reason(flow.get()) == MEANDER_STOP_REASON_RUNNING) {
    ASSERT_EQ(meander_flow_step(flow.get(), made, nullptr), MEANDER_STATUS_OK);
    EXPECT_GE(meander_context_progress(made), told);
    EXPECT_NE(meander_context_phase(made), MEANDER_PHASE_NONE);
    told = meander_context_progress(made);
  }
  EXPECT_GT(told, 0.5);
  EXPECT_LE(told, 1);
  meander_context_reset(made);
  EXPECT_EQ(meander_context_progress(made), 0);
}

}  // namespace
}  // namespace meander::test::progress_tests
