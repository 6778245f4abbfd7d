// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/flow.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "base/failure.h"
#include "base/stopwatch.h"
#include "flow/constants.h"
#include "flow/far_share.h"
#include "flow/progress.h"
#include "flow/room.h"
#include "seed/first_curve.h"

namespace meander {
namespace {

FlowState first_state(std::shared_ptr<const Surface> surface, const SeedStrands* seed,
                      const VertexData<double>& density, const FlowSettings& settings, ThreadPool pool,
                      SeedFit& fit, const Tell& tell) {
  Domain domain(std::move(surface), density, settings, pool, part_of(tell, 0, kDomainKnown));
  Curve curve = first_curve(*domain.given, seed, domain.asked_radius, settings.widen_loops, domain.boundary->tree(),
                            2 * settings.boundary_distance, pool, &fit, settings.variation);
  return {{std::move(curve), {}, {}}, settings, std::move(domain), {settings.full_start, {}, 0}};
}

/// Whether a curve is laid first: that was asked for, or nothing can turn or, where nothing was drawn, growth would
/// leave so much that it is laid in the end all the same. Not in the paper's own program, nor where so wide a strip
/// along the boundary is to stay empty that a narrow surface has hardly anything to fill.
Beginning beginning(const FlowSettings& settings, const Domain& domain, const Curve& curve, size_t drawn) {
  const Beginning asked = settings.full_start ? Beginning::kFull : Beginning::kGrown;
  if (settings.stop_rule == StopRule::kPaper || settings.boundary_distance > 0.5 || curve.has_guides()) return asked;
  if (too_narrow_to_grow(*domain.surface, curve, domain.wanted_radius)) return Beginning::kNarrow;
  return drawn == 0 && too_long_to_grow(*domain.surface, domain.wanted_radius) ? Beginning::kFull : asked;
}

}  // namespace

Flow::Flow(std::shared_ptr<const Surface> surface, const SeedStrands* seed, const VertexData<double>& density,
           const FlowSettings& settings, const CancelToken& cancel, const Tell& tell)
    : pool_(settings.threads),
      drawn_(seed && !seed->offsets.empty() ? seed->offsets.size() - 1 : 0),
      state_(first_state(std::move(surface), seed, density, settings, pool_.with(cancel), seed_fit_, tell)),
      convergence_(settings, beginning(settings, state_.domain, state_.curve, drawn_)),
      approach_(settings.start_spacing_factor, settings.radius, state_.domain.surface->area()) {
  ThreadPool pool = pool_.with(cancel);
  if (at_scale()) {
    measure_segments(*state_.domain.surface, state_.curve, pool);
    work_.retraction.straighten(*state_.domain.surface, state_.curve, work_.spare.curve, pool, record_.seconds.move);
  }
  work_.refiner.cut_guides(state_, plan(), pool);
  state_.domain.set_radius(approach_.factor(), state_.curve, settings);
  work_.refiner.refine(state_, plan(), pool);
  if (tell) tell(1);
}

void Flow::set_field(LineField field) { state_.domain.follow(std::move(field), state_.settings, pool_); }

StopReason Flow::stop_reason() const {
  if (record_.cancelled) return StopReason::kCancelled;
  if (convergence_.converged()) return StopReason::kConverged;
  if (convergence_.stalled()) return StopReason::kStalled;
  if (record_.iterations() >= state_.settings.iteration_limit) return StopReason::kIterationLimit;
  return StopReason::kRunning;
}

bool Flow::step(const CancelToken& cancel, const Tell& tell) {
  ThreadPool pool = pool_.with(cancel);
  try {
    iterate(pool, tell);
    record_.cancelled = false;
  } catch (const Failure& failure) {
    if (failure.kind != FailureKind::kCancelled) throw;
    record_.cancelled = true;
  }
  return !record_.cancelled;
}

StopReason Flow::run(const CancelToken& cancel, const Tell& tell) {
  record_.cancelled = false;
  double shown = 0;
  const auto show = [&](double share) { tell(shown = std::max(shown, share)); };
  try {
    while (stop_reason() == StopReason::kRunning && step(cancel, show)) show(progress());
  } catch (...) {
    tell(1);
    throw;
  }
  work_.give_back();
  tell(1);
  return stop_reason();
}

/// One iteration of section 3.
void Flow::iterate(ThreadPool& pool, const Tell& tell) {
  Stopwatch total;
  update_metric(state_, pool);

  // From the curve as it is to the next one beside it.
  Iteration iteration(state_, plan(), work_, pool);
  iteration.lay(drawn_, [&](double laid) {
    if (tell) tell(progress_with(laid, 0));
  });
  const bool tells = tell && state_.curve.size() >= kNodesOfLongIteration && plan().phase != Phase::kStarting;
  const auto done = [&](double part) {
    if (tells) tell(progress_with(0, part));
  };
  iteration.measure();
  done(kIterationMeasured);
  iteration.solve();
  done(kIterationSolved);
  iteration.move();
  done(kIterationMoved);
  iteration.refine();
  iteration.check(record_.history.size() + 1);

  // What this says about the phase, and about the end; then it counts.
  record_.make_room();
  note(iteration.figures(), iteration.after(), pool);
  iteration.commit(state_, record_, total.lap());
  present_radii_.clear();
}

/// The last thing in an iteration that may fail: what it throws, it throws before it has changed anything.
void Flow::note(IterationFigures figures, const CurveState& after, ThreadPool& pool) {
  if (approach_.arrived()) {
    const double side = 2 * state_.domain.expected_length / std::sqrt(state_.domain.surface->area());
    if (convergence_.asks_what_is_far(figures, side)) {
      figures.far_share = far_share(state_.domain, after.curve, pool);
    }
    convergence_.note(*state_.domain.surface, after.curve, after.metric, figures, pool);
  } else {
    state_.domain.set_radius(approach_.next(figures), after.curve, state_.settings);
    convergence_.note_approach(figures);
  }
}

/// Puts another state in the place of the present one, with segments as its phase wants them: a new beginning for
/// run(). In its unit lengths are `factor` times as large. What it throws, it throws before it has changed anything.
void Flow::go_on_from(FlowState next, Convergence convergence, double factor, const MoveSeconds& seconds,
                      ThreadPool& pool) {
  const IterationPlan plan = plan_iteration(next.settings, convergence.phase(), 0, convergence.began_full());
  work_.refiner.cut_guides(next, plan, pool);
  work_.refiner.refine(next, plan, pool);
  update_metric(next, pool);

  static_assert(std::is_nothrow_move_assignable_v<FlowState> && std::is_nothrow_move_assignable_v<Convergence>);
  state_ = std::move(next);
  present_radii_.clear();
  convergence_ = std::move(convergence);
  approach_.rescale(factor);
  record_.seconds.move = seconds;
  record_.restart(factor);
}

double Flow::progress() const { return progress_with(0, 0); }

double Flow::progress_with(double laid, double part) const {
  ProgressFigures figures;
  figures.phase = convergence_.phase();
  figures.iterations_in_phase = convergence_.iterations_in_phase();
  figures.full = convergence_.began_full() || figures.phase == Phase::kStarting;
  figures.laid = laid;
  figures.part = part;
  figures.length = state_.curve.growing_length();
  figures.expected_length = state_.domain.expected_length;
  const double nodes = figures.expected_length / (kMeanSegment * state_.settings.segment_length);
  figures.faces_a_node = static_cast<double>(state_.domain.surface->face_count()) / nodes;
  figures.iterations = static_cast<uint32_t>(record_.iterations());
  figures.quiet_iterations = convergence_.quiet_iterations();
  return progress_of(state_.settings, figures);
}

/// Finds the medial axis of the curve as it is, without what is known of an earlier one.
void Flow::measure_again(ThreadPool& pool) {
  update_metric(state_, pool);
  find_medial_axis(state_, {}, {}, pool, work_.medial);
}

void Flow::update_radii(const CancelToken& cancel) {
  ThreadPool pool = pool_.with(cancel);
  measure_again(pool);
  keep_radii();
}

double Flow::length() const { return length_as_given(state_.domain, state_.curve); }

Radii Flow::radii_of(uint32_t node) const {
  if (told_radii().empty()) return {0, 0};
  Radii radii = told_radii()[node];
  if (at_scale()) {
    for (double& r : radii) r *= state_.domain.stretch_at(state_.curve.nodes[node]);
  }
  return radii;
}

NodeData<Radii> Flow::radii() const {
  NodeData<Radii> radii = told_radii();
  for (uint32_t i = 0; i < radii.size(); ++i) radii[i] = radii_of(i);
  return radii;
}

}  // namespace meander
