// SPDX-License-Identifier: GPL-3.0-or-later
//
// Outlines: lines that run along the boundary at a given distance from it.
#pragma once

#include <cstdint>
#include <vector>

#include "base/cancel_token.h"
#include "mesh/surface.h"

namespace meander {

struct Outlines {
  std::vector<Vec3> points;  ///< in the caller's space, strand after strand
  std::vector<uint32_t> offsets{0};
  std::vector<uint8_t> closed;
  uint32_t skipped = 0;  ///< stretches left out because there is no room for them
};

/// The lines on which the geodesic distance to the boundary is `distance`, with points about half a
/// `radius` apart. Stretches that come nearer than a radius to another stretch are left out, since
/// nothing fits between the two; so are strands shorter than six radii. Lengths are in the surface's
/// own unit.
///
/// The distance is that of geodesic/boundary_distance.h, on faces that are cut up near the boundary until their edges
/// are a quarter of the distance; the lines, being level sets, never cross. Time and memory grow with the
/// length of the boundary over `distance`.
///
/// `cancel` is asked at least every few milliseconds; throws Failure(FailureKind::kCancelled) where it stops this.
Outlines find_outlines(const Surface& surface, double distance, double radius, const CancelToken& cancel);

}  // namespace meander
