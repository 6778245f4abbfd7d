// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lines of a phase, as points that are evenly spaced along them.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/surface_point.h"
#include "seed/stripe_phase.h"

namespace meander {

/// One list of points for every line, those first where the radius is largest in the mean, since links begin at the
/// first of two lines, and are as long as that is wide. A line begins and ends at the boundary,
/// in singular faces and where the field has no direction; a closed one begins anywhere.
///
/// `step`       between two points, in local radii
/// `variation`  where closed ones begin
/// `in_line`    on which components all closed ones begin beside the first: turns of rows round a pipe are all there
///              then; on two sides of the pipe they push the rows between them askew
std::vector<std::vector<SurfacePoint>> level_lines(const Surface& surface, const StripePhase& phase,
                                                   const RadiusField& radius, double step, uint32_t variation,
                                                   const std::vector<uint8_t>& in_line, CancelToken poll);

}  // namespace meander
