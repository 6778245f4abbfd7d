// SPDX-License-Identifier: GPL-3.0-or-later
#include "boundary_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "geodesic_trace.h"

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

/// Share of the distance wanted below which the boundary pushes harder yet, and how much.
constexpr double kVeryNear = 0.7, kVeryNearPush = 6;

/// What of the boundary is turned to a side of a node by less than this (as a cosine) is not in its way.
constexpr double kFacing = 0.5;

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
    const bool faces = -boundary.inward()[k].dot(outward) >= kFacing;
    if (ahead > 0 && faces) way = std::min(way, d.squaredNorm() / ahead);
  }
  return way;
}

}  // namespace

BoundaryObstacle::BoundaryObstacle(const Surface& surface, double step)
    : tree_(sample_boundary(surface, step, edges_, inward_)) {}

void compute_reach(const Surface& surface, const Curve& curve, const Frames& frames,
                   const BoundaryObstacle& boundary, BoundaryRule rule, MedialAxis axis,
                   const std::vector<double>& max_radius, const std::vector<double>& overhang,
                   const std::vector<double>& least_rest, Team& team, std::vector<Reach>& reach) {
  const uint32_t n = curve.size();
  reach.resize(n);
  constexpr size_t kBlock = 512;
  team.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
    Path path;
    std::vector<uint32_t> near;
    for (auto i = static_cast<uint32_t>(begin); i < end; ++i) {
      const double most = max_radius[i];
      reach[i].fill({most, most, most});
      if (boundary.empty()) continue;
      const double beyond = rule == BoundaryRule::kCentre ? overhang[i] : 0;
      const double rest = rule == BoundaryRule::kCentre ? least_rest[i] : 0;
      const Vec3& x = frames.position[i];
      // From here on the boundary is too far to end a ball; never less than twice the clamp, so that a
      // winding way to it counts as well.
      const double far = std::max(2 * most, most - 2 * beyond);
      if (!boundary.tree().nearest(x, far * far)) continue;
      for (size_t side = 0; side < 2; ++side) {
        double way = frames.to_boundary[i][side];
        if (way < 0) {
          path.clear();
          const Vec2 direction = (side == 0 ? 1.0 : -1.0) * frames.bitangent2[i];
          const Trace trace =
              trace_geodesic(surface, curve.nodes[i], (most + std::max(0.0, -beyond)) * direction, path);
          way = trace.hit_boundary ? trace.length : std::numeric_limits<double>::infinity();
        }
        if (axis == MedialAxis::kEuclidean && rest > 0) {
          const double corner = way_to_corner(boundary, x, frames.outward[i][side], rest, near);
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
          r.driving = rest - 2 * lacking - kVeryNearPush * std::max(0.0, lacking - (1 - kVeryNear) * rest);
        } else {
          r.driving = r.radius;
        }
      }
    }
  });
}

}  // namespace meander
