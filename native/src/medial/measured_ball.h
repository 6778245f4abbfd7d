// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ball along the surface by straight lines that are led to what limits the straight ball.
#pragma once

#include "medial/sought_ball.h"

namespace meander {

/// A ball that lines have found.
struct MeasuredRadius {
  double radius;  ///< no ball is larger
  bool whole;     ///< nothing else limits it: else a line has not led where it should
};

/// Measures what limits the straight ball, then what limits it next, of at most kMostStrandsOfBall strands.
MeasuredRadius measured_ball(const SoughtBall& ball, const StrandNeighbours& own);

}  // namespace meander
