// SPDX-License-Identifier: GPL-3.0-or-later
//
// The weights of the model in one iteration.
#pragma once

#include "flow/flow_state.h"
#include "flow/plan.h"
#include "medial/medial_state.h"
#include "model/strand_solver.h"
#include "model/weights.h"

namespace meander {

/// Fills all of `weights`, in the memory that they have: a function of the plan and the state alone. `medial` is of
/// the state's curve; `strands` only lends memory.
void choose_weights(const IterationPlan& plan, const FlowState& state, const MedialState& medial, StrandSolver& strands,
                    ThreadPool& pool, Weights& weights);

}  // namespace meander
