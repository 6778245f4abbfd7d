// SPDX-License-Identifier: GPL-3.0-or-later
//
// The caller's strands, laid on the surface.
#pragma once

#include <vector>

#include "base/thread_pool.h"
#include "curve/curve.h"
#include "mesh/radius_field.h"

namespace meander {

/// Strands in the caller's space; see meander_seed.
struct SeedStrands {
  std::vector<Vec3> points;
  std::vector<uint32_t> offsets;
  std::vector<uint8_t> closed, fixed;
  std::vector<uint8_t> guides;  ///< per strand; empty: none
  bool loops = false;           ///< components without a growing strand get a loop
};

/// Projects the points and joins them by geodesics. Throws Failure(FailureKind::kInvalidSeed) naming the
/// point. `radius`: how far from the surface a point may be.
Curve lay_seed(const Surface& surface, const SeedStrands& seed, const RadiusField& radius, ThreadPool& pool);

}  // namespace meander
