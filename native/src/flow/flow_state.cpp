// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/flow_state.h"

#include "medial/constants.h"

namespace meander {
namespace {

/// Segments that a thread takes at a time.
constexpr size_t kMeasuredGrain = 512;

}  // namespace

void measure_segments(const Surface& surface, Curve& curve, ThreadPool& pool) {
  pool.for_each(curve.size(), kMeasuredGrain, [&](uint32_t i) {
    if (!curve.has_segment(i)) return;
    curve.shapes[i] = measure_path(surface, curve.nodes[i], curve.nodes[curve.next(i)], curve.paths[i]);
  });
}

void update_metric(const FlowSettings& settings, const Domain& domain, CurveState& state, ThreadPool& pool) {
  const MetricRules rules{settings.max_radius / settings.radius, kMostRadius, settings.boundary_distance};
  find_local_metric(*domain.surface, state.curve, domain.radius, rules, pool, state.metric);
}

double length_as_given(const Domain& domain, const Curve& curve) {
  return domain.surface == domain.given ? curve.length() : length_on(*domain.given, curve);
}

}  // namespace meander
