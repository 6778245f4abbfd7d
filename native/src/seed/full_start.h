// SPDX-License-Identifier: GPL-3.0-or-later
//
// A first curve that fills the surface already: it walks round a tree of evenly spaced streamlines.
#pragma once

#include "curve/curve.h"
#include "geodesic/surface_patches.h"
#include "mesh/line_field.h"
#include "mesh/radius_field.h"

namespace meander {

/// Replaces the loops of a first curve, one in each region of the surface, by curves that fill them: streamlines of a
/// field lie four radii apart, short links join them to a tree, and the curve walks round it on both sides. Guides and
/// the boundary are walls; a loop where no tree fits stays as it is.
///
/// `loops`              see first_curve; no two of its segments touch, nor do any of the result's
/// `drawn`              so many of its first strands were drawn by the caller; they stay, as walls
/// `field`              where a component of the surface has none anywhere, the smoothest one is taken
/// `patches`            of this surface, about as large as r; null: they are found
/// `boundary_distance`  of the last strand from the boundary, in local spacings
///
/// Throws Failure(FailureKind::kCancelled) where the watch of the pool says so.
Curve full_start(const Surface& surface, const Curve& loops, size_t drawn, const RadiusField& radius,
                 const LineField& field, const SurfacePatches* patches, double boundary_distance, ThreadPool& pool);

}  // namespace meander
