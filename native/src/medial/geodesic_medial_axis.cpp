// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/geodesic_medial_axis.h"

#include <algorithm>
#include <array>

#include "medial/geodesic_ball.h"

namespace meander {
namespace {

/// The balls of nodes begin .. end - 1, a run of the tree or less.
class BallsOfRun {
 public:
  BallsOfRun(const GeodesicScene& scene, const LocalMetric& metric, const NodeData<Reach>& reach,
             const CurveBvh::Sight& sight, NodeData<Radii>& radii)
      : scene_(scene), metric_(metric), reach_(reach), sight_(sight), radii_(radii), ball_(scene) {}

  void find(uint32_t begin, uint32_t end) {
    bool looks = false, creased = false;
    for (uint32_t i = begin; i < end; ++i) {
      const uint32_t patch = scene_.obstacles.patch(i);
      looks = looks || !scene_.sees_all(patch);
      creased = creased || scene_.patches.creased(patch);
      for (size_t side = 0; side < 2; ++side) {
        const double most = std::max(0.0, reach_[i][side].radius), last = radii_[i][side];
        start_[i - begin][side] = radii_[i][side] = last > 0 ? std::min(most, kWarmth * last) : most;
      }
    }
    if (looks) {
      scene_.tree.largest_balls_seen(begin, end, scene_.frames.outward, sight_, radii_, touched_);
    } else if (creased) {
      scene_.tree.largest_balls(begin, end, scene_.frames.outward, radii_, touched_);
    } else {
      scene_.tree.largest_balls(begin, end, scene_.frames.outward, radii_);
    }
    for (size_t side = 0; side < 2; ++side) {
      ball_.forget();
      for (const uint32_t k : GeodesicBall::kInTurn) {
        const uint32_t i = begin + k;
        if (i < end && reach_[i][side].radius > 0) finish(i, side, start_[k][side], touched_[k][side]);
      }
    }
  }

 private:
  void finish(uint32_t i, size_t side, double start, uint32_t touched) {
    const uint32_t patch = scene_.obstacles.patch(i);
    const bool measured = scene_.measure && scene_.patches.creased(patch);
    double& radius = radii_[i][side];
    const double most = reach_[i][side].radius;
    // An empty ball that no point limits is only a lower bound: start again from the clamp.
    if (!(radius < start) && radius < most) {
      const Vec3 &x = scene_.frames.position[i], &outward = scene_.frames.outward[i][side];
      radius = scene_.sees_all(patch) ? scene_.tree.largest_ball(x, outward, most, measured ? &touched : nullptr)
                               : scene_.tree.largest_ball_seen(
                                     x, outward, most, [&](uint32_t j) { return scene_.sees(i, j); }, touched);
    }
    if (measured) radius = ball_.largest(i, side, radius, touched, start, most, metric_.radius[i]);
  }

  const GeodesicScene& scene_;
  const LocalMetric& metric_;
  const NodeData<Reach>& reach_;
  const CurveBvh::Sight& sight_;
  NodeData<Radii>& radii_;
  GeodesicBall ball_;
  std::array<Radii, CurveBvh::kRun> start_;
  std::array<std::array<uint32_t, 2>, CurveBvh::kRun> touched_;
};

}  // namespace

void compute_geodesic_medial_axis(const Surface& surface, const SurfacePatches& patches, const Curve& curve,
                                  const Frames& frames, const BoundaryObstacle& boundary, BoundaryRule rule,
                                  bool measure, const LocalMetric& metric, const NodeData<Reach>& reach,
                                  ThreadPool& pool, CurveBvh& tree, NodeData<Radii>& radii) {
  const uint32_t n = curve.size();
  radii.resize(n, Radii{0, 0});
  const Obstacles obstacles(surface, patches, curve, frames, boundary, rule, pool);
  tree.build(obstacles.positions(), pool);
  const GeodesicScene scene{surface, patches, curve, frames, obstacles, tree, measure};
  const CurveBvh::Sight sight{
      obstacles.patches(), [&](uint32_t patch, uint32_t run) { return scene.lanes_seen(patch, run); },
      [&](size_t first, size_t last, uint32_t run) { return scene.any_seen(first, last, run); }};
  constexpr size_t kBlock = 256;
  pool.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
    BallsOfRun balls(scene, metric, reach, sight, radii);
    for (auto first = static_cast<uint32_t>(begin); first < end; first += CurveBvh::kRun) {
      balls.find(first, std::min(first + CurveBvh::kRun, static_cast<uint32_t>(end)));
    }
  });
}

}  // namespace meander
