// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/curvature.h"

#include <cmath>

#include "base/elementary.h"
#include "curve/constants.h"

namespace meander {
namespace {

/// The angle of a unit vector, to 1e-7: strands hardly turn at most nodes.
double angle(Vec2 t) {
  if (!(t.x > 0 && std::abs(t.y) < kHardlyTurned)) return elementary::atan2(t.y, t.x);
  const double y2 = t.y * t.y;
  return t.y * (1 + y2 * (1.0 / 6 + y2 * (3.0 / 40 + y2 * (15.0 / 336))));
}

}  // namespace

NodeData<double> turns_at_nodes(const Curve& curve, ThreadPool& pool) {
  NodeData<double> turn(curve.size(), 0);
  pool.for_each(curve.size(), kNodeGrain, [&](uint32_t i) {
    const uint32_t before = curve.previous(i);
    if (before == kNone || !curve.has_segment(i)) return;
    turn[i] = angle(curve.shapes[i].leaving * conj(curve.shapes[before].arriving));
  });
  return turn;
}

NodeData<double> smoothed_curvature(const Curve& curve, const LocalMetric& metric, double width, ThreadPool& pool) {
  const NodeData<double> turn = turns_at_nodes(curve, pool);
  NodeData<double> curvature(curve.size());
  pool.for_each(curve.size(), kNodeGrain, [&](uint32_t i) {
    const double reach = width * metric.radius[i];
    double sum = turn[i];
    // Both ways, and no farther than once round.
    double away = 0;
    for (uint32_t j = i; curve.has_segment(j);) {
      away += curve.shapes[j].length;
      j = curve.next(j);
      if (away >= reach || j == i) break;
      sum += (1 - away / reach) * turn[j];
    }
    away = 0;
    for (uint32_t j = curve.previous(i); j != kNone && j != i; j = curve.previous(j)) {
      away += curve.shapes[j].length;
      if (away >= reach) break;
      sum += (1 - away / reach) * turn[j];
    }
    curvature[i] = std::abs(sum) / width;
  });
  return curvature;
}

}  // namespace meander
