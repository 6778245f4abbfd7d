// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/flow.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/failure.h"
#include "base/stopwatch.h"
#include "flow/clamped_nodes.h"
#include "flow/free_nodes.h"
#include "flow/invariant.h"
#include "flow/progress.h"
#include "flow/weighting.h"
#include "seed/first_curve.h"
#include "seed/full_start.h"

namespace meander {
namespace {

FlowState first_state(std::shared_ptr<const Surface> surface, const SeedStrands* seed,
                      const VertexData<double>& density, const FlowSettings& settings, ThreadPool pool,
                      SeedFit& fit) {
  Domain domain(std::move(surface), density, settings, pool);
  Curve curve = first_curve(*domain.given, seed, domain.asked_radius, settings.widen_loops, domain.boundary->tree(),
                            2 * settings.boundary_distance, pool, &fit);
  return {settings, std::move(domain), std::move(curve), {}, {}};
}

/// A curve that fills the surface from its start has few hairpins, and they hold its pattern: none are drawn in.
FlowSettings as_started(FlowSettings settings) {
  if (settings.full_start) settings.hairpin_removal_iterations = 0;
  return settings;
}

}  // namespace

Flow::Flow(std::shared_ptr<const Surface> surface, const SeedStrands* seed, const VertexData<double>& density,
           const FlowSettings& settings, const CancelToken& cancel)
    : pool_(settings.threads),
      drawn_(seed && !seed->offsets.empty() ? seed->offsets.size() - 1 : 0),
      start_is_due_(settings.full_start),
      removal_where_it_grows_(settings.hairpin_removal_iterations),
      state_(first_state(std::move(surface), seed, density, as_started(settings), pool_.with(cancel), seed_fit_)),
      convergence_(settings.stop_rule, settings.polish, state_.settings.hairpin_removal_iterations,
                   polish_iterations(state_.settings)),
      approach_(settings.start_spacing_factor, settings.radius, state_.domain.surface->area()) {
  ThreadPool pool = pool_.with(cancel);
  if (at_scale()) {
    measure_segments(*state_.domain.surface, state_.curve, pool);
    retraction_.straighten(*state_.domain.surface, state_.curve, pool, record_.seconds.move);
  }
  refiner_.cut_guides(state_, plan(), pool);
  state_.domain.radius.set_multiple(state_.domain.wanted_radius, approach_.factor());
  refiner_.refine(state_, plan(), pool);
}

void Flow::set_field(LineField field) {
  if (at_scale()) field.ride(surface(), *state_.domain.surface);
  state_.domain.directions = std::move(field);
}

StopReason Flow::stop_reason() const {
  if (record_.cancelled) return StopReason::kCancelled;
  if (convergence_.converged()) return StopReason::kConverged;
  if (convergence_.stalled()) return StopReason::kStalled;
  if (record_.iterations() >= state_.settings.iteration_limit) return StopReason::kIterationLimit;
  return StopReason::kRunning;
}

bool Flow::step(const CancelToken& cancel) {
  ThreadPool pool = pool_.with(cancel);
  try {
    iterate(pool);
    record_.cancelled = false;
  } catch (const Failure& failure) {
    if (failure.kind != FailureKind::kCancelled) throw;
    record_.cancelled = true;
  }
  return !record_.cancelled;
}

StopReason Flow::run(const CancelToken& cancel, const std::function<void(double)>& progress) {
  record_.cancelled = false;
  double shown = 0;
  try {
    while (stop_reason() == StopReason::kRunning && step(cancel)) {
      shown = std::max(shown, this->progress());
      progress(shown);
    }
  } catch (...) {
    progress(1);
    throw;
  }
  progress(1);
  return stop_reason();
}

/// Puts a curve that fills the surface in the place of the loops. Whatever it throws, all is then as it was. Where none
/// could be laid at all, as on a needle, the flow grows as if nothing else had been asked for.
void Flow::start_full(ThreadPool& pool) {
  const Domain& domain = state_.domain;
  FlowState full{state_.settings, domain, full_start(*domain.surface, state_.curve, drawn_, domain.radius,
                                                     domain.directions, domain.patches.get(),
                                                     state_.settings.boundary_distance, pool), {}, {}};
  const auto same = [](const SurfacePoint& a, const SurfacePoint& b) {
    return a.face == b.face && a.b.x == b.b.x && a.b.y == b.b.y;
  };
  if (std::ranges::equal(full.curve.nodes, state_.curve.nodes, same)) {
    state_.settings.full_start = false;
    state_.settings.hairpin_removal_iterations = removal_where_it_grows_;
    convergence_ = Convergence(state_.settings.stop_rule, state_.settings.polish, removal_where_it_grows_,
                               polish_iterations(state_.settings));
    start_is_due_ = false;
    return;
  }
  refiner_.refine(full, plan(), pool);
  state_ = std::move(full);
  start_is_due_ = false;
}

/// One iteration of section 3.
void Flow::iterate(ThreadPool& pool) {
  Stopwatch total, watch;
  FlowSeconds& seconds = record_.seconds;
  if (start_is_due_) start_full(pool);
  watch.lap();

  // What this iteration is about, and the medial axis of the curve as it is (3.2.2).
  const IterationPlan plan = this->plan();
  find_medial_axis(plan, pool);
  seconds.medial_axis += watch.lap();

  // The quadratic model of the energy (3.2), and the step to its minimum (eq. 10).
  choose_weights(plan, state_, medial_, strands_, pool, weights_);
  const NodeData<Vec2>& displacement = step_.find(plan, state_, medial_, weights_, strands_, pool);
  seconds.solve += watch.lap();
  IterationFigures figures = figures_of(displacement, pool);
  IterationRecord record = record_of(displacement, pool);

  // The curve moves.
  remember(plan, displacement, pool);
  move(plan, displacement, figures, record, pool);
  record_.history.back().seconds = total.lap();
  seconds.total += record_.history.back().seconds;
}

/// The medial axis of a curve, as it is.
void Flow::find_medial_axis(FlowState& state, const AtRest& known, ThreadPool& pool, MedialPlan plan) {
  update_metric(state, pool);
  const Domain& domain = state.domain;
  const MedialRules rules{state.settings.boundary_rule, plan};
  const MedialScene scene{*domain.surface, domain.patches.get(), *domain.boundary, domain.radius,
                          state.curve,     state.metric,         rules};
  find_medial_state(scene, known, state.nodes.radii, pool, medial_);
}

/// The same as the forces of an iteration are to see it.
void Flow::find_medial_axis(const IterationPlan& plan, ThreadPool& pool) {
  NodeHistory& nodes = state_.nodes;
  if (!plan.reuse_directions) nodes.directions.clear();
  if (!plan.reuse_balls) nodes.balls.clear();
  medial_.measured.swap(nodes_after_.balls);  // for its memory
  find_medial_axis(state_, {&nodes.directions, &nodes.balls}, pool, plan.medial);
  if (state_.settings.grow_into_empty) {
    perturb_empty_stretches(state_.curve, medial_.radii, state_.metric, pool, medial_.felt_radii);
  }
}

/// What is known before the curve moves.
IterationFigures Flow::figures_of(const NodeData<Vec2>& displacement, ThreadPool& pool) {
  const Curve& curve = state_.curve;
  IterationFigures figures;
  const double squares = sum_over_free(curve, pool, [&](uint32_t i) { return dot(displacement[i], displacement[i]); });
  figures.displacement_norm = std::sqrt(squares) / free_nodes(curve, pool) / state_.settings.radius;
  figures.clamped_share = clamped_share(curve, medial_.radii, state_.metric, pool);
  figures.wanted = mean_over_movable(curve, pool, [&](uint32_t i) {
    return norm(displacement[i]) / state_.metric.radius[i];
  });
  return figures;
}

IterationRecord Flow::record_of(const NodeData<Vec2>& displacement, ThreadPool& pool) {
  const Curve& curve = state_.curve;
  IterationRecord record;
  record.mean_step =
      sum_over_free(curve, pool, [&](uint32_t i) { return norm(displacement[i]); }) / free_nodes(curve, pool);
  record.energy = energy(curve, medial_.felt_radii, state_.metric, weights_, pool);
  return record;
}

/// What the nodes will carry once they have moved.
void Flow::remember(const IterationPlan& plan, const NodeData<Vec2>& displacement, ThreadPool& pool) {
  std::swap(nodes_after_.radii, medial_.radii);
  nodes_after_.directions = state_.nodes.directions;
  if (plan.reuse_directions) remember_directions(medial_.frames, state_.metric, pool, nodes_after_.directions);
  std::swap(nodes_after_.balls, medial_.measured);
  remember_steps(plan, displacement, medial_.frames, pool, nodes_after_.steps);
}

/// Moves the curve, and takes note of the iteration. Whatever it throws, all is then as it was.
void Flow::move(const IterationPlan& plan, const NodeData<Vec2>& displacement, IterationFigures& figures,
                IterationRecord& record, ThreadPool& pool) {
  // Nodes move along geodesics and are joined again, no farther than nothing crosses (3.3, 3.3.1).
  const NodeData<double>& moved =
      retraction_.move(*state_.domain.surface, state_.curve, displacement, pool, record_.seconds.move);
  const size_t iterations = record_.history.size();
  std::swap(state_.nodes, nodes_after_);
  try {
    figures.moved =
        mean_over_movable(state_.curve, pool, [&](uint32_t i) { return moved[i] / state_.metric.radius[i]; });

    // Segments are split and removed, and what nodes carry follows (3.3.2).
    Stopwatch watch;
    refiner_.refine(state_, plan, pool);
    record_.seconds.refine += watch.lap();
    if (fault_) fault_(state_.curve);
    keep_promises();

    // What this says about the phase, and about the end.
    record.length = length();
    record.nodes = state_.curve.size();
    record_.history.push_back(record);
    note(figures, pool);
  } catch (...) {
    retraction_.take_back(state_.curve);
    std::swap(state_.nodes, nodes_after_);
    record_.history.resize(iterations);
    throw;
  }
}

/// Throws where the curve that has moved is none that may be: what is a defect here ends the run with the curve of the
/// iteration before, and not with a crash or a curve that cannot be made.
void Flow::keep_promises() const {
  const size_t iteration = record_.history.size() + 1;
  const std::string broken =
      broken_promise(*state_.domain.surface, retraction_.before(), state_.curve, iteration);
  if (broken.empty()) return;
  throw Failure(FailureKind::kInternal, "In iteration " + std::to_string(iteration) + " " + broken +
                                            ", so the curve stays as it was before it; please report this.");
}

/// The last thing in an iteration that may fail: what it throws, it throws before it has changed anything.
void Flow::note(IterationFigures& figures, ThreadPool& pool) {
  update_metric(state_, pool);
  figures.length = state_.curve.growing_length();
  if (approach_.arrived()) {
    convergence_.note(*state_.domain.surface, state_.curve, state_.metric, figures, pool);
  } else {
    state_.domain.radius.set_multiple(state_.domain.wanted_radius, approach_.next(figures));
  }
}

double Flow::progress() const {
  ProgressFigures figures;
  figures.phase = convergence_.phase();
  figures.iterations_in_phase = convergence_.iterations_in_phase();
  figures.length = state_.curve.growing_length();
  figures.expected_length = state_.domain.expected_length;
  figures.iterations = static_cast<uint32_t>(record_.iterations());
  figures.quiet_iterations = convergence_.quiet_iterations();
  return progress_of(state_.settings, figures);
}

void Flow::update_radii(const CancelToken& cancel) {
  ThreadPool pool = pool_.with(cancel);
  find_medial_axis(state_, {}, pool);
  keep_radii();
}

double Flow::length() const {
  return at_scale() ? length_on(surface(), state_.curve) : state_.curve.length();
}

Radii Flow::radii_of(uint32_t node) const {
  if (state_.nodes.radii.empty()) return {0, 0};
  Radii radii = state_.nodes.radii[node];
  if (at_scale()) {
    for (double& r : radii) r *= state_.domain.stretch_at(state_.curve.nodes[node]);
  }
  return radii;
}

NodeData<Radii> Flow::radii() const {
  NodeData<Radii> radii = state_.nodes.radii;
  for (uint32_t i = 0; i < radii.size(); ++i) radii[i] = radii_of(i);
  return radii;
}

}  // namespace meander
