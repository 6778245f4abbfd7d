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

/// A node sees something on both sides, but nothing nearer than kSlack r.
auto is_slack_on(const NodeData<Radii>& radii, const LocalMetric& metric) {
  return [&radii, &metric](size_t k) {
    const auto i = static_cast<uint32_t>(k);
    const double least = std::min(radii[i][0], radii[i][1]);
    return least >= kSlack * metric.radius[i] && least < kClamped * metric.max_radius[i];
  };
}

}  // namespace

bool has_room(const NodeData<Radii>& radii, const LocalMetric& metric, uint32_t node, double room) {
  const double least = std::min(kClamped * metric.max_radius[node], room * metric.radius[node]);
  return std::min(radii[node][0], radii[node][1]) >= least;
}

double clamped_share(const Curve& curve, const NodeData<Radii>& radii, const LocalMetric& metric, ThreadPool& pool) {
  const double clamped = sum_over_free(curve, pool, [&](uint32_t i) {
    return std::max(radii[i][0], radii[i][1]) >= kClamped * metric.max_radius[i];
  });
  return clamped / free_nodes(curve, pool);
}

double alone_share(const Curve& curve, const NodeData<Radii>& radii, const NodeData<Reach>& reach,
                   const LocalMetric& metric, ThreadPool& pool) {
  if (std::ranges::all_of(curve.strands, [](const Strand& s) { return s.closed || s.guide; })) return 0;
  NodeData<uint8_t> open(curve.size());
  for (const Strand& strand : curve.strands) {
    for (uint32_t i = strand.first; i < strand.end(); ++i) open[i] = !strand.closed && !strand.guide;
  }
  const double alone = sum_over_free(curve, pool, [&](uint32_t i) {
    const auto at_boundary = [&](size_t side) {
      const double radius = radii[i][side];
      return reach[i][side].radius <= radius && radius < kClamped * metric.max_radius[i];
    };
    return open[i] && at_boundary(0) && at_boundary(1) &&
           radii[i][0] + radii[i][1] - 2 * metric.overhang[i] > kWidestAlone * metric.radius[i];
  });
  return alone / free_nodes(curve, pool);
}

double slack_share(const Curve& curve, const NodeData<Radii>& radii, const LocalMetric& metric, ThreadPool& pool) {
  return sum_over_free(curve, pool, is_slack_on(radii, metric)) / free_nodes(curve, pool);
}

double balanced_share(const Curve& curve, const NodeData<Radii>& radii, const LocalMetric& metric, ThreadPool& pool) {
  const auto is_slack = is_slack_on(radii, metric);
  if (pool.first(curve.size(), kNodeGrain, is_slack) == curve.size()) return 0;
  double balanced = 0;
  for (const Strand& strand : curve.strands) {
    if (strand.guide) continue;
    double length = 0, nodes = 0;
    for (uint32_t i = strand.first; i <= strand.end(); ++i) {
      if (i < strand.end() && is_slack(i)) {
        ++nodes;
        if (curve.has_segment(i)) length += curve.shapes[i].length / metric.radius[i];
        continue;
      }
      if (length >= kPerturbationWavelength) balanced += nodes;
      length = nodes = 0;
    }
  }
  return balanced / free_nodes(curve, pool);
}

void perturb_empty_stretches(const Curve& curve, const NodeData<Radii>& radii, const LocalMetric& metric,
                             double room, double share, ThreadPool& pool, NodeData<Radii>& felt_radii) {
  const size_t n = curve.size();
  const auto empty = [&](size_t i) { return has_room(radii, metric, static_cast<uint32_t>(i), room); };
  if (pool.first(n, kNodeGrain, empty) == n) return;
  for (const Strand& strand : curve.strands) {
    double phase = 2 * std::numbers::pi * share;
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
