// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/ray_ball.h"

#include <array>

#include "base/plane.h"
#include "medial/constants.h"
#include "medial/empty_balls.h"
#include "medial/near_points.h"

namespace meander {
namespace {

/// Ahead, and at .7 and 1.25 radians to either side.
constexpr std::array<Vec2, 5> kRays{{{1, 0},
                                     {0.7648421872844885, 0.644217687237691},
                                     {0.7648421872844885, -0.644217687237691},
                                     {0.3153223623952687, 0.9489846193555862},
                                     {0.3153223623952687, -0.9489846193555862}}};

/// One search along the rays of a node.
class RaySearch {
 public:
  /// `radius`  no ball is larger
  RaySearch(const SoughtBall& ball, const StrandNeighbours& own, double radius, Sightings& sightings)
      : ball_(ball), scene_(ball.scene), own_(own), sightings_(sightings), least_(radius) {}

  double radius() {
    if (flat_known_) {
      const auto counts = [&](uint32_t j) { return !own_.has(j) && scene_.sees(ball_.node, j) && ball_.alike(j); };
      least_ = largest_ball(scene_.tree, ball_.start(), least_, count_where(counts), ball_.part()).radius;
    }
    // Where no crease is within reach of the ball, or in it, that was all.
    const double to_crease = flat_known_ ? scene_.patches.to_crease(ball_.patch) : 0;
    if (to_crease > 2 * least_ || (flat_known_ && is_flat()) || seen_from_beside()) return least_;
    seen_.points.clear();
    lead_rays(to_crease);
    seen_.whole = true;
    seen_.flat_known = flat_known_;
    return seen_.least = least_;
  }

 private:
  void limit(Vec2 place) { least_ = ball_.limited(least_, place); }
  bool is_flat() const;
  bool seen_from_beside();
  void lead_rays(double to_crease);
  void look_around(const Chart& chart);
  void look_at(const Chart& chart, uint32_t index, const Vec3& position);
  void come_across(uint32_t index, Vec2 place) {
    if (!own_.has(index)) limit(place);
    seen_.points.push_back({index, place});
  }

  const SoughtBall& ball_;
  const GeodesicScene& scene_;
  const StrandNeighbours& own_;
  Sightings& sightings_;
  Sightings::OfNode& seen_ = sightings_.of(ball_.node);
  double least_;
  const bool flat_known_ = ball_.straight_on() && !scene_.patches.bent(ball_.patch);  // what lies in about its plane
};

/// Whether the ball holds no crease.
bool RaySearch::is_flat() const {
  const SurfacePatches& patches = scene_.patches;
  if (ball_.holds_crease(least_)) return false;
  if (patches.to_bend(ball_.patch) > 2 * least_) return true;
  Chart centre = ball_.here();
  centre.advance(scene_.surface, least_ * ball_.ahead);
  return !centre.at_boundary && patches.to_bend(patches.patch_of(scene_.surface, centre.point)) > least_;
}

/// What limits the ball among what rays of its neighbours have come across; false if that may not be all.
bool RaySearch::seen_from_beside() {
  const Curve& curve = scene_.curve;
  const uint32_t node = ball_.node;
  double known = 0;
  for (const bool forward : {false, true}) {
    uint32_t n = node;
    for (int k = 0; k < 2; ++k) {
      n = forward ? curve.next(n) : curve.previous(n);
      if (n == kNone || n / CurveBvh::kRun != node / CurveBvh::kRun) break;
      const Sightings::OfNode& there = sightings_.of(n);
      if (!there.whole || (there.flat_known && !flat_known_)) continue;
      Chart chart = Chart::at(curve.nodes[n], scene_.frames.position[n]);
      if (!chart.advance_to(scene_.surface, curve.nodes[node], scene_.frames.position[node], ball_.r)) continue;
      if (dot(chart.place, chart.place) > kBelievedBeside * kBelievedBeside * ball_.r * ball_.r) continue;
      for (const auto& [index, place] : there.points) {
        if (index != node && !own_.has(index)) limit(conj(chart.turn) * (place - chart.place));
      }
      known = std::max(known, there.least);
    }
  }
  return least_ <= kBelievedAsLarge * known;
}

void RaySearch::lead_rays(double to_crease) {
  look_around(ball_.here());
  for (const Vec2 turned : kRays) {
    const Vec2 direction = ball_.ahead * turned;
    const double half = 0.5 * kRayStep * ball_.r;
    double from = 0, to = std::max(2 * half, to_crease - half);
    const auto within = [&] { return to - half <= 2 * std::min(least_, kLongestLine * ball_.r) * turned.x; };
    if (!within()) continue;
    for (Chart chart = ball_.here(); within(); to += 2 * half) {
      chart.advance(scene_.surface, (to - from) * (conj(chart.turn) * direction));
      if (chart.at_boundary) break;
      look_around(chart);
      from = to;
    }
  }
}

void RaySearch::look_around(const Chart& chart) {
  const SurfacePatches& patches = scene_.patches;
  const uint32_t patch = patches.patch_of(scene_.surface, chart.point);
  const bool alike = patches.normal(patch).dot(patches.normal(ball_.patch)) >= kAlikeNormals;
  if (flat_known_ && !patches.at_crease(patch) && alike) return;
  const std::span<const uint32_t> beside = patches.beside(patch);
  const auto visit = [&](uint32_t index) {
    const Vec3& position = scene_.obstacles.positions()[index];
    // No path is shorter than the straight line, and no ball that a path limits is smaller than half of it.
    constexpr double kFar = 2 * kBelievedAsLarge;
    if (index == ball_.node || (position - ball_.position()).squaredNorm() >= kFar * kFar * least_ * least_) return;
    // Looks overlap, and see a point in the same place.
    if (std::ranges::find(seen_.points, index, &Sightings::Point::index) != seen_.points.end()) return;
    const uint32_t there = scene_.obstacles.patch(index);
    if (there == patch || std::ranges::find(beside, there) != beside.end()) look_at(chart, index, position);
  };
  visit_inside(scene_.tree, chart.position, kLookedAround * ball_.r, visit, ball_.part());
}

void RaySearch::look_at(const Chart& chart, uint32_t index, const Vec3& position) {
  const Surface& s = scene_.surface;
  const SurfacePoint& p = scene_.obstacles.point(index);
  if (p.face == chart.point.face) {
    come_across(index, chart.place + chart.turn * (flat(s, p) - flat(s, chart.point)));
  } else if (s.face_normal(p.face).dot(s.face_normal(chart.point.face)) >= kNearlyFlat) {
    come_across(index, chart.place + chart.turn * s.to_plane(chart.point.face, position - chart.position));
  } else if (Chart there = chart; there.advance_to(s, p, position, ball_.r)) {
    come_across(index, there.place);
  }
}

}  // namespace

double ball_by_rays(const SoughtBall& ball, const StrandNeighbours& own, double radius, Sightings& sightings) {
  const double found = RaySearch(ball, own, std::min(radius, ball.likely), sightings).radius();
  if (found < ball.likely || radius <= ball.likely) return found;
  return RaySearch(ball, own, radius, sightings).radius();
}

}  // namespace meander
