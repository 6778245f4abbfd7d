// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether the straight ball of a node beside a crease is its ball along the surface.
#pragma once

#include <optional>

#include "medial/sought_ball.h"

namespace meander {

/// The radius of the straight ball, where it can be believed: what limits it lies along the surface, no limb about r
/// thick is near, and either the ball grows in the direction of the surface or it does not reach the crease.
std::optional<double> straight_ball(const SoughtBall& ball);

}  // namespace meander
