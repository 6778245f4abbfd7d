// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/geodesic_medial_axis.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "medial/constants.h"
#include "medial/ball_choice.h"
#include "medial/empty_balls.h"

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

/// What the points of a patch see, for the queries of the tree.
auto sight_of(const GeodesicScene& scene) {
  return SeeByKind{[&](size_t i) { return scene.obstacles.patch(i); },
                   [&](uint32_t patch, uint32_t run) { return scene.lanes_seen(patch, run); },
                   [&](size_t first, size_t last, uint32_t run) { return scene.share_seen(first, last, run); }};
}

/// What the balls are found from, and where they go.
struct BallsOfCurve {
  const GeodesicScene& scene;
  const LocalMetric& metric;
  const NodeData<Reach>& reach;
  const KeptBalls& kept;
  NodeData<Radii>& radii;

  bool measured(uint32_t i) const { return scene.measure && scene.patches.creased(scene.obstacles.patch(i)); }
  /// What is known of a ball that is measured; null if nothing is.
  const MeasuredBall* known(uint32_t i, size_t side) const {
    return kept.before && measured(i) ? &(*kept.before)[i][side] : nullptr;
  }
  double last_straight(uint32_t i, size_t side) const {
    const MeasuredBall* const ball = known(i, side);
    return ball && ball->straight > 0 ? static_cast<double>(ball->straight) : radii[i][side];
  }
};

/// The straight balls of a run: how large each may be at first, and what limits it.
struct StraightBallsOfRun {
  std::array<Radii, CurveBvh::kRun> start;
  std::array<std::array<uint32_t, 2>, CurveBvh::kRun> touched{};
};

/// Finds the straight balls of nodes begin .. end - 1 among those up to a little larger than the last ones.
void find_straight(const BallsOfCurve& balls, uint32_t begin, uint32_t end, StraightBallsOfRun& straight) {
  const GeodesicScene& scene = balls.scene;
  bool looks = false, creased = false;
  for (uint32_t i = begin; i < end; ++i) {
    const uint32_t patch = scene.obstacles.patch(i);
    looks = looks || !scene.sees_all(patch);
    creased = creased || scene.patches.creased(patch);
    for (size_t side = 0; side < 2; ++side) {
      const double most = std::max(0.0, balls.reach[i][side].radius), last = balls.last_straight(i, side);
      straight.start[i - begin][side] = balls.radii[i][side] = last > 0 ? std::min(most, kWarmth * last) : most;
    }
  }
  BallsAtPoints at{begin, end, scene.frames.outward, balls.radii};
  if (looks || creased) at.touched = straight.touched;
  if (looks) return largest_balls(scene.tree, at, sight_of(scene));
  largest_balls(scene.tree, at, SeeAll{});
}

/// The straight ball of one node, up to what the boundary leaves of it.
BallLimit straight_alone(const BallsOfCurve& balls, uint32_t i, size_t side) {
  const GeodesicScene& scene = balls.scene;
  const BallStart start{scene.frames.position[i], scene.frames.outward[i][side]};
  const double most = balls.reach[i][side].radius;
  const uint32_t patch = scene.obstacles.patch(i), part = scene.obstacles.part(i);
  if (!scene.sees_all(patch)) return largest_ball(scene.tree, start, most, sight_of(scene).alone(patch), part);
  if (balls.measured(i)) return largest_ball(scene.tree, start, most, CountAllInOrder{}, part);
  return largest_ball(scene.tree, start, most, CountAll{}, part);
}

/// The radius along the surface of a ball whose straight one is known, chosen anew or kept.
///
/// `start`  the first limit of the straight one
double radius_along_surface(const BallsOfCurve& balls, uint32_t i, size_t side, double start, BallLimit straight,
                            BallScratch& scratch) {
  const double most = balls.reach[i][side].radius, r = balls.metric.radius[i];
  const Vec3& position = balls.scene.frames.position[i];
  MeasuredBall own;
  if (const MeasuredBall* const before = balls.known(i, side); before && at_rest(*before, position, r)) own = *before;
  double radius = own.straight > 0 ? kept_radius(own, straight.radius) : 0;
  if (radius > 0) {
    radius = std::min(most, radius);
    ++own.age;
  } else {
    const ChosenBall chosen = choose_ball({balls.scene, i, side, r, most, start, straight}, scratch);
    radius = chosen.radius;
    own = {position.cast<float>(), static_cast<float>(straight.radius), static_cast<float>(radius), 1,
           chosen.searched};
  }
  if (balls.kept.after) (*balls.kept.after)[i][side] = own;
  return radius;
}

/// Finds the balls of nodes begin .. end - 1, a run of the tree or less.
void find_balls(const BallsOfCurve& balls, uint32_t begin, uint32_t end, BallScratch& scratch) {
  StraightBallsOfRun straight;
  find_straight(balls, begin, end, straight);
  for (size_t side = 0; side < 2; ++side) {
    scratch.sightings.forget();
    for (const uint32_t k : Sightings::kInTurn) {
      const uint32_t i = begin + k;
      if (i >= end || !(balls.reach[i][side].radius > 0)) continue;
      const double start = straight.start[k][side];
      BallLimit limit{balls.radii[i][side], straight.touched[k][side]};
      // An empty ball that no point limits is only a lower bound: start again from the clamp.
      if (!(limit.radius < start) && limit.radius < balls.reach[i][side].radius) limit = straight_alone(balls, i, side);
      balls.radii[i][side] =
          balls.measured(i) ? radius_along_surface(balls, i, side, start, limit, scratch) : limit.radius;
    }
  }
}

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
  const BallsOfCurve balls{scene, metric, reach, kept, radii};
  // Balls near creases take many times as long as others: larger blocks leave a thread without work.
  constexpr size_t kBlock = 64;
  pool.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
    BallScratch scratch(scene);
    for (auto first = static_cast<uint32_t>(begin); first < end; first += CurveBvh::kRun) {
      find_balls(balls, first, std::min(first + CurveBvh::kRun, static_cast<uint32_t>(end)), scratch);
    }
  });
}

}  // namespace meander
