// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial_axis.h"

#include <algorithm>
#include <cmath>

#include "geodesic_trace.h"

namespace meander {
namespace {

/// A point counts as inside a ball when it is nearer to the centre by more than this share of the
/// radius: the points that the ball touches are at its radius only up to rounding.
constexpr double kInside = 1 - 1e-9;

/// A ball may start this much larger than the node's last one before it is known to be large enough.
constexpr double kWarmth = 1.2;

/// Balls much smaller than the clamp are no start: to one of 1e-8 of the mesh the node itself, whose
/// distance from the centre is rounded, may seem to lie inside.
constexpr double kTooCold = 1e-3;

std::vector<Vec3> sample_boundary(const Surface& surface, double step) {
  std::vector<Vec3> samples;
  for (const HalfEdge e : surface.boundary()) {
    const Triangle& t = surface.face(face_of(e));
    const Vec3& a = surface.position(t[corner_of(e)]);
    const Vec3& b = surface.position(t[next_corner(corner_of(e))]);
    const int pieces = std::max(1, static_cast<int>(std::min(1e6, std::ceil((b - a).norm() / step))));
    for (int k = 0; k < pieces; ++k) samples.push_back(a + (b - a) * (double(k) / pieces));
  }
  return samples;
}

class BallShrinker {
 public:
  explicit BallShrinker(const PointTree& tree) : tree_(tree) {}

  /// The radius of the largest empty ball at x towards `b` (unit), at most `most`.
  double operator()(const Vec3& x, const Vec3& b, double most, double last) const {
    double radius = last > kTooCold * most ? std::min(most, kWarmth * last) : most;
    bool warm = radius < most;
    for (int k = 0; k < kMostBalls; ++k) {
      const double bound = kInside * radius;
      const auto hit = tree_.nearest(x + radius * b, bound * bound);
      if (!hit) {
        if (!warm) return radius;
        // An empty ball that no point limits is only a lower bound: start again from the clamp.
        radius = most;
        warm = false;
        continue;
      }
      warm = false;
      const Vec3 u = tree_.points()[hit->index] - x;
      const double ahead = u.dot(b);
      const double smaller = u.squaredNorm() / (2 * ahead);
      if (!(ahead > 0) || !(smaller < radius)) return radius;  // only rounding says it is inside
      radius = smaller;
    }
    return radius;
  }

 private:
  static constexpr int kMostBalls = 60;
  const PointTree& tree_;
};

}  // namespace

BoundaryObstacle::BoundaryObstacle(const Surface& surface, double step)
    : tree_(sample_boundary(surface, step)) {}

void compute_medial_axis(const Surface& surface, const Curve& curve, const Frames& frames,
                         const BoundaryObstacle& boundary, BoundaryRule rule,
                         const std::vector<double>& max_radius, Team& team, std::vector<Radii>& radii) {
  const uint32_t n = curve.size();
  radii.resize(n, Radii{0, 0});
  std::vector<Vec3> obstacles = frames.position;
  const bool walls = rule == BoundaryRule::kObstacle;
  if (walls) obstacles.insert(obstacles.end(), boundary.samples().begin(), boundary.samples().end());
  const PointTree tree(std::move(obstacles));
  const BallShrinker shrink(tree);

  constexpr size_t kBlock = 256;
  team.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
    std::vector<Crossing> scratch;
    for (uint32_t i = static_cast<uint32_t>(begin); i < end; ++i) {
      const Vec3& x = frames.position[i];
      const bool near_boundary =
          !walls && !boundary.empty() && boundary.tree().nearest(x, 4 * max_radius[i] * max_radius[i]).has_value();
      for (int side = 0; side < 2; ++side) {
        const double sign = side == 0 ? 1 : -1;
        double most = max_radius[i];
        if (near_boundary && frames.to_boundary[i][side] >= 0) {
          most = std::min(most, frames.to_boundary[i][side]);
        } else if (near_boundary) {
          scratch.clear();
          const Trace trace =
              trace_geodesic(surface, curve.nodes[i], sign * most * frames.bitangent2[i], scratch);
          if (trace.hit_boundary) most = std::min(most, trace.length);
        }
        radii[i][side] = most > 0 ? shrink(x, frames.outward[i][side], most, radii[i][side]) : 0;
      }
    }
  });
}

}  // namespace meander
