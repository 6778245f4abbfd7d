// SPDX-License-Identifier: GPL-3.0-or-later
//
// One iteration as a transaction (section 3): what it reads, what it writes, and the moment at which it counts.
#pragma once

#include <memory>
#include <optional>

#include "curve/retraction.h"
#include "flow/convergence.h"
#include "flow/flow_state.h"
#include "flow/run_record.h"
#include "flow/segment_refiner.h"
#include "flow/step.h"
#include "medial/medial_state.h"
#include "model/strand_solver.h"
#include "seed/full_start.h"

namespace meander {

/// What computes, and the memory that it keeps from iteration to iteration. Nothing in it says anything about a flow
/// between two calls.
struct Workspace {
  MedialState medial;
  Weights weights;
  StrandSolver strands;
  Step step;
  std::shared_ptr<CrossingTest> crossings = std::make_shared<CrossingTest>();  ///< for one at a time
  Retraction retraction{crossings};
  SegmentRefiner refiner{crossings};
  CurveState spare;  ///< a curve that nobody needs
  PageStore::Keeper keeper;  ///< of what one step hands on to the next one

  /// Gives long lists back to the system, after the last step for now.
  void give_back() noexcept;
};

/// Finds the medial axis of the curve of a state whose metric is up to date, in `medial`.
void find_medial_axis(const FlowState& state, const AtRest& known, const MedialPlan& plan, ThreadPool& pool,
                      MedialState& medial);

/// Reads the state of a flow, which stays as it is, and writes the next curve beside it, with what its nodes carry. The
/// steps are called in the order in which they stand here, each once. Each may throw, and nothing has happened then:
/// the iteration is left where it is, and there is nothing to roll back. One thread at a time; all that it is given
/// must outlive it.
///
/// Where the plan is to lay a curve, the laid one stands between both: the steps that follow read it.
class Iteration {
 public:
  /// `given`   with its metric up to date
  /// `plan`    what this iteration is about
  /// `work`    nobody else uses it meanwhile
  Iteration(const FlowState& given, const IterationPlan& plan, Workspace& work, ThreadPool& pool)
      : given_(given), plan_(plan), work_(work), pool_(pool) {}

  /// In the phases kStarting and kLayingRest: lays curves in what is empty. In the first the strands that were drawn,
  /// the first `drawn` ones, are left on both sides, and loops are replaced; in the other all strands are left so.
  /// Where nothing can be laid, the curve stays. `tell` hears how much is laid.
  void lay(size_t drawn, const Tell& tell);
  /// Finds the medial axis of the curve as it is (3.2.2).
  void measure();
  /// Builds the quadratic model of the energy (3.2), and finds the step to its minimum (eq. 10).
  void solve();
  /// Moves nodes along geodesics and joins them again, no farther than nothing crosses (3.3, 3.3.1).
  void move();
  /// Splits and removes segments; what nodes carry follows (3.3.2).
  void refine();
  /// Throws where the next curve is none that may be: what is a defect here ends the run with the curve before it, and
  /// not with a crash or a curve that cannot be made. `number` of this iteration, from 1.
  void check(size_t number);

  /// The next curve, from move() to commit(): complete after check().
  CurveState& after() { return work_.spare; }
  /// Complete after check().
  const IterationFigures& figures() const { return figures_; }

  /// Puts the next curve in the place of the one in `state`, which is the state before, and takes note of the
  /// iteration, which began `seconds` ago. `record` has room for it.
  void commit(FlowState& state, RunRecord& record, double seconds) noexcept;

 private:
  StartLines lines_to_lay() const;
  void lay_in_empty(size_t trunks, const Tell& tell);
  Curve with_short_segments();
  const FlowState& before() const { return laid_ ? *laid_ : given_; }

  const FlowState& given_;
  std::optional<FlowState> laid_;      // what the given curve became
  std::optional<StartReport> report_;  // what the state will say of its start, where that changes
  IterationPlan plan_;
  Workspace& work_;
  ThreadPool& pool_;
  const NodeData<Vec2>* displacement_ = nullptr;  // of the nodes before
  IterationFigures figures_;
  IterationRecord record_;
  FlowSeconds seconds_;
};

}  // namespace meander
