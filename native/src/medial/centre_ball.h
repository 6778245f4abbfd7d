// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the centre of a ball along the surface sees in it.
#pragma once

#include <vector>

#include "medial/sought_ball.h"

namespace meander {

/// Makes a ball of `radius` smaller until its centre sees nothing in it. Beside a corner, as that of a cube, what the
/// node sees along one straight path is nearer to the centre along another, on the other side of the corner.
///
/// `near`  scratch
double ball_from_centre(const SoughtBall& ball, double radius, std::vector<uint32_t>& near);

}  // namespace meander
