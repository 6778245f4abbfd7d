// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/ball_choice.h"

#include <optional>

#include "medial/centre_ball.h"
#include "medial/measured_ball.h"
#include "medial/straight_ball.h"

namespace meander {
namespace {

/// The ball by windows, among those of less than ball.likely first; none if it reaches too many faces.
std::optional<ChosenBall> ball_by_windows(const SoughtBall& ball, WindowSearch& windows) {
  const SurfacePoint& from = ball.scene.curve.nodes[ball.node];
  const auto below = [&](double most) { return windows.largest(from, ball.node, ball.ahead, most); };
  std::optional<double> radius = below(std::min(ball.likely, ball.most));
  if (radius && windows.touched() == kNone && ball.likely < ball.most) radius = below(ball.most);
  if (!radius) return {};
  return ChosenBall{*radius, windows.touched() != ball.straight.touched};
}

/// By lines to what limits the straight ball, where it is no other side that does; else by rays.
ChosenBall ball_by_lines(const SoughtBall& ball, Sightings& sightings) {
  const GeodesicScene& scene = ball.scene;
  const StrandNeighbours own(ball);
  double known = own.radius;
  if (ball.meets_straight() && !scene.patches.opposite(ball.patch, scene.obstacles.patch(ball.straight.touched))) {
    const MeasuredRadius measured = measured_ball(ball, own);
    if (measured.whole) return {measured.radius, false};
    known = measured.radius;
  }
  return {ball_by_rays(ball, own, known, sightings), true};
}

}  // namespace

ChosenBall choose_ball(const SoughtBall& ball, BallScratch& scratch) {
  const SurfacePatches& patches = ball.scene.patches;
  if (const std::optional<double> radius = straight_ball(ball)) return {*radius};
  std::optional<ChosenBall> found;
  if (patches.coarse(ball.patch)) found = ball_by_windows(ball, scratch.windows);
  if (!found) found = ball_by_lines(ball, scratch.sightings);
  if (patches.sharp(ball.patch)) found->radius = ball_from_centre(ball, found->radius, scratch.near);
  return *found;
}

}  // namespace meander
