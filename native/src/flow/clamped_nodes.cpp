// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/clamped_nodes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/elementary.h"
#include "flow/constants.h"
#include "flow/free_nodes.h"

namespace meander {
namespace {

/// A medial radius this near the clamp (relative) is one that found nothing.
constexpr double kClamped = 1 - 1e-9;

}  // namespace

bool sees_nothing(const NodeData<Radii>& radii, const LocalMetric& metric, uint32_t node) {
  return std::min(radii[node][0], radii[node][1]) >= kClamped * metric.max_radius[node];
}

double clamped_share(const Curve& curve, const NodeData<Radii>& radii, const LocalMetric& metric, ThreadPool& pool) {
  const double clamped = sum_over_free(curve, pool, [&](uint32_t i) {
    return std::max(radii[i][0], radii[i][1]) >= kClamped * metric.max_radius[i];
  });
  return clamped / free_nodes(curve, pool);
}

void perturb_empty_stretches(const Curve& curve, const NodeData<Radii>& radii, const LocalMetric& metric,
                             ThreadPool& pool, NodeData<Radii>& felt_radii) {
  const size_t n = curve.size();
  const auto empty = [&](size_t i) { return sees_nothing(radii, metric, static_cast<uint32_t>(i)); };
  if (pool.first(n, kNodeGrain, empty) == n) return;
  for (const Strand& strand : curve.strands) {
    double phase = 0;
    for (uint32_t i = strand.first; i < strand.end(); ++i) {
      if (empty(i)) {
        const double favour = kPerturbation * elementary::sin(phase);
        felt_radii[i][0] *= 1 + favour;
        felt_radii[i][1] *= 1 - favour;
      }
      if (curve.has_segment(i)) {
        phase += 2 * std::numbers::pi / kPerturbationWavelength * curve.shapes[i].length / metric.radius[i];
      }
    }
  }
}

}  // namespace meander
