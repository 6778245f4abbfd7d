// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/local_metric.h"

#include <algorithm>

#include "curve/constants.h"

namespace meander {

void find_local_metric(const Surface& surface, const Curve& curve, const RadiusField& radius, const MetricRules& rules,
                       ThreadPool& pool, LocalMetric& metric) {
  for (NodeData<double>* values : {&metric.radius, &metric.max_radius, &metric.overhang, &metric.least_rest}) {
    values->resize(curve.size());
  }
  const bool narrow = rules.boundary_distance <= kWideStrip;
  pool.for_each(curve.size(), kNodeGrain, [&](uint32_t i) {
    const double r = radius.at(surface, curve.nodes[i]);
    metric.radius[i] = r;
    metric.max_radius[i] = std::min(rules.clamp * r, rules.largest);
    metric.overhang[i] = (1 - 2 * rules.boundary_distance) * r;
    metric.least_rest[i] = narrow ? r : 0;
  });
}

}  // namespace meander
