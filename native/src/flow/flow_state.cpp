// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/flow_state.h"

#include "medial/curve_bvh.h"

namespace meander {
namespace {

/// Segments that a thread takes at a time.
constexpr size_t kMeasuredGrain = 512;

}  // namespace

void measure_segments(const Surface& surface, Curve& curve, ThreadPool& pool) {
  pool.for_blocks(curve.size(), kMeasuredGrain, [&](size_t, size_t begin, size_t end) {
    for (auto i = static_cast<uint32_t>(begin); i < end; ++i) {
      if (!curve.has_segment(i)) continue;
      curve.shapes[i] = measure_path(surface, curve.nodes[i], curve.nodes[curve.next(i)], curve.paths[i]);
    }
  });
}

void update_metric(const FlowSettings& settings, const Domain& domain, CurveState& state, ThreadPool& pool) {
  const MetricRules rules{settings.max_radius / settings.radius, CurveBvh::kMostRadius, settings.boundary_distance};
  find_local_metric(*domain.surface, state.curve, domain.radius, rules, pool, state.metric);
}

double length_as_given(const Domain& domain, const Curve& curve) {
  return domain.surface == domain.given ? curve.length() : length_on(*domain.given, curve);
}

}  // namespace meander
