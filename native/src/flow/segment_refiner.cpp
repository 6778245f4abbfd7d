// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/segment_refiner.h"

#include <algorithm>
#include <limits>

#include "flow/constants.h"

namespace meander {
namespace {

/// A segment length that is never reached.
constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

void SegmentRefiner::refine(const FlowSettings& settings, const Domain& domain, CurveState& state,
                            const IterationPlan& plan, ThreadPool& pool) {
  apply(settings, domain, state, plan, kNever, pool);
}

void SegmentRefiner::cut_guides(FlowState& state, const IterationPlan& plan, ThreadPool& pool) {
  const Curve& curve = state.curve;
  for (uint32_t k = 0, before = 0; k < kMostGuideCuts && curve.has_guides() && curve.size() != before; ++k) {
    before = curve.size();
    apply(state.settings, state.domain, state, plan, state.settings.segment_length, pool);
  }
}

void SegmentRefiner::apply(const FlowSettings& settings, const Domain& domain, CurveState& state,
                           const IterationPlan& plan, double guide_length, ThreadPool& pool) {
  update_metric(settings, domain, state, pool);
  const Curve& curve = state.curve;
  targets_.resize(curve.size());
  const RadiusField* whole = domain.whole_radius ? &*domain.whole_radius : nullptr;
  const double longest = settings.growth_coarsening * settings.segment_length;
  pool.for_each(curve.size(), kNodeGrain, [&](uint32_t i) {
    const double h = curve.on_guide(i) ? guide_length : plan.segment_length, r = state.metric.radius[i];
    targets_[i] = h * r / settings.radius;
    if (!whole || curve.on_guide(i)) return;
    // Where r is that of the room, segments need not be as much shorter than they were asked for.
    const double wanted = h * whole->at(*domain.surface, curve.nodes[i]) / settings.radius;
    targets_[i] = std::max(targets_[i], std::min(wanted, longest * r / settings.radius));
  });
  if (refinement_.refine(*domain.surface, state.curve, targets_, pool, origin_, plan.most_turn)) {
    state.nodes.follow(origin_, pool);
  }
}

}  // namespace meander
