// SPDX-License-Identifier: GPL-3.0-or-later
//
// The step of one iteration (eq. 10): by how much every node is to move.
#pragma once

#include <vector>

#include "flow/flow_state.h"
#include "flow/plan.h"
#include "medial/free_ends.h"
#include "medial/medial_state.h"
#include "model/strand_solver.h"

namespace meander {

/// Keeps its memory from iteration to iteration. One call at a time.
class Step {
 public:
  /// The displacements of all nodes in the planes of their faces, in the surface's unit: what the model asks for, with
  /// what is left of the last step, and no longer than it may be; 0 for guides and fixed nodes. They stay until the
  /// next call.
  const NodeData<Vec2>& find(const IterationPlan& plan, const FlowState& state, const MedialState& medial,
                             const Weights& weights, StrandSolver& strands, ThreadPool& pool);

  /// Hands the memory of a call on.
  void hand_on() noexcept { meander::hand_on(driving_radii_, displacement_); }

 private:
  const NodeData<Radii>& driving_radii(const FlowState& state, const MedialState& medial, ThreadPool& pool);
  void solve_strands(const FlowState& state, const MedialState& medial, const Weights& weights, StrandSolver& strands,
                     ThreadPool& pool);

  NodeData<Radii> driving_radii_;
  NodeData<Vec2> displacement_;
  std::vector<FreeEnd> ends_;  // that are held at r from what is ahead of them, in the order of the nodes
};

/// Keeps displacements in `steps` for the next iteration if they will count there; else forgets what was there. The
/// nodes will lie in other faces then, but their tangents say the same.
void remember_steps(const IterationPlan& plan, const NodeData<Vec2>& displacement, const Frames& frames,
                    ThreadPool& pool, NodeData<Vec2>& steps);

}  // namespace meander
