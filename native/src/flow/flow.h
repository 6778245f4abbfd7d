// SPDX-License-Identifier: GPL-3.0-or-later
//
// The flow: one iteration after another until the curve fills the surface (section 3).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/cancel_token.h"
#include "base/tell.h"
#include "base/thread_pool.h"
#include "flow/convergence.h"
#include "flow/flow_state.h"
#include "flow/iteration.h"
#include "flow/run_record.h"
#include "flow/spacing_approach.h"
#include "seed/seed.h"

namespace meander {

/// One thread at a time may use it, but for what says otherwise.
class Flow {
 public:
  /// `seed` null: face loops. `density`: positive; empty: 1 everywhere. Throws Failure, also where `cancel` stops it;
  /// `tell` is told how far it is.
  Flow(std::shared_ptr<const Surface> surface, const SeedStrands* seed, const VertexData<double>& density,
       const FlowSettings& settings, const CancelToken& cancel = {}, const Tell& tell = {});

  /// The lines that alignment_weight refers to; before the first iteration.
  void set_field(LineField field);

  /// One iteration; false, with everything as before, where `cancel` has stopped it. `tell` hears on the way how far
  /// the curve has come, where a first one is laid.
  bool step(const CancelToken& cancel, const Tell& tell = {});

  /// How far the curve has come, see progress.h.
  double progress() const;

  /// Steps until one of the reasons holds. `tell` hears how far the curve has come, see progress.h, after each step and
  /// while a first curve is laid, and 1 at the end, also where a step throws.
  StopReason run(const CancelToken& cancel, const Tell& tell);

  /// Moves the surface: `vertices` are its own, as many as before; `map` names the caller's in errors.
  /// Nodes stay on their faces where they are, segments become straight again, and lengths mean the same
  /// in the caller's units. A curve that fills the surface goes on in the polish. Counts for run() as a
  /// new beginning. Throws Failure for what Surface::deformed refuses and for a surface that has become too small
  /// or too large for the spacing, and where `cancel` stops it. Strong guarantee: if it throws, the flow is unchanged.
  void set_vertices(std::span<const double> vertices, const MeshMap* map = nullptr, const CancelToken& cancel = {});

  /// Asks for something else from here on: `settings` are those wanted on the present surface, `density` as for a new
  /// flow, null: as it is. What only a beginning needs (first loops, a wide start) and the number of threads stay.
  /// The curve goes on from where it is, see Convergence::revised; counts for run() as a new beginning. What asks for
  /// nothing else changes nothing. Strong guarantee: if it throws, the flow is unchanged.
  void revise(FlowSettings settings, const VertexData<double>* density = nullptr, const CancelToken& cancel = {});

  /// As it was given. The flow itself runs on it as it is at the scale of the spacing, see Domain; the curve is on
  /// both.
  const Surface& surface() const { return *state_.domain.given; }
  /// How rough it is, and what of that was smoothed.
  const Roughness& roughness() const { return state_.domain.roughness; }
  const Curve& curve() const { return state_.curve; }
  const FlowSettings& settings() const { return state_.settings; }
  /// r as it was asked for, and is to be in the end, on surface().
  const RadiusField& asked_radius() const { return state_.domain.asked_radius; }
  /// Of the curve on surface(), in its unit.
  double length() const;
  /// Found when they are asked for first: a flow that is not looked at needs none. Any thread.
  const NormalField& normals() const { return *state_.domain.normals; }
  /// Of a node, on surface(), as many times the local r as it was measured: at the last medial axis, or of the curve as
  /// it is once it was asked about. 0 before the first.
  Radii radii_of(uint32_t node) const;
  /// Those of all nodes; empty before the first medial axis.
  NodeData<Radii> radii() const;
  const std::vector<IterationRecord>& history() const { return record_.history; }
  const FlowSeconds& seconds() const { return record_.seconds; }
  /// Why a run would end now; kCancelled after a cancelled step or run, until the next one.
  StopReason stop_reason() const;
  /// Is it past its growth?
  Phase phase() const { return convergence_.phase(); }
  bool polishing() const { return plan().polishing; }
  /// How it began, in the phase kStarting, and what was laid since.
  const StartReport& start() const { return state_.start; }
  /// How well the seed fitted the surface that the flow began on.
  const SeedFit& seed_fit() const { return seed_fit_; }

  /// The curve as it is now, on the surface that the flow runs on.
  struct Present {
    const FlowState& state;
    const MedialState& medial;  ///< of the curve, as exact as may be
    IterationPlan plan;         ///< of the next iteration
    double spacing_factor;      ///< what r is multiplied by while the curve approaches its spacing
    ThreadPool& pool;
    CrossingTest& crossings;    ///< for its memory
  };
  /// Returns question(Present). Brings radii() up to date and changes nothing else. Throws
  /// Failure(FailureKind::kCancelled) where `cancel` stops it. Strong guarantee: whatever is thrown, also by the
  /// question, the flow is unchanged.
  template <class Question>
  auto ask(const Question& question, const CancelToken& cancel = {}) {
    ThreadPool pool = pool_.with(cancel);
    measure_again(pool);
    auto answer = question(Present{state_, work_.medial, plan(), approach_.factor(), pool, *work_.crossings});
    keep_radii();
    if (stop_reason() != StopReason::kRunning) work_.give_back();
    return answer;
  }
  /// Brings radii() up to date and changes nothing else.
  void update_radii(const CancelToken& cancel = {});

 private:
  IterationPlan plan() const {
    IterationPlan plan = plan_iteration(state_.settings, convergence_.phase(), convergence_.iterations_in_phase(),
                                        convergence_.began_full());
    if (convergence_.cut_short()) plan.segment_length = state_.settings.segment_length;
    return plan;
  }
  void iterate(ThreadPool& pool, const Tell& tell);
  double progress_with(double laid, double part) const;
  void note(IterationFigures figures, const CurveState& after, ThreadPool& pool);
  void measure_again(ThreadPool& pool);
  void go_on_from(FlowState next, Convergence convergence, double factor, const MoveSeconds& seconds, ThreadPool& pool);
  /// Those of the last medial axis become radii(), once nothing can fail any more. The flow goes on from its own.
  void keep_radii() noexcept { present_radii_.swap(work_.medial.radii); }
  const NodeData<Radii>& told_radii() const { return present_radii_.empty() ? state_.nodes.radii : present_radii_; }
  bool at_scale() const { return state_.domain.surface != state_.domain.given; }

  ThreadPool pool_;
  SeedFit seed_fit_;
  size_t drawn_;  // strands of the seed
  // What a run is about, and how far it has come.
  FlowState state_;
  NodeData<Radii> present_radii_;  // of the curve as it is; empty until it is asked about
  Convergence convergence_;
  SpacingApproach approach_;
  RunRecord record_;
  Workspace work_;
};

}  // namespace meander
