// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ball along the surface by rays, which come across what no straight line is known to lead to.
#pragma once

#include <vector>

#include "medial/sought_ball.h"

namespace meander {

/// What the rays of the nodes of a run, on one side, have come across: others near them believe it.
class Sightings {
 public:
  /// In this order the nodes of a run are to look: the first three lead rays, and have one of them beside every other.
  static constexpr std::array<uint32_t, CurveBvh::kRun> kInTurn{1, 4, 7, 0, 2, 3, 5, 6};

  struct Point {
    uint32_t index;
    Vec2 place;  ///< in the plane of the node's face, from where it is
  };
  struct OfNode {
    bool whole = false;       ///< its rays have been led to their ends
    bool flat_known = false;  ///< what lies in about its plane is not there
    double least = 0;         ///< its ball
    std::vector<Point> points;
  };

  OfNode& of(uint32_t node) { return nodes_[node % CurveBvh::kRun]; }
  /// Forgets all: before another run, or the other side.
  void forget() {
    for (OfNode& each : nodes_) each.whole = false;
  }

 private:
  std::array<OfNode, CurveBvh::kRun> nodes_;
};

/// Looks for what limits the ball along five rays, as far as the ball reaches, first among balls of less than
/// ball.likely: a ball that is known to be small reaches little.
///
/// `radius`  what is known to limit it already
double ball_by_rays(const SoughtBall& ball, const StrandNeighbours& own, double radius, Sightings& sightings);

}  // namespace meander
