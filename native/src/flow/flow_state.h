// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an iteration begins with, and leaves changed.
#pragma once

#include "curve/curve.h"
#include "curve/local_metric.h"
#include "flow/domain.h"
#include "flow/node_history.h"

namespace meander {

/// A flow between two iterations, without how long it has been running. Whoever wants to change what a flow is about
/// (its surface, its spacing) builds another one, and puts it in the place of this when nothing can fail any more.
struct FlowState {
  FlowSettings settings;
  Domain domain;
  Curve curve;
  LocalMetric metric;  ///< of the present curve, see update_metric
  NodeHistory nodes;
};

/// Finds the shapes of all segments again on a surface with the same faces whose vertices are elsewhere. Paths are as
/// they were, and not the shortest any more; see Retraction::straighten.
void measure_segments(const Surface& surface, Curve& curve, ThreadPool& pool);

/// Finds r, r_max and what the boundary asks for at every node of the present curve.
void update_metric(FlowState& state, ThreadPool& pool);

}  // namespace meander
