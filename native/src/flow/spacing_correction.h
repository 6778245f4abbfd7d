// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where strands come to rest too near to one another, or too far apart, r is made up for it while they are polished.
#pragma once

#include "flow/plan.h"
#include "flow/flow_state.h"
#include "medial/radii.h"

namespace meander {

/// What r is to be multiplied by in the iteration after that of `plan`, at whose begin this is the state and these are
/// the radii of its curve. At most kMostCorrection from 1.
double next_correction(const IterationPlan& plan, const FlowState& before, const NodeData<Radii>& radii);

}  // namespace meander
