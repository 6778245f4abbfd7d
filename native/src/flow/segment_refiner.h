// SPDX-License-Identifier: GPL-3.0-or-later
//
// Refinement of a flow's curve (section 3.3.2), and what nodes carry following it.
#pragma once

#include "curve/refinement.h"
#include "flow/flow_state.h"
#include "flow/plan.h"

namespace meander {

/// Keeps its memory from call to call. Where a call throws, the curve stays, and what its nodes carry is lost.
class SegmentRefiner {
 public:
  /// `test`  see Refinement
  explicit SegmentRefiner(std::shared_ptr<CrossingTest> test) : refinement_(std::move(test)) {}

  /// Splits and removes segments of what grows, as the plan has it: h is its segment length where r is the nominal
  /// one, and else in proportion. Guides stay as they are to the last bit. Finds the metric of the nodes as they were
  /// before.
  void refine(const FlowSettings& settings, const Domain& domain, CurveState& state, const IterationPlan& plan,
              ThreadPool& pool);
  void refine(FlowState& state, const IterationPlan& plan, ThreadPool& pool) {
    refine(state.settings, state.domain, state, plan, pool);
  }

  /// Cuts guides, where there are any, as finely as everything will be in the end, and all else as the plan has
  /// it: at first, and when the surface has moved.
  void cut_guides(FlowState& state, const IterationPlan& plan, ThreadPool& pool);

  /// Hands the memory of a call on.
  void hand_on() noexcept {
    refinement_.hand_on();
    meander::hand_on(targets_, origin_);
  }

 private:
  void apply(const FlowSettings& settings, const Domain& domain, CurveState& state, const IterationPlan& plan,
             double guide_length, ThreadPool& pool);

  Refinement refinement_;
  NodeData<double> targets_;
  NodeData<uint32_t> origin_;
};

}  // namespace meander
