// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which of several ways finds the ball along the surface beside a crease.
#pragma once

#include <vector>

#include "geodesic/windows.h"
#include "medial/ray_ball.h"

namespace meander {

/// What finders need from one ball to the next. For one thread.
struct BallScratch {
  explicit BallScratch(const GeodesicScene& scene) : windows(scene.surface, scene.points) {}

  WindowSearch windows;
  Sightings sightings;
  std::vector<uint32_t> near;
};

struct ChosenBall {
  double radius;
  bool searched = false;  ///< what limits the ball is nothing that limits the straight one
};

/// The radius of the largest empty ball; docs/medial_axis.md has a table of the ways.
ChosenBall choose_ball(const SoughtBall& ball, BallScratch& scratch);

}  // namespace meander
