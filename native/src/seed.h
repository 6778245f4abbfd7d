// SPDX-License-Identifier: GPL-3.0-or-later
//
// The curve that a flow starts from: the caller's strands laid on the surface, or small loops.
#pragma once

#include <vector>

#include "curve.h"
#include "parallel.h"

namespace meander {

/// Strands in the caller's space; see meander_seed.
struct SeedStrands {
  std::vector<Vec3> points;
  std::vector<uint32_t> offsets;
  std::vector<uint8_t> closed, fixed;
};

/// Projects the points and joins them by geodesics. Throws Failure(MEANDER_INVALID_SEED) naming the
/// point. `radius` (per vertex, inside units): how far from the surface a point may be.
Curve lay_seed(const Surface& surface, const SeedStrands& seed, const std::vector<double>& radius, Team& team);

/// One closed strand for each component: the outline of its first face, or, where `widen` is set and
/// that is smaller, a geodesic circle of 1.5 r around the middle of that face. Bending and a clamped
/// medial radius would make a loop much smaller than r collapse instead of grow.
Curve face_loops(const Surface& surface, const std::vector<double>& radius, bool widen, Team& team);

}  // namespace meander
