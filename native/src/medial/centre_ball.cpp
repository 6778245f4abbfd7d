// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/centre_ball.h"

#include "medial/constants.h"
#include "medial/near_points.h"

namespace meander {
namespace {

/// What the centre of a ball, at the end of a straight way from the node, leaves of it.
double seen_from(const Chart& centre, const SoughtBall& ball, double radius, std::vector<uint32_t>& near) {
  const GeodesicScene& scene = ball.scene;
  const Vec2 arriving = conj(centre.turn) * ball.ahead;
  const uint32_t there = scene.patches.patch_of(scene.surface, centre.point);
  const double inside = (1 - kInsideOfBall) * radius;
  double least = radius;
  find_inside(scene.tree, centre.position, inside, near, ball.part());
  for (const uint32_t p : near) {
    if (p == ball.node || !scene.sees(ball.node, p)) continue;
    if (scene.patches.opposite(there, scene.obstacles.patch(p))) continue;
    Chart seen = Chart::at(centre.point, centre.position);
    const Vec3& goal = scene.obstacles.positions()[p];
    if (!seen.advance_to(scene.surface, scene.obstacles.point(p), goal, 2 * radius)) continue;
    if (dot(seen.place, seen.place) >= inside * inside) continue;
    // From the node, if the surface between were flat.
    const Vec2 from_node = seen.place + radius * arriving;
    const double ahead = dot(from_node, arriving);
    if (ahead > 0) least = std::min(least, dot(from_node, from_node) / (2 * ahead));
  }
  return least;
}

}  // namespace

double ball_from_centre(const SoughtBall& ball, double radius, std::vector<uint32_t>& near) {
  for (int round = 0; round < kMostCentreRounds; ++round) {
    if (radius > kSeenFromCentre * ball.r || (ball.straight_on() && !ball.holds_crease(radius))) return radius;
    Chart way = ball.here();
    way.advance(ball.scene.surface, radius * ball.ahead);
    if (way.at_boundary) return radius;
    const double before = radius;
    radius = seen_from(way, ball, radius, near);
    if (radius >= (1 - kInsideOfBall) * before) return radius;
  }
  return radius;
}

}  // namespace meander
