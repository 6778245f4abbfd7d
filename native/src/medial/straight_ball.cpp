// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/straight_ball.h"

#include "medial/constants.h"

namespace meander {
namespace {

/// Whether what limits the straight ball limits one of about that size in the plane of the node's face as well. Beside
/// an edge the two directions differ a little, which makes another ball of a point that lies almost to the side.
bool agrees_in_plane(const SoughtBall& ball) {
  const Vec3 d = ball.scene.obstacles.positions()[ball.straight.touched] - ball.position();
  const double ahead = d.dot(ball.scene.surface.to_space(ball.face(), ball.ahead));
  return std::abs(d.squaredNorm() - 2 * ahead * ball.straight.radius) <= kBelievedWithin * d.squaredNorm();
}

}  // namespace

std::optional<double> straight_ball(const SoughtBall& ball) {
  const double radius = ball.straight.radius;
  if (!ball.meets_straight()) return {};
  // On a limb about r thick straight balls are off by up to an eighth, however alike the normals are.
  if (!(ball.scene.patches.to_bend(ball.patch) > kFlatAroundBall * radius)) return {};
  if (!(ball.along >= kBelievedAhead && agrees_in_plane(ball)) && ball.holds_crease(radius)) return {};
  if (!ball.alike(ball.straight.touched)) return {};
  return radius;
}

}  // namespace meander
