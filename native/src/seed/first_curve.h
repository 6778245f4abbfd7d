// SPDX-License-Identifier: GPL-3.0-or-later
//
// The curve that a flow starts from: the caller's strands, and small loops where there are none.
#pragma once

#include "base/point_tree.h"
#include "base/thread_pool.h"
#include "curve/curve.h"
#include "mesh/radius_field.h"
#include "seed/seed.h"

namespace meander {

/// Lays the seed, and one closed strand in every region that is to have one: all of them without a
/// seed (`seed` null), those without a growing strand where the seed asks for loops. Guides divide a
/// component into regions; see find_regions.
///
/// A loop is the outline of the first face of a component or, where `widen` is set and that is
/// smaller, a geodesic circle of 1.5 r around the middle of that face, or of the nearest one where it
/// meets no boundary: bending and a clamped medial radius would make a loop much smaller than r collapse
/// instead of grow. Beside guides it is a circle about as far from them as it is wide.
///
/// `boundary`, `strip_width`: see find_regions. A `variation` other than 0 has circles in other places, however large
/// their faces are.
///
/// Throws Failure(FailureKind::kInvalidSeed); `radius` is r, `fit` as lay_seed has it.
Curve first_curve(const Surface& surface, const SeedStrands* seed, const RadiusField& radius, bool widen,
                  const PointTree& boundary, double strip_width, ThreadPool& pool, SeedFit* fit = nullptr,
                  uint32_t variation = 0);

}  // namespace meander
