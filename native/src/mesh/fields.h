// SPDX-License-Identifier: GPL-3.0-or-later
//
// Functions and direction fields of a surface at its vertices: curvature, principal directions, the
// smoothest field of lines, and the field that continues strokes.
#pragma once

#include <span>

#include "base/cancel_token.h"
#include "mesh/surface.h"
#include "mesh/vertex_data.h"

namespace meander {

enum class CurvatureKind { kGaussian, kMean, kAbsoluteGaussian, kAbsoluteMean, kCurvedness };

/// Lengths are in the surface's own unit. `radius`: the distance that is averaged over, 0 for none. `cancel` is
/// asked about every millisecond while anything here is computed, which then ends with
/// Failure(FailureKind::kCancelled), but not while Eigen finds the order of the unknowns of a system (see
/// SparseFactors), nor while a tree of the surface's points is built, which strokes call for.
///
/// Gaussian: angle defect over area. Mean: dihedral angles, Cohen-Steiner and Morvan 2003.
VertexData<double> curvature(const Surface& surface, CurvatureKind kind, double radius,
                             const CancelToken& cancel = {});

/// Unit tangent vectors, or zero, along which the surface bends least, or most, in absolute value.
VertexData<Vec3> principal_directions(const Surface& surface, bool most, double radius,
                                      const CancelToken& cancel = {});

/// The smoothest field of lines of each component: the least eigenvector of its connection Laplacian
/// (Knoppel, Crane, Pinkall, Schroder, "Globally Optimal Direction Fields", 2013).
VertexData<Vec3> smoothest_directions(const Surface& surface, const CancelToken& cancel = {});

/// A polyline in space close to the surface, whose direction the field is to take there.
using Stroke = std::span<const Vec3>;

/// The smoothest field of lines that is parallel to the strokes where they run; zero on components
/// without a stroke.
VertexData<Vec3> extended_directions(const Surface& surface, std::span<const Stroke> strokes,
                                     const CancelToken& cancel = {});

/// The same for the edges of the boundary: lines parallel to it. Zero on components without one.
VertexData<Vec3> boundary_directions(const Surface& surface, const CancelToken& cancel = {});

/// Lines in space, laid into the surface and turned by an angle (radians) at every vertex, counterclockwise as seen
/// from the side that its faces show: unit tangent vectors, or zero where a line is not longer than zero there.
VertexData<Vec3> turned_directions(const Surface& surface, const VertexData<Vec3>& lines,
                                   const VertexData<double>& angles, const CancelToken& cancel = {});

}  // namespace meander
