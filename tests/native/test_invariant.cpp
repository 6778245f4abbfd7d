// SPDX-License-Identifier: GPL-3.0-or-later
//
// A defect in an iteration is found in the same iteration, in every build, and the curve stays as it was before it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "base/failure.h"
#include "flow/flow.h"
#include "flow/invariant.h"
#include "flow/iteration.h"
#include "curves.h"

namespace meander::test::invariant_tests {
namespace {

const auto kNeverCancelled = [] { return false; };

const std::shared_ptr<const Surface>& flow_surface() {
  static const auto surface = std::make_shared<const Surface>(make_surface(sphere(3)));
  return surface;
}

/// A stroke between two fixed points, which has grown for a while.
std::unique_ptr<Flow> grown_flow() {
  FlowSettings s;
  s.radius = 0.03;
  s.segment_length = 0.2 * s.radius;
  s.max_radius = 3 * s.radius;
  s.bending_weight = 1;
  s.grow_into_empty = true;
  s.iteration_limit = 100;
  s.threads = 1;
  SeedStrands seed;
  for (const double x : {-0.9, -0.3, 0.3, 0.9}) seed.points.push_back(Vec3(x, 0.2, 1));
  seed.offsets = {0, 4};
  seed.closed = {0};
  seed.fixed = {1, 0, 0, 1};
  seed.guides = {0};
  seed.max_distance = 1;
  auto flow = std::make_unique<Flow>(flow_surface(), &seed, VertexData<double>{}, s);
  for (int k = 0; k < 12; ++k) EXPECT_TRUE(flow->step(kNeverCancelled));
  return flow;
}

bool same_curve(const Curve& a, const Curve& b) {
  if (a.size() != b.size() || a.fixed != b.fixed) return false;
  for (uint32_t i = 0; i < a.size(); ++i) {
    if (!same_bytes(a.nodes[i], b.nodes[i]) || a.paths[i].size() != b.paths[i].size()) return false;
    for (size_t k = 0; k < a.paths[i].size(); ++k) {
      if (a.paths[i][k].e != b.paths[i][k].e || a.paths[i][k].t != b.paths[i][k].t) return false;
    }
  }
  return true;
}

struct Fault {
  const char* name;
  const char* said;  ///< is part of the sentence
  std::function<void(Curve&)> make;
};

const std::vector<Fault>& faults() {
  static const std::vector<Fault> all = {
      {"NotANumber", "left its face", [](Curve& c) { c.nodes[c.size() / 2].b.x = std::nan(""); }},
      {"BesideTheFace", "left its face", [](Curve& c) { c.nodes[c.size() / 2].b = {0.75, 0.5}; }},
      {"NoSuchFace", "left its face", [](Curve& c) { c.nodes[c.size() / 2].face = UINT32_MAX; }},
      {"FixedPointByOneUnit", "fixed point",
       [](Curve& c) { c.nodes[0].b.x = std::nextafter(c.nodes[0].b.x, 1.0); }},
      {"FixedPointSetFree", "fixed point", [](Curve& c) { c.fixed.back() = 0; }},
      {"FixedPointTooMany", "fixed point", [](Curve& c) { c.fixed[c.size() / 2] = 1; }},
      {"StrandClosed", "strand", [](Curve& c) { c.strands[0].closed = true; }},
      {"StrandLost", "strand", [](Curve& c) { c.strands.clear(); }},
      {"StrandCutShort", "strand", [](Curve& c) { --c.strands[0].count; }},
      {"StrandMadeAGuide", "strand", [](Curve& c) { c.strands[0].guide = true; }},
      {"LengthInfinite", "length",
       [](Curve& c) { c.shapes[c.size() / 2].length = std::numeric_limits<double>::infinity(); }},
      {"PathsThatLeadNowhere", "left the surface",
       [](Curve& c) {
         for (Path& path : c.paths) {
           if (!path.empty()) path.pop_back();
         }
       }},
      {"PathsOverTheEndOfAnEdge", "left the surface",
       [](Curve& c) {
         for (Path& path : c.paths) {
           if (!path.empty()) path.front().t = 1;
         }
       }},
  };
  return all;
}

class Faults : public testing::TestWithParam<Fault> {};

/// Iterations one by one, in the state of a flow.
struct Iterations {
  explicit Iterations(const Flow& flow)
      : state{{flow.curve(), {}, {}}, flow.settings(),
              Domain(flow_surface(), VertexData<double>(), flow.settings(), pool)} {}

  /// `fault` spoils the next curve before it is looked at.
  void iterate(const std::function<void(Curve&)>& fault = {}) {
    update_metric(state, pool);
    Iteration iteration(state, plan_iteration(state.settings, Phase::kGrowing), work, pool);
    iteration.measure();
    iteration.solve();
    iteration.move();
    iteration.refine();
    if (fault) fault(iteration.after().curve);
    iteration.check(record.history.size() + 1);
    record.make_room();
    iteration.commit(state, record, 0);
  }

  ThreadPool pool{1};
  FlowState state;
  RunRecord record;
  Workspace work;
};

TEST_P(Faults, LeaveTheCurveOfTheIterationBefore) {
  const auto flow = grown_flow();
  Iterations spoiled(*flow), undisturbed(*flow);
  for (Iterations* all : {&spoiled, &undisturbed}) all->iterate();
  const Curve before = spoiled.state.curve;
  ASSERT_GT(before.size(), 100u);
  EXPECT_FALSE(same_curve(before, flow->curve()));
  for (int attempt = 0; attempt < 2; ++attempt) {  // it is found again, where somebody goes on nevertheless
    try {
      spoiled.iterate(GetParam().make);
      FAIL() << "the fault was not found";
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.kind, FailureKind::kInternal);
      const std::string sentence = failure.what();
      EXPECT_NE(sentence.find("iteration 2"), std::string::npos) << sentence;
      EXPECT_NE(sentence.find(GetParam().said), std::string::npos) << sentence;
    }
    EXPECT_TRUE(same_curve(spoiled.state.curve, before));
    EXPECT_TRUE(whole(*flow_surface(), spoiled.state.curve));
    EXPECT_EQ(spoiled.record.history.size(), 1u);
  }
  // Nothing of the iteration has stayed: without the fault the flow goes on as if there had been none.
  for (int k = 0; k < 5; ++k) {
    for (Iterations* all : {&spoiled, &undisturbed}) all->iterate();
  }
  EXPECT_TRUE(same_curve(spoiled.state.curve, undisturbed.state.curve));
}

INSTANTIATE_TEST_SUITE_P(Invariant, Faults, testing::ValuesIn(faults()),
                         [](const auto& fault) { return std::string(fault.param.name); });

/// A fault in one path only is found within as many iterations as there are turns.
TEST(Invariant, EveryPathHasItsTurn) {
  const auto flow = grown_flow();
  const Curve& curve = flow->curve();
  ThreadPool pool(2);
  size_t spoiled = 0;
  for (uint32_t i = 0; i < curve.size() && spoiled < 20; ++i) {
    if (!curve.has_segment(i) || curve.paths[i].empty()) continue;
    Curve after = curve;
    after.paths[i].pop_back();
    size_t found = 0;
    for (size_t turn = 0; turn < kPathTurns; ++turn) {
      found += broken_promise(flow->surface(), curve, after, turn + 1000, pool).empty() ? 0 : 1;
    }
    EXPECT_EQ(found, 1u) << "segment " << i;
    ++spoiled;
  }
  EXPECT_EQ(spoiled, 20u);
}

}  // namespace
}  // namespace meander::test::invariant_tests
