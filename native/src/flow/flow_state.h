// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an iteration begins with, and what it leaves in its place.
#pragma once

#include "curve/curve.h"
#include "curve/local_metric.h"
#include "flow/constants.h"
#include "flow/domain.h"
#include "flow/node_history.h"
#include "flow/start_report.h"

namespace meander {

/// A curve and what its nodes carry: what an iteration replaces.
struct CurveState {
  Curve curve;
  LocalMetric metric;  ///< of the curve, see update_metric
  NodeHistory nodes;

  /// Hands the memory of its lists on, but for paths, see Curve::hand_on; what they say is lost.
  void hand_on() noexcept {
    curve.hand_on();
    metric.hand_on();
    nodes.hand_on();
  }
};

/// A flow between two iterations, without how long it has been running. Whoever wants to change what a flow is about
/// (its surface, its spacing) builds another one, and puts it in the place of this when nothing can fail any more.
struct FlowState : CurveState {
  FlowSettings settings;
  Domain domain;
  StartReport start = {};

  /// Whether tips of hairpins are bent more once segments are short. They push strands apart, which nothing makes up
  /// for in narrow parts, on what has moved, and where strands are to be nearer or farther apart than usual.
  bool rounds_tips() const {
    return settings.polish && settings.polish_rest == kUsualRest && !domain.narrow && !domain.was_moved;
  }
};

/// Finds the shapes of all segments again on a surface with the same faces whose vertices are elsewhere. Paths are as
/// they were, and not the shortest any more; see Retraction::straighten.
void measure_segments(const Surface& surface, Curve& curve, ThreadPool& pool);

/// Finds r, r_max and what the boundary asks for at every node of a curve.
void update_metric(const FlowSettings& settings, const Domain& domain, CurveState& state, ThreadPool& pool);
inline void update_metric(FlowState& state, ThreadPool& pool) {
  update_metric(state.settings, state.domain, state, pool);
}

/// The length of a curve on the surface as it was given, in the unit of that.
double length_as_given(const Domain& domain, const Curve& curve);

}  // namespace meander
