// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/step.h"

#include <algorithm>
#include <cmath>

#include "flow/constants.h"
#include "model/solve.h"

namespace meander {
namespace {

/// The longest step that node i may take in the direction of `step`, in the surface's unit.
double longest_step(const IterationPlan& plan, const FlowState& state, const MedialState& medial, size_t i, Vec2 step) {
  const size_t side = dot(step, medial.frames.bitangent2[i]) > 0 ? 0 : 1;
  const double radius = medial.radii[i][side], r = state.metric.radius[i];
  double most = kMostOfRadius * radius;
  if (medial.reach[i][side].radius <= radius) most = std::max(most, kMostAtBoundary * r);
  return std::min(most, plan.longest_step * r);
}

/// Takes from a step what would lead node i too near to the boundary, which pushes only those that are near to it
/// already: a node that leaps so far is thrown back the next time, and so on for ever.
Vec2 keep_from_boundary(const FlowState& state, const MedialState& medial, size_t i, Vec2 step) {
  const Vec2 across = medial.frames.bitangent2[i];
  const double sideways = dot(step, across), r = state.metric.radius[i];
  const size_t side = sideways > 0 ? 0 : 1;
  const double left = medial.reach[i][side].radius;
  if (left > medial.radii[i][side]) return step;  // another strand ends the ball
  const double most = std::max(left - kKeptFromBoundary * r, kLeastTowardsBoundary * r);
  return step - (sideways - std::clamp(sideways, -most, most)) * across;
}

/// Adds what is left of the last steps, and makes no step longer than it may be.
void add_momentum_and_cap(const IterationPlan& plan, const FlowState& state, const MedialState& medial,
                          ThreadPool& pool, NodeData<Vec2>& displacement) {
  const NodeData<Vec2>& last = state.nodes.steps;
  const double momentum = last.empty() ? 0 : plan.momentum;
  const Frames& frames = medial.frames;
  const bool kept = plan.firm_boundary && !state.domain.boundary->empty();
  pool.for_blocks(displacement.size(), kNodeGrain, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      Vec2& d = displacement[i];
      if (momentum > 0) d = d + momentum * (last[i].x * frames.tangent[i] + last[i].y * frames.bitangent2[i]);
      const double length = norm(d), most = longest_step(plan, state, medial, i, d);
      if (length > most) d = (most / length) * d;
      if (kept) d = keep_from_boundary(state, medial, i, d);
      if (!std::isfinite(d.x) || !std::isfinite(d.y)) d = {};
    }
  });
}

/// Ends do not leap over what is ahead of them.
void cap_ends(const std::vector<FreeEnd>& ends, NodeData<Vec2>& displacement) {
  for (const FreeEnd& end : ends) {
    Vec2& d = displacement[end.node];
    const double beyond = dot(d, end.ahead) - kMostOfRadius * end.radius;
    if (beyond > 0) d = d - beyond * end.ahead;
  }
}

}  // namespace

const NodeData<Vec2>& Step::find(const IterationPlan& plan, const FlowState& state, const MedialState& medial,
                                 const Weights& weights, StrandSolver& strands, ThreadPool& pool) {
  ends_.clear();
  if (state.settings.hold_ends) {
    ends_ = find_free_ends(*state.domain.surface, state.curve, medial.frames, *state.domain.boundary,
                           state.settings.boundary_rule, state.metric, pool);
  }
  solve_strands(state, medial, weights, strands, pool);
  add_momentum_and_cap(plan, state, medial, pool, displacement_);
  cap_ends(ends_, displacement_);
  return displacement_;
}

/// The radii that drive the nodes: where the boundary is to push harder than a ball of no size does, the other side
/// has the rest.
const NodeData<Radii>& Step::driving_radii(const FlowState& state, const MedialState& medial, ThreadPool& pool) {
  if (state.domain.boundary->empty()) return medial.felt_radii;
  driving_radii_.resize(medial.felt_radii.size());
  pool.for_blocks(driving_radii_.size(), kNodeGrain, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      for (size_t side = 0; side < 2; ++side) {
        driving_radii_[i][side] = medial.felt_radii[i][side] + std::max(0.0, -medial.reach[i][1 - side].driving);
      }
    }
  });
  return driving_radii_;
}

/// Builds the model of every strand (eqs. 5, 7, 11 to 13), and takes the step to its minimum (eq. 10).
void Step::solve_strands(const FlowState& state, const MedialState& medial, const Weights& weights,
                         StrandSolver& strands, ThreadPool& pool) {
  const Curve& curve = state.curve;
  const LocalMetric& metric = state.metric;
  const NodeData<Radii>& radii = driving_radii(state, medial, pool);
  displacement_.assign(curve.size(), Vec2{});
  strands.for_strands(curve, pool, [&](const Strand& strand, ThreadPool& threads, StrandSystem& system) {
    if (strand.guide) return;
    assemble(curve, strand, medial.frames, radii, metric, weights, threads, system);
    auto end = std::ranges::lower_bound(ends_, strand.first, {}, &FreeEnd::node);
    for (; end != ends_.end() && end->node < strand.end(); ++end) {
      add_end_term(*end, end->node - strand.first, metric.radius[end->node], weights.medial, system);
    }
    const Table<Vec2> z = solve(system, threads);
    for (uint32_t k = 0; k < strand.count; ++k) {
      displacement_[strand.first + k] = state.settings.step * (system.frame[k] * z[k]);
    }
  });
}

void remember_steps(const IterationPlan& plan, const NodeData<Vec2>& displacement, const Frames& frames,
                    ThreadPool& pool, NodeData<Vec2>& steps) {
  if (plan.momentum == 0) {
    steps.clear();
    return;
  }
  steps.resize(displacement.size());
  pool.for_blocks(displacement.size(), kNodeGrain, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      steps[i] = {dot(displacement[i], frames.tangent[i]), dot(displacement[i], frames.bitangent2[i])};
    }
  });
}

}  // namespace meander
