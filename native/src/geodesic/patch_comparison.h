// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuts a surface into patches, and compares these with one another.
#pragma once

#include "base/tell.h"
#include "base/thread_pool.h"
#include "geodesic/surface_patches.h"

namespace meander {

/// The patches of a surface, each compared with those that are near it.
///
/// `radius`  r, which may vary: patches are then smaller where it is
/// `clamp`   the radius of the largest balls that will be asked for, in the local r
SurfacePatches compared_patches(const Surface& surface, const RadiusField& radius, double clamp, ThreadPool& pool,
                                const Tell& tell = {});

/// What that takes, about.
struct PatchTimes {
  double cutting = 0, comparing = 0;  ///< microseconds of a processor
};
PatchTimes times_of_patches(const Surface& surface, const RadiusField& radius);

}  // namespace meander
