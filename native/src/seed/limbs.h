// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a surface is thin all round, as a finger, a claw or a bar of a lattice is.
#pragma once

#include <vector>

#include "base/thread_pool.h"
#include "geodesic/surface_patches.h"
#include "mesh/radius_field.h"
#include "mesh/surface.h"

namespace meander {

/// Per face the square of a line that one on the limb it is on is to follow, times the area of the face and by how much
/// the square of the limb's bending, 2 pi over the way round it, is more than that of one which is `most` local radii
/// round. 0 where it is less, and nothing at all where no face is on such a limb.
///
/// A line along a limb bends less through space than one round it, and by this: a field that is as smooth as can be in
/// space is held so. Where a single line has more room than it needs it winds round, to the left all over the surface,
/// just as steeply as brings it beside itself at its distance.
///
/// A straight walk that comes back to where it began, as it left, has gone round a limb: what it misses the place by
/// says how the limb lies. It has faced away meanwhile, and arrives in the direction in which it left: the rims of a
/// thin sheet, creases and corners send none back so. And a limb goes on to both sides by as much as it is round, and
/// by kLeastLimb, where a walk comes back round it too: tips do not, nor horns.
std::vector<Vec2> bending_of_limbs(const Surface& surface, const SurfacePatches& patches, const RadiusField& radius,
                                   double most, ThreadPool& pool);

}  // namespace meander
