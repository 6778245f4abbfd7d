// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/free_ends.h"

#include <algorithm>
#include <optional>
#include <span>

#include "geodesic/geodesic_trace.h"
#include "medial/constants.h"
#include "medial/empty_balls.h"
#include "medial/near_points.h"

namespace meander {
namespace {

/// The largest empty ball of Ma, Bae and Choi, see medial/empty_balls.h.
class BallAhead {
 public:
  BallAhead(const Vec3& x, const Vec3& outward, double most) : x_(x), outward_(outward), radius_(most) {}

  double radius() const { return radius_; }
  /// The centre of the ball with this radius.
  Vec3 centre(double radius) const { return x_ + radius * outward_; }
  void keep_out(const Vec3& p) {
    const Vec3 u = p - x_;
    const double ahead = u.dot(outward_);
    if (u.squaredNorm() < 2 * radius_ * ahead) radius_ = u.squaredNorm() / (2 * ahead);
  }

 private:
  Vec3 x_, outward_;
  double radius_;
};

double with_slack(double radius) { return radius + kBallRounding * (1 + radius); }

/// The nodes of a curve, for the balls ahead of its ends.
class Nodes {
 public:
  /// Refers to `positions`.
  Nodes(std::span<const Vec3> positions, size_t ends, ThreadPool& pool) : positions_(positions) {
    if (ends > kFewFreeEnds) tree_.emplace(positions, pool);
  }

  /// Shrinks a ball, which touches the curve at x, until none of the nodes is in it. The tree says which nodes may
  /// be the ones that limit it; those are then visited in order, as all are without it, to get the same last bit.
  void keep_out_of(BallAhead& ball, const Vec3& x, const Vec3& outward, std::vector<uint32_t>& near) const {
    if (!tree_) {
      for (const Vec3& p : positions_) ball.keep_out(p);
      return;
    }
    const double reach = with_slack(largest_ball(*tree_, {x, outward}, ball.radius(), CountAll{}).radius);
    find_inside(*tree_, ball.centre(reach), with_slack(reach), near);
    for (const uint32_t i : near) ball.keep_out(positions_[i]);
  }

 private:
  std::span<const Vec3> positions_;
  std::optional<CurveBvh> tree_;
};

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
  const Nodes nodes(frames.position.values(), ends.size(), pool);
  pool.for_blocks(ends.size(), 1, [&](size_t, size_t begin, size_t stop) {
    Path scratch;
    std::vector<uint32_t> near;
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
        const Trace to_boundary = trace_geodesic(surface, node, (most - metric.overhang[i]) * end.ahead, scratch);
        if (to_boundary.hit_boundary) most = std::clamp(to_boundary.length + metric.overhang[i], 0.0, most);
      }
      scratch.clear();
      BallAhead ball(frames.position[i], outward, most);
      nodes.keep_out_of(ball, frames.position[i], outward, near);
      if (rule == BoundaryRule::kObstacle) {
        const double reach = with_slack(ball.radius());
        boundary.tree().within(ball.centre(ball.radius()), reach * reach, near);
        for (const uint32_t sample : near) ball.keep_out(boundary.samples()[sample]);
      }
      end.radius = ball.radius();
    }
  });
  return ends;
}

}  // namespace meander
