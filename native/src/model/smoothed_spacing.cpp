// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/smoothed_spacing.h"

#include <algorithm>

#include "model/constants.h"
#include "model/solve.h"

namespace meander {
namespace {

/// What couples u at both ends of segment i in (1 - s^2 d^2 / ds^2) u = raw u, s being the smoothing.
double stiffness_of(const Curve& curve, const LocalMetric& metric, uint32_t i) {
  const double r = metric.radius[i], smoothing = kSpacingSmoothing;
  return smoothing * smoothing * r * r / std::max(curve.shapes[i].length, kShortestSegment * r);
}

double raw_spacing(const Radii& radii, double r) {
  return 0.5 * (std::min(radii[0], 2 * r) + std::min(radii[1], 2 * r)) / r;
}

/// Row k of the system of a strand.
void add_row(const Curve& curve, const LocalMetric& metric, const NodeData<Radii>& radii, uint32_t i, size_t k,
             StrandSystem& system) {
  const uint32_t before = curve.previous(i);
  double w = 0;
  if (before != kNone) {
    w += 0.5 * curve.shapes[before].length;
    system.diagonal[k] += stiffness_of(curve, metric, before);
  }
  if (curve.has_segment(i)) {
    w += 0.5 * curve.shapes[i].length;
    const double stiffness = stiffness_of(curve, metric, i);
    system.diagonal[k] += stiffness;
    system.first[k] = -stiffness;
  }
  system.diagonal[k] += w;
  system.right[k].x = w * raw_spacing(radii[i], metric.radius[i]);
}

}  // namespace

NodeData<double> smoothed_spacing(const Curve& curve, const LocalMetric& metric, const NodeData<Radii>& radii,
                                  StrandSolver& strands, ThreadPool& pool) {
  NodeData<double> spacing(curve.size());
  strands.for_strands(curve, pool, [&](const Strand& strand, ThreadPool& threads, StrandSystem& system) {
    system.reset(strand.count, threads);
    system.closed = strand.closed;
    threads.for_each(strand.count, kNodeGrain, [&](uint32_t k) {
      add_row(curve, metric, radii, strand.first + k, k, system);
    });
    const Table<Vec2> u = solve(system, threads);
    for (uint32_t k = 0; k < strand.count; ++k) spacing[strand.first + k] = u[k].x;
  });
  return spacing;
}

}  // namespace meander
