// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/geodesic_medial_axis.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "medial/constants.h"
#include "medial/geodesic_ball.h"

namespace meander {
namespace {

/// Whether a node has been at rest since a ball of it was measured, which was not long ago.
bool at_rest(const MeasuredBall& known, const Vec3& position, double r) {
  if (!(known.straight > 0) || known.age >= kBallIterations) return false;
  const double rest = kBallRest * r;
  return (position - known.from.cast<double>()).squaredNorm() <= rest * rest;
}

/// The radius along the surface that such a node keeps; not positive if it has to be measured again.
double kept_radius(const MeasuredBall& known, double straight) {
  if (known.searched) return known.age < kSearchedIterations ? static_cast<double>(known.measured) : 0;
  const double before = static_cast<double>(known.straight);
  if (!(std::abs(straight - before) <= kBallChange * before)) return 0;
  return straight * (static_cast<double>(known.measured) / before);
}

/// The balls of nodes begin .. end - 1, a run of the tree or less.
class BallsOfRun {
 public:
  BallsOfRun(const GeodesicScene& scene, const LocalMetric& metric, const NodeData<Reach>& reach,
             const CurveBvh::Sight& sight, const KeptBalls& kept, NodeData<Radii>& radii)
      : scene_(scene),
        metric_(metric),
        reach_(reach),
        sight_(sight),
        kept_(kept),
        radii_(radii),
        ball_(scene) {}

  void find(uint32_t begin, uint32_t end) {
    bool looks = false, creased = false;
    for (uint32_t i = begin; i < end; ++i) {
      const uint32_t patch = scene_.obstacles.patch(i);
      looks = looks || !scene_.sees_all(patch);
      creased = creased || scene_.patches.creased(patch);
      for (size_t side = 0; side < 2; ++side) {
        const double most = std::max(0.0, reach_[i][side].radius), last = last_straight(i, side);
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
  bool measured(uint32_t i) const { return scene_.measure && scene_.patches.creased(scene_.obstacles.patch(i)); }
  /// What is known of a ball that is measured; null if nothing is.
  const MeasuredBall* known(uint32_t i, size_t side) const {
    return kept_.before && measured(i) ? &(*kept_.before)[i][side] : nullptr;
  }
  double last_straight(uint32_t i, size_t side) const {
    const MeasuredBall* const ball = known(i, side);
    return ball && ball->straight > 0 ? static_cast<double>(ball->straight) : radii_[i][side];
  }

  void finish(uint32_t i, size_t side, double start, uint32_t touched) {
    const uint32_t patch = scene_.obstacles.patch(i);
    const bool creased = measured(i);
    double& radius = radii_[i][side];
    const double most = reach_[i][side].radius;
    // An empty ball that no point limits is only a lower bound: start again from the clamp.
    if (!(radius < start) && radius < most) {
      const Vec3 &x = scene_.frames.position[i], &outward = scene_.frames.outward[i][side];
      const uint32_t part = scene_.obstacles.part(i);
      radius = scene_.sees_all(patch)
                   ? scene_.tree.largest_ball(x, outward, most, creased ? &touched : nullptr, part)
                   : scene_.tree.largest_ball_of_kind(sight_, patch, x, outward, most, touched, part);
    }
    if (creased) radius = measure(i, side, start, touched);
  }

  /// The radius along the surface of the ball whose straight one is known, measured or kept.
  double measure(uint32_t i, size_t side, double start, uint32_t touched) {
    const double straight = radii_[i][side], most = reach_[i][side].radius, r = metric_.radius[i];
    const Vec3& position = scene_.frames.position[i];
    MeasuredBall own;
    if (const MeasuredBall* const before = known(i, side); before && at_rest(*before, position, r)) own = *before;
    const double kept = own.straight > 0 ? kept_radius(own, straight) : 0;
    double radius;
    if (kept > 0) {
      radius = std::min(most, kept);
      ++own.age;
    } else {
      radius = ball_.largest(i, side, straight, touched, start, most, r);
      own = {position.cast<float>(), static_cast<float>(straight), static_cast<float>(radius), 1, ball_.searched()};
    }
    if (kept_.after) (*kept_.after)[i][side] = own;
    return radius;
  }

  const GeodesicScene& scene_;
  const LocalMetric& metric_;
  const NodeData<Reach>& reach_;
  const CurveBvh::Sight& sight_;
  const KeptBalls& kept_;
  NodeData<Radii>& radii_;
  GeodesicBall ball_;
  std::array<Radii, CurveBvh::kRun> start_;
  std::array<std::array<uint32_t, 2>, CurveBvh::kRun> touched_;
};

}  // namespace

void compute_geodesic_medial_axis(const Surface& surface, const SurfacePatches& patches, const Curve& curve,
                                  const Frames& frames, const BoundaryObstacle& boundary, BoundaryRule rule,
                                  bool measure, const LocalMetric& metric, const NodeData<Reach>& reach,
                                  ThreadPool& pool, CurveBvh& tree, NodeData<Radii>& radii, KeptBalls kept) {
  const uint32_t n = curve.size();
  if (kept.before && kept.before->empty()) kept.before = nullptr;
  if (kept.after) kept.after->assign(measure && patches.creased_anywhere() ? n : 0, {});
  radii.resize(n, Radii{0, 0});
  const Obstacles obstacles(surface, patches, curve, frames, boundary, rule, pool);
  tree.build(obstacles.positions(), pool, obstacles.parts());
  PointsOfFaces points;
  if (measure && patches.coarse_creases_anywhere()) {
    points.sort(surface, static_cast<uint32_t>(obstacles.positions().size()),
                [&](uint32_t i) { return obstacles.point(i); }, pool);
  }
  const GeodesicScene scene{surface, patches, curve, frames, obstacles, tree, measure, points};
  const CurveBvh::Sight sight{
      obstacles.patches(), [&](uint32_t patch, uint32_t run) { return scene.lanes_seen(patch, run); },
      [&](size_t first, size_t last, uint32_t run) { return scene.share_seen(first, last, run); }};
  // Balls near creases take many times as long as others: larger blocks leave a thread without work.
  constexpr size_t kBlock = 64;
  pool.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
    BallsOfRun balls(scene, metric, reach, sight, kept, radii);
    for (auto first = static_cast<uint32_t>(begin); first < end; first += CurveBvh::kRun) {
      balls.find(first, std::min(first + CurveBvh::kRun, static_cast<uint32_t>(end)));
    }
  });
}

}  // namespace meander
