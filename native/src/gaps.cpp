// SPDX-License-Identifier: GPL-3.0-or-later
#include "gaps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "geodesic_trace.h"
#include "point_tree.h"
#include "segment_distance.h"

namespace meander {
namespace {

/// Starts this much smaller than a gap may still climb to one: a ball's centre is within about a
/// segment of the maximum that its node touches.
constexpr double kPromising = 0.9;

/// Starts within this share of a larger one's radius would climb to the same place.
constexpr double kSameStart = 0.5;

/// The climb tries this many directions, and ends at a step of this many r.
constexpr int kDirections = 8;
constexpr double kFinestStep = 0.005;
constexpr int kMostRounds = 200;

/// Less gain than this (relative) is rounding.
constexpr double kGain = 1 + 1e-9;

/// How empty the surface is at a point.
class Emptiness {
 public:
  Emptiness(const Surface& surface, const Curve& curve, const std::vector<Vec3>& nodes,
            const std::vector<double>& vertex_radius)
      : surface_(surface), curve_(curve), vertex_radius_(vertex_radius), tree_(nodes) {
    for (const PathShape& shape : curve.shapes) longest_half_ = std::max(longest_half_, 0.5 * shape.length);
  }

  double local_radius(const SurfacePoint& p) const { return radius_at(surface_, vertex_radius_, p); }

  /// Whether a node is nearer than `size` local r, which is cheaper to know than the distance.
  bool closer_than(const SurfacePoint& p, double size) const {
    const double reach = size * local_radius(p);
    return tree_.nearest(position(surface_, p), reach * reach).has_value();
  }

  /// The largest empty ball around a point.
  Gap at(const SurfacePoint& p) const {
    const Vec3 x = position(surface_, p);
    const PointTree::Hit nearest = *tree_.nearest(x);
    // The nearest segment need not be one of the nearest node's, but one of its own nodes is at most
    // half its length farther than it is.
    std::vector<uint32_t> near;
    const double reach = std::sqrt(nearest.squared_distance) + longest_half_;
    tree_.within(x, reach * reach, near);
    double distance = std::sqrt(nearest.squared_distance);
    for (const uint32_t node : near) {
      for (const uint32_t segment : {curve_.previous(node), node}) {
        if (segment != kNone && curve_.has_segment(segment)) {
          distance = std::min(distance, distance_to_path(x, segment));
        }
      }
    }
    return {p, distance, distance / local_radius(p)};
  }

  /// Climbs to a local maximum of the size by a pattern search: the distance has creases where the
  /// nearest strand changes, so it has no gradient just where the maxima are.
  Gap climb(Gap gap) const {
    const double finest = kFinestStep * local_radius(gap.centre);
    const double eighth = 2 * std::numbers::pi / kDirections;
    const Vec2 turn{std::cos(eighth), std::sin(eighth)};
    // Other directions after every failure, so that a crease or the boundary does not hide the way.
    const Vec2 offset{std::cos(0.382 * eighth), std::sin(0.382 * eighth)};
    Vec2 direction{1, 0};
    double step = 0.25 * gap.radius;
    std::vector<Crossing> crossings;
    for (int round = 0; round < kMostRounds && step > finest; ++round) {
      Gap best = gap;
      for (int k = 0; k < kDirections; ++k) {
        direction = direction * turn;
        crossings.clear();
        const Gap other = at(trace_geodesic(surface_, gap.centre, step * direction, crossings).end);
        if (other.size > kGain * best.size) best = other;
      }
      if (best.size > gap.size) {
        gap = best;
        step = std::min(2 * step, gap.radius);
      } else {
        step *= 0.5;
        direction = unit(direction * offset);
      }
    }
    return gap;
  }

 private:
  double distance_to_path(const Vec3& x, uint32_t segment) const {
    double distance = std::numeric_limits<double>::infinity();
    Vec3 from = tree_.points()[segment];
    for (const Crossing& crossing : curve_.paths[segment]) {
      const Vec3 to = position(surface_, crossing);
      distance = std::min(distance, distance_to_segment(x, from, to));
      from = to;
    }
    return std::min(distance, distance_to_segment(x, from, tree_.points()[curve_.next(segment)]));
  }

  const Surface& surface_;
  const Curve& curve_;
  const std::vector<double>& vertex_radius_;
  PointTree tree_;
  double longest_half_ = 0;
};

/// The largest first, without those whose centre is within `share` radii of a larger one.
std::vector<Gap> apart(const Surface& surface, const std::vector<Gap>& gaps, double share) {
  std::vector<Vec3> centres;
  for (const Gap& gap : gaps) centres.push_back(position(surface, gap.centre));
  const PointTree tree(std::move(centres));
  std::vector<uint32_t> order(gaps.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return gaps[a].size != gaps[b].size ? gaps[a].size > gaps[b].size : a < b;
  });
  std::vector<uint8_t> taken(gaps.size(), 0);
  std::vector<uint32_t> near;
  std::vector<Gap> kept;
  for (const uint32_t i : order) {
    if (taken[i]) continue;
    kept.push_back(gaps[i]);
    const double reach = share * gaps[i].radius;
    tree.within(tree.points()[i], reach * reach, near);
    for (const uint32_t k : near) taken[k] = 1;
  }
  return kept;
}

}  // namespace

std::vector<Gap> find_gaps(const Surface& surface, const Curve& curve, const Frames& frames,
                           const std::vector<Radii>& radii, const std::vector<double>& vertex_radius,
                           double least_size, Team& team) {
  const Emptiness emptiness(surface, curve, frames.position, vertex_radius);
  const double promising = kPromising * least_size;
  const size_t balls = 2 * size_t{curve.size()};
  const size_t count = balls + surface.face_count();
  constexpr size_t kBlock = 512;
  std::vector<std::vector<Gap>> found(Team::block_count(count, kBlock));
  team.for_blocks(count, kBlock, [&](size_t block, size_t begin, size_t end) {
    std::vector<Crossing> crossings;
    for (size_t k = begin; k < end; ++k) {
      SurfacePoint start;
      if (k < balls) {
        const size_t i = k / 2, side = k % 2;
        const double along = side == 0 ? radii[i][0] : -radii[i][1];
        crossings.clear();
        start = trace_geodesic(surface, curve.nodes[i], along * frames.bitangent2[i], crossings).end;
      } else {
        start = make_point(static_cast<uint32_t>(k - balls), 1.0 / 3, 1.0 / 3, 1.0 / 3);
      }
      if (emptiness.closer_than(start, promising)) continue;
      const Gap gap = emptiness.at(start);
      if (gap.size >= promising) found[block].push_back(gap);
    }
  });
  std::vector<Gap> starts;
  for (const std::vector<Gap>& block : found) starts.insert(starts.end(), block.begin(), block.end());

  std::vector<Gap> gaps = apart(surface, starts, kSameStart);
  team.for_blocks(gaps.size(), 16, [&](size_t, size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) gaps[k] = emptiness.climb(gaps[k]);
  });
  gaps = apart(surface, gaps, 1);
  std::erase_if(gaps, [&](const Gap& gap) { return gap.size < least_size; });
  return gaps;
}

}  // namespace meander
