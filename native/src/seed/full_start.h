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
/// field lie four radii apart, short links join them to a tree, and the curve walks round it on both sides. A strand
/// that was drawn to grow is a trunk: it keeps its ends, its fixed nodes and its sides, and trees leave it on either
/// one. Guides and the boundary are walls; what has no room for a tree stays as it is.
///
/// `first`              see first_curve; no two of its segments touch, nor do any of the result's
/// `drawn`              how many of its first strands were drawn by the caller; the others are loops
/// `field`              where a component of the surface has none anywhere, a smooth one is taken
/// `patches`            of this surface, about as large as r; null: they are found
/// `boundary_distance`  of the last strand from the boundary, in local spacings
///
/// Throws Failure(FailureKind::kCancelled) where the watch of the pool says so.
Curve full_start(const Surface& surface, const Curve& first, size_t drawn, const RadiusField& radius,
                 const LineField& field, const SurfacePatches* patches, double boundary_distance, ThreadPool& pool);

}  // namespace meander
