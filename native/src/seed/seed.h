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
  double max_distance = 0;      ///< how far from the surface a point may be, in its units inside; never below r
};

/// How well a seed fitted the surface. Lengths are in its units inside.
struct SeedFit {
  double distance = 0;  ///< how far a point was moved, at most
  uint32_t point = 0;   ///< the one that was moved so far
  uint32_t jumps = 0;   ///< paths between neighbouring points much longer than the way between them as given
  double jump_length = 0;  ///< of the longest such path, from one point to another
  uint32_t jump_from = 0, jump_to = 0;
};

/// Projects the points and joins them by geodesics. Throws Failure(FailureKind::kInvalidSeed) naming the
/// point. `radius` is r; `fit` null: nobody asks.
Curve lay_seed(const Surface& surface, const SeedStrands& seed, const RadiusField& radius, ThreadPool& pool,
               SeedFit* fit = nullptr);

}  // namespace meander
