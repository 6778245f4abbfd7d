// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/gaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <queue>
#include <span>
#include <unordered_set>

#include "base/point_tree.h"
#include "base/segment_distance.h"
#include "geodesic/geodesic_trace.h"

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

/// What hangs together with a place is looked for up to this many r from it.
constexpr double kFarthest = 3;

/// Less gain than this (relative) is rounding.
constexpr double kGain = 1 + 1e-9;

/// The segments that pass through every face.
class SegmentsOfFaces {
 public:
  SegmentsOfFaces(const Surface& surface, const Curve& curve) : first_(surface.face_count() + 1, 0) {
    const auto for_all = [&](const auto& visit) {
      for (uint32_t i = 0; i < curve.size(); ++i) {
        visit(curve.nodes[i].face, i);
        if (!curve.has_segment(i)) continue;
        for (const Crossing& crossing : curve.paths[i]) visit(face_of(crossing.twin), i);
      }
    };
    for_all([&](uint32_t face, uint32_t) { ++first_[face + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    segments_.resize(first_.back());
    std::vector<uint32_t> next = first_;
    for_all([&](uint32_t face, uint32_t segment) { segments_[next[face]++] = segment; });
  }
  std::span<const uint32_t> of(uint32_t face) const {
    return {segments_.data() + first_[face], segments_.data() + first_[face + 1]};
  }

 private:
  std::vector<uint32_t> first_, segments_;
};

/// How empty the surface is at a point.
class Emptiness {
 public:
  Emptiness(const Surface& surface, const Curve& curve, const std::vector<Vec3>& nodes,
            const RadiusField& radius, bool along_surface)
      : surface_(surface), curve_(curve), radius_(radius), tree_(nodes) {
    for (const PathShape& shape : curve.shapes) longest_half_ = std::max(longest_half_, 0.5 * shape.length);
    if (along_surface) segments_.emplace(surface, curve);
  }

  double local_radius(const SurfacePoint& p) const { return radius_.at(surface_, p); }

  /// Whether a node is nearer than `size` local r, which is cheaper to know than the distance.
  bool closer_than(const SurfacePoint& p, double size) const {
    const double r = local_radius(p), reach = size * r;
    const auto nearest = tree_.nearest(position(surface_, p), reach * reach);
    // What is on another sheet counts as no farther than kFarthest, see at().
    if (!nearest || !segments_ || reach >= kFarthest * r) return nearest.has_value();
    return hang_together(p, curve_.nodes[nearest->index].face, tree_.points()[nearest->index], reach) ||
           distance_on_surface(p, reach) < reach;
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
    uint32_t closest = kNone;
    for (const uint32_t node : near) {
      for (const uint32_t segment : {curve_.previous(node), node}) {
        if (segment == kNone || !curve_.has_segment(segment)) continue;
        const double d = distance_to_path(x, segment);
        if (d < distance) {
          distance = d;
          closest = segment;
        }
      }
    }
    const double r = local_radius(p);
    if (segments_ && distance < kFarthest * r && !reaches(p, distance, closest, nearest.index)) {
      distance = std::min(distance_on_surface(p, kFarthest * r), kFarthest * r);
    }
    return {p, distance, distance / r};
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
        const SurfacePoint end = trace_geodesic(surface_, gap.centre, step * direction, crossings).end;
        // Most are no better, and a node that is near enough says so.
        if (closer_than(end, best.size)) continue;
        const Gap other = at(end);
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

  /// Whether the nearest piece of the curve, of a segment or else a node, is on the same sheet as a point.
  bool reaches(const SurfacePoint& p, double distance, uint32_t segment, uint32_t node) const {
    if (segment == kNone) return hang_together(p, curve_.nodes[node].face, tree_.points()[node], distance);
    const Vec3 x = position(surface_, p);
    Vec3 from = tree_.points()[segment];
    uint32_t face = curve_.nodes[segment].face;
    for (const Crossing& crossing : curve_.paths[segment]) {
      const Vec3 to = position(surface_, crossing);
      if (distance_to_segment(x, from, to) <= distance) return hang_together(p, face, from, distance);
      from = to;
      face = face_of(crossing.twin);
    }
    return hang_together(p, face, from, distance);
  }

  /// Whether a few faces, the ones nearest to `goal` first, lead from a point to another face inside of a
  /// ball around the point; false also where they are many.
  bool hang_together(const SurfacePoint& p, uint32_t face, const Vec3& goal, double radius) const {
    constexpr size_t kMost = 64;
    const Vec3 x = position(surface_, p);
    std::array<uint32_t, kMost> faces;
    std::array<double, kMost> left;  // to the goal from the edge by which a face was entered
    size_t count = 1, done = 0;
    faces[0] = p.face;
    left[0] = 0;
    while (done < count) {
      size_t next = done;
      for (size_t k = done; k < count; ++k) next = left[k] < left[next] ? k : next;
      std::swap(faces[done], faces[next]);
      std::swap(left[done], left[next]);
      const uint32_t f = faces[done++];
      if (f == face) return true;
      const Triangle& corners = surface_.face(f);
      for (uint32_t k = 0; k < 3; ++k) {
        const HalfEdge twin = surface_.twin(3 * f + k);
        if (twin == kNone) continue;
        const uint32_t other = face_of(twin);
        const Vec3& a = surface_.position(corners[k]);
        const Vec3& b = surface_.position(corners[next_corner(k)]);
        if (!(distance_to_segment(x, a, b) < radius)) continue;
        if (std::find(faces.begin(), faces.begin() + count, other) != faces.begin() + count) continue;
        if (count == kMost) return false;
        faces[count] = other;
        left[count++] = distance_to_segment(goal, a, b);
      }
    }
    return false;
  }

  /// The radius of the smallest ball around a point whose part of the surface that hangs together with the
  /// point has a piece of the curve on it; infinite if it is not below `most`. Faces are entered in the
  /// order in which a growing ball reaches the edges between them.
  double distance_on_surface(const SurfacePoint& p, double most) const {
    const Vec3 x = position(surface_, p);
    using Entry = std::pair<double, uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::unordered_set<uint32_t> entered;
    double distance = std::numeric_limits<double>::infinity();
    queue.push({0, p.face});
    while (!queue.empty() && queue.top().first < std::min(most, distance)) {
      const auto [radius, face] = queue.top();
      queue.pop();
      if (!entered.insert(face).second) continue;
      for (const uint32_t segment : segments_->of(face)) {
        const double d = curve_.has_segment(segment) ? distance_to_path(x, segment)
                                                     : (tree_.points()[segment] - x).norm();
        distance = std::min(distance, std::max(radius, d));
      }
      const Triangle& corners = surface_.face(face);
      for (uint32_t k = 0; k < 3; ++k) {
        const HalfEdge twin = surface_.twin(3 * face + k);
        if (twin == kNone || entered.contains(face_of(twin))) continue;
        const double d = distance_to_segment(x, surface_.position(corners[k]),
                                             surface_.position(corners[next_corner(k)]));
        if (d < most) queue.push({std::max(radius, d), face_of(twin)});
      }
    }
    return distance < most ? distance : std::numeric_limits<double>::infinity();
  }

  const Surface& surface_;
  const Curve& curve_;
  const RadiusField& radius_;
  std::optional<SegmentsOfFaces> segments_;
  PointTree tree_;
  double longest_half_ = 0;
};

/// The largest first, without those whose centre is within `share` radii of a larger one, and
/// with `along_surface` on a face that looks the same way.
std::vector<Gap> apart(const Surface& surface, const std::vector<Gap>& gaps, double share, bool along_surface) {
  const auto face_each_other = [&](const Gap& a, const Gap& b) {
    return surface.face_normal(a.centre.face).dot(surface.face_normal(b.centre.face)) < 0;
  };
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
    for (const uint32_t k : near) {
      if (!along_surface || k == i || !face_each_other(gaps[i], gaps[k])) taken[k] = 1;
    }
  }
  return kept;
}

}  // namespace

std::vector<Gap> find_gaps(const Surface& surface, const Curve& curve, const Frames& frames,
                           const NodeData<Radii>& radii, const RadiusField& radius,
                           double least_size, bool along_surface, ThreadPool& pool) {
  const Emptiness emptiness(surface, curve, frames.position.values(), radius, along_surface);
  const double promising = kPromising * least_size;
  const size_t balls = 2 * size_t{curve.size()};
  const size_t count = balls + surface.face_count();
  constexpr size_t kBlock = 512;
  std::vector<std::vector<Gap>> found(ThreadPool::block_count(count, kBlock));
  pool.for_blocks(count, kBlock, [&](size_t block, size_t begin, size_t end) {
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

  std::vector<Gap> gaps = apart(surface, starts, kSameStart, along_surface);
  pool.for_blocks(gaps.size(), 16, [&](size_t, size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) gaps[k] = emptiness.climb(gaps[k]);
  });
  gaps = apart(surface, gaps, 1, along_surface);
  std::erase_if(gaps, [&](const Gap& gap) { return gap.size < least_size; });
  return gaps;
}

}  // namespace meander
