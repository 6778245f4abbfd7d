// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/flow_state.h"

#include "medial/curve_bvh.h"

namespace meander {

void update_metric(FlowState& state, ThreadPool& pool) {
  const FlowSettings& s = state.settings;
  const MetricRules rules{s.max_radius / s.radius, CurveBvh::kMostRadius, s.boundary_distance};
  find_local_metric(*state.domain.surface, state.curve, state.domain.radius, rules, pool, state.metric);
}

}  // namespace meander
