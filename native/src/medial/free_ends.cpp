// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/free_ends.h"

#include <algorithm>

#include "geodesic/geodesic_trace.h"

namespace meander {
namespace {

/// Ma, Bae and Choi's ball, by looking at every point: ends are few, and each has one ball only.
double largest_ball(const Vec3& x, const Vec3& outward, double most, const std::vector<Vec3>& points) {
  for (const Vec3& p : points) {
    const Vec3 u = p - x;
    const double ahead = u.dot(outward);
    if (u.squaredNorm() < 2 * most * ahead) most = u.squaredNorm() / (2 * ahead);
  }
  return most;
}

}  // namespace

std::vector<FreeEnd> find_free_ends(const Surface& surface, const Curve& curve, const Frames& frames,
                                    const BoundaryObstacle& boundary, BoundaryRule rule,
                                    const LocalMetric& metric, ThreadPool& pool) {
  std::vector<FreeEnd> ends;
  for (const Strand& s : curve.strands) {
    if (s.closed || s.guide || s.count < 2) continue;
    const uint32_t last = s.end() - 1;
    if (!curve.fixed[s.first]) ends.push_back({s.first, -1 * curve.shapes[s.first].leaving, 0});
    if (!curve.fixed[last]) ends.push_back({last, curve.shapes[last - 1].arriving, 0});
  }
  pool.for_blocks(ends.size(), 1, [&](size_t, size_t begin, size_t stop) {
    Path scratch;
    for (size_t k = begin; k < stop; ++k) {
      FreeEnd& end = ends[k];
      const uint32_t i = end.node;
      const SurfacePoint& node = curve.nodes[i];
      const Trace trace = trace_geodesic(surface, node, metric.radius[i] * end.ahead, scratch);
      const Vec3 chord = position(surface, trace.end) - frames.position[i];
      const Vec3 outward = trace.length > 0 && chord.norm() > 0 ? Vec3(chord.normalized())
                                                                : surface.to_space(node.face, end.ahead);
      double most = metric.max_radius[i];
      if (rule == BoundaryRule::kCentre && !boundary.empty()) {
        scratch.clear();
        const Trace way = trace_geodesic(surface, node, (most - metric.overhang[i]) * end.ahead, scratch);
        if (way.hit_boundary) most = std::clamp(way.length + metric.overhang[i], 0.0, most);
      }
      scratch.clear();
      end.radius = largest_ball(frames.position[i], outward, most, frames.position.values());
      if (rule == BoundaryRule::kObstacle) {
        end.radius = largest_ball(frames.position[i], outward, end.radius, boundary.samples());
      }
    }
  });
  return ends;
}

}  // namespace meander
