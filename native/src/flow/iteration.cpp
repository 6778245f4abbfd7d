// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/iteration.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include "base/failure.h"
#include "base/stopwatch.h"
#include "base/variation.h"
#include "flow/clamped_nodes.h"
#include "flow/free_nodes.h"
#include "flow/invariant.h"
#include "flow/spacing_correction.h"
#include "flow/weighting.h"
#include "seed/full_start.h"

namespace meander {

void Workspace::give_back() noexcept {
  medial.hand_on();
  weights.hand_on();
  strands.hand_on();
  step.hand_on();
  retraction.hand_all_on();
  refiner.hand_on();
  spare.hand_on();
  spare.curve.hand_all_on();
  if (PageStore::figures().free > 0) PageStore::trim();
}

void find_medial_axis(const FlowState& state, const AtRest& known, const MedialPlan& plan, ThreadPool& pool,
                      MedialState& medial) {
  const Domain& domain = state.domain;
  const MedialRules rules{state.settings.boundary_rule, plan};
  const MedialScene scene{*domain.surface, domain.patches.get(), *domain.boundary, domain.radius,
                          state.curve,     state.metric,         rules};
  find_medial_state(scene, known, state.nodes.radii, pool, medial);
}

void Iteration::lay(size_t drawn, const Tell& tell) {
  if (plan_.phase == Phase::kStarting) lay_in_empty(drawn, tell);
  if (plan_.phase == Phase::kLayingRest) lay_in_empty(given_.curve.strands.size(), {});
}

/// What is left beside strands is as wide as it happens to be: streamlines begin beside them. So they do in what is
/// narrow, where there is one along the middle.
StartLines Iteration::lines_to_lay() const {
  const Domain& domain = given_.domain;
  const bool whole = plan_.phase == Phase::kStarting || domain.even_rows;
  return domain.asked_radius.varies() || (whole && !domain.narrow) ? StartLines::kPhase : StartLines::kStreamlines;
}

void Iteration::lay_in_empty(size_t trunks, const Tell& tell) {
  const Domain& domain = given_.domain;
  const Curve first = with_short_segments();
  FullStart laid = full_start(*domain.surface, first, trunks, domain.radius, domain.directions,
                              domain.patches.get(), given_.settings.boundary_distance, pool_, lines_to_lay(),
                              given_.settings.variation, domain.rest, tell);
  figures_.laid = laid.laid_any();
  report_ = given_.start;
  if (plan_.phase == Phase::kStarting) {
    report_->strands = std::move(laid.strands);
    plan_ = plan_iteration(given_.settings, plan_.phase, 0, report_->began_full());
  } else {
    report_->completed += static_cast<uint32_t>(std::ranges::count(laid.strands, StrandStart::kLaid));
  }
  if (!figures_.laid) return;
  laid_.emplace(FlowState{{std::move(laid.curve), {}, {}}, given_.settings, domain, *report_});
  work_.refiner.refine(*laid_, plan_, pool_);
  update_metric(*laid_, pool_);
  // What laying took is in small pieces, and more than all else by then.
  if (LargePages<SurfacePoint>::is_large(laid_->curve.size())) PageStore::trim();
}

/// Where parts of open strands may become lines (see Trunks), their segments are as short as they will be in the end.
Curve Iteration::with_short_segments() {
  CurveState fine{given_.curve, {}, {}};
  const bool parted = plan_.phase == Phase::kLayingRest || given_.domain.narrow;
  if (parted && std::ranges::any_of(fine.curve.strands, [](const Strand& s) { return !s.closed && !s.guide; })) {
    IterationPlan plan = plan_;
    plan.segment_length = given_.settings.segment_length;
    work_.refiner.refine(given_.settings, given_.domain, fine, plan, pool_);
  }
  return std::move(fine.curve);
}

void Iteration::measure() {
  Stopwatch watch;
  static const NodeData<MeasuredBalls> none;
  const NodeHistory& nodes = before().nodes;
  const AtRest known{plan_.reuse_directions ? &nodes.directions : nullptr, plan_.reuse_balls ? &nodes.balls : &none};
  find_medial_axis(before(), known, plan_.medial, pool_, work_.medial);
  if (before().settings.grow_into_empty) {
    perturb_empty_stretches(before().curve, work_.medial.radii, before().metric, plan_.room,
                            share_of_variation(before().settings.variation), pool_, work_.medial.felt_radii);
  }
  seconds_.medial_axis = watch.lap();
}

void Iteration::solve() {
  Stopwatch watch;
  const Curve& curve = before().curve;
  const LocalMetric& metric = before().metric;
  choose_weights(plan_, before(), work_.medial, work_.strands, pool_, work_.weights);
  const NodeData<Vec2>& d = work_.step.find(plan_, before(), work_.medial, work_.weights, work_.strands, pool_);
  displacement_ = &d;
  seconds_.solve = watch.lap();

  const double count = free_nodes(curve, pool_);
  const double squares = sum_over_free(curve, pool_, [&](uint32_t i) { return dot(d[i], d[i]); });
  figures_.displacement_norm = std::sqrt(squares) / count / before().settings.radius;
  figures_.clamped_share = clamped_share(curve, work_.medial.radii, metric, pool_);
  figures_.alone_share = alone_share(curve, work_.medial.radii, work_.medial.reach, metric, pool_);
  figures_.slack_share = slack_share(curve, work_.medial.radii, metric, pool_);
  figures_.balanced_share = balanced_share(curve, work_.medial.radii, metric, pool_);
  figures_.correction = next_correction(plan_, before(), work_.medial.radii);
  figures_.wanted = mean_over_movable(curve, pool_, [&](uint32_t i) { return norm(d[i]) / metric.radius[i]; });
  record_.mean_step = sum_over_free(curve, pool_, [&](uint32_t i) { return norm(d[i]); }) / count;
  record_.energy = energy(curve, work_.medial.felt_radii, metric, work_.weights, pool_);
  work_.weights.hand_on();
  work_.strands.hand_on();
}

void Iteration::move() {
  // What nodes carry with them; of the medial axis nothing else is needed any more.
  NodeHistory& nodes = after().nodes;
  if (plan_.reuse_directions) {
    nodes.directions = before().nodes.directions;
    remember_directions(work_.medial.frames, before().metric, pool_, nodes.directions);
  } else {
    nodes.directions.clear();
  }
  remember_steps(plan_, *displacement_, work_.medial.frames, pool_, nodes.steps);
  nodes.radii.swap(work_.medial.radii);
  nodes.balls.swap(work_.medial.measured);
  work_.medial.hand_on();

  const NodeData<double>& moved = work_.retraction.move(*before().domain.surface, before().curve, *displacement_,
                                                        after().curve, pool_, seconds_.move);
  figures_.moved =
      mean_over_movable(after().curve, pool_, [&](uint32_t i) { return moved[i] / before().metric.radius[i]; });
  work_.step.hand_on();
  work_.retraction.hand_on();
}

void Iteration::refine() {
  Stopwatch watch;
  work_.refiner.refine(before().settings, before().domain, after(), plan_, pool_);
  work_.refiner.hand_on();
  seconds_.refine = watch.lap();
}

void Iteration::check(size_t number) {
  const Domain& domain = before().domain;
  const Curve& curve = after().curve;
  const std::string broken = broken_promise(*domain.surface, given_.curve, curve, number, pool_);
  if (!broken.empty()) {
    throw Failure(FailureKind::kInternal, "In iteration " + std::to_string(number) + " " + broken +
                                              ", so the curve stays as it was before it; please report this.");
  }
  update_metric(before().settings, domain, after(), pool_);
  figures_.length = curve.growing_length();
  record_.length = length_as_given(domain, curve);
  record_.nodes = curve.size();
}

void Iteration::commit(FlowState& state, RunRecord& record, double seconds) noexcept {
  static_assert(std::is_nothrow_swappable_v<CurveState> && std::is_nothrow_move_assignable_v<StartReport>);
  std::swap(static_cast<CurveState&>(state), after());
  const size_t now = state.curve.size(), was = after().curve.size();
  after().hand_on();
  // Of a curve that has become finer all lists are larger, and none fits where the old ones were.
  if (LargePages<SurfacePoint>::is_large(now) && static_cast<double>(now) > kMuchFiner * static_cast<double>(was)) {
    PageStore::trim();
  }
  if (report_) state.start = std::move(*report_);
  state.domain.correct(figures_.correction);
  record_.seconds = seconds_.total = seconds;
  record.add(record_, seconds_);
}

}  // namespace meander
