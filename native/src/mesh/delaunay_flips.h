// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles of a polygon in the plane, improved by flips of their diagonals.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/plane.h"

namespace meander {

/// Flips diagonals of triangles until they are Delaunay's, constrained by the edges that have one triangle (Lawson,
/// "Software for C1 surface interpolation", 1977). Triangles stay as many as they are, and what they cover stays.
///
/// Of points on a circle every triangulation is Delaunay's, those with thousands of slivers too, and of points nearly
/// on one rounding would choose. So the plane is stretched meanwhile, twice, along the axis in which the points are
/// farther apart: on an ellipse there is one, in strips across it.
///
/// Where points are nearly on a circle, ears are Delaunay's because of the rounding of a file. So triangles that are
/// still as flat as `flat` lose an edge to a neighbour as long as that makes the flatter of the two less flat.
///
/// points      of the polygon
/// triangles   counter-clockwise, each of three points; at an edge of more than two nothing is flipped
/// flat        a height over the longest side, in the unit of the points
void flip_to_delaunay(std::span<const Vec2> points, double flat, std::vector<std::array<uint32_t, 3>>& triangles);

}  // namespace meander
