// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/boundary_reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "base/tuning.h"
#include "geodesic/geodesic_trace.h"

namespace meander {
namespace {

std::vector<Vec3> sample_boundary(const Surface& surface, double step, std::vector<HalfEdge>& edges,
                                  std::vector<Vec3>& inward) {
  struct Side {
    uint32_t from, to;
    Vec3 inward;
  };
  const auto side_of = [&](HalfEdge e) {
    const uint32_t f = face_of(e), k = corner_of(e);
    const Triangle& t = surface.face(f);
    const Vec3 way = surface.position(t[next_corner(k)]) - surface.position(t[k]);
    return Side{t[k], t[next_corner(k)], surface.face_normal(f).cross(way).normalized()};
  };
  std::vector<Vec3> at_vertex(surface.boundary().empty() ? 0 : surface.vertex_count(), Vec3::Zero());
  for (const HalfEdge e : surface.boundary()) {
    const Side side = side_of(e);
    at_vertex[side.from] += side.inward;
    at_vertex[side.to] += side.inward;
  }
  std::vector<Vec3> samples;
  for (const HalfEdge e : surface.boundary()) {
    const Side side = side_of(e);
    const Vec3 &a = surface.position(side.from), &b = surface.position(side.to);
    const int pieces = std::max(1, static_cast<int>(std::min(1e6, std::ceil((b - a).norm() / step))));
    for (int k = 0; k < pieces; ++k) {
      samples.push_back(a + (b - a) * (double(k) / pieces));
      edges.push_back(e);
      inward.push_back(k == 0 ? at_vertex[side.from].normalized() : side.inward);
    }
  }
  return samples;
}

/// Twice the radius of the largest ball on this side that holds no point of a boundary which faces it,
/// where that is less than `most`. Straight ahead it is the distance; a corner that juts out beside the
/// way to the boundary is nearer than its end.
double way_to_corner(const BoundaryObstacle& boundary, const Vec3& x, const Vec3& outward, double most,
                     std::vector<uint32_t>& near) {
  double way = most;
  boundary.tree().within(x, most * most, near);
  for (const uint32_t k : near) {
    const Vec3 d = boundary.samples()[k] - x;
    const double ahead = d.dot(outward);
    const bool faces = -boundary.inward()[k].dot(outward) >= tuning::kFacing;
    if (ahead > 0 && faces) way = std::min(way, d.squaredNorm() / ahead);
  }
  return way;
}

}  // namespace

BoundaryObstacle::BoundaryObstacle(const Surface& surface, double step)
    : step_(step), tree_(sample_boundary(surface, step, edges_, inward_)) {}

void compute_reach(const Surface& surface, const Curve& curve, const Frames& frames,
                   const BoundaryObstacle& boundary, BoundaryRule rule, MedialAxis axis,
                   const LocalMetric& metric, ThreadPool& pool, NodeData<Reach>& reach) {
  const uint32_t n = curve.size();
  const auto beyond_of = [&](uint32_t i) { return rule == BoundaryRule::kCentre ? metric.overhang[i] : 0; };
  const auto rest_of = [&](uint32_t i) { return rule == BoundaryRule::kCentre ? metric.least_rest[i] : 0; };
  const auto look_of = [&](uint32_t i) { return metric.max_radius[i] + std::max(0.0, -beyond_of(i)); };
  reach.resize(n);
  constexpr size_t kBlock = 512;
  pool.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
    struct Way {
      uint32_t node, side;
      double length;  // to the boundary; infinite where it is too far to matter, negative until it is known
    };
    std::vector<Way> ways;
    std::vector<uint32_t> near;
    for (auto i = static_cast<uint32_t>(begin); i < end; ++i) {
      const double most = metric.max_radius[i];
      reach[i].fill({most, most, most});
      // A way that ends at the boundary is no shorter than the straight line to there, and leaves a sample
      // beside it.
      const double far = std::max(look_of(i), rest_of(i)) + boundary.step();
      if (boundary.empty() || !boundary.tree().any_within(frames.position[i], far * far)) continue;
      for (uint32_t side = 0; side < 2; ++side) ways.push_back({i, side, frames.to_boundary[i][side]});
    }

    std::vector<GeodesicWalk> walks;
    std::array<Way*, kTogether> walking;
    walks.reserve(kTogether);
    for (auto way = ways.begin(); way != ways.end();) {
      walks.clear();
      for (; way != ways.end() && walks.size() < kTogether; ++way) {
        if (way->length >= 0) continue;
        const Vec2 direction = (way->side == 0 ? 1.0 : -1.0) * frames.bitangent2[way->node];
        walking[walks.size()] = &*way;
        walks.emplace_back(surface, curve.nodes[way->node], look_of(way->node) * direction);
      }
      lead_together(walks, [](size_t) {});
      for (size_t k = 0; k < walks.size(); ++k) {
        walking[k]->length = walks[k].hit_boundary() ? walks[k].length() : std::numeric_limits<double>::infinity();
      }
    }

    for (const auto& [i, side, length] : ways) {
      const double beyond = beyond_of(i), rest = rest_of(i), most = metric.max_radius[i];
      double way = length;
      if (axis == MedialAxis::kEuclidean && rest > 0) {
        const double corner = way_to_corner(boundary, frames.position[i], frames.outward[i][side], rest, near);
        if (corner < rest) way = std::min(way, corner);
      }
      ReachOfSide& r = reach[i][side];
      r.radius = std::clamp(way + beyond, 0.0, most);
      r.centre = std::min(most, way);
      // Nearer than is wanted the boundary pushes twice as hard: two strands that are squeezed between
      // boundaries would else settle at half of their distance from each other. And harder yet where
      // they are very near, as at a corner, which pushes a few nodes only.
      const double lacking = rest - (way + beyond);
      if (rest > 0 && lacking > 0) {
        const double far_short = std::max(0.0, lacking - (1 - tuning::kVeryNear) * rest);
        r.driving = rest - 2 * lacking - tuning::kVeryNearPush * far_short;
      } else {
        r.driving = r.radius;
      }
    }
  });
}

}  // namespace meander
