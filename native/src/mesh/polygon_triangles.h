// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polygons of a mesh as triangles, also those that are concave, nearly flat, or have holes by bridges.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace meander {

struct PolygonTriangles {
  std::vector<uint32_t> corners;   ///< three per triangle
  std::vector<uint32_t> polygons;  ///< per triangle, the polygon that it is a part of
};

/// Divides polygons into triangles as Blender does, so that a file has the same surface in both: a quadrangle along
/// the diagonal from its first corner, unless that one folds it; any other polygon by cutting off ears of its
/// projection along its own normal (Newell), the next one on the far side of the last, so that slivers are few
/// (Held, "FIST: Fast Industrial-Strength Triangulation of Polygons", 2001; Blender's BLI_polyfill_calc).
///
/// Polygons of many thousand corners would have ears so flat that they count as faces without area. Where one has, the
/// diagonals of its triangles are flipped until they are Delaunay's: nothing of the polygon's shape changes.
///
/// Parts of a polygon that go to a vertex and straight back have no area, and give no triangles. A polygon with a
/// vertex that is not there, or not finite, is fanned from its first corner: others name what is wrong with it.
///
/// vertices   xyz xyz ...
/// corners    of one polygon after another
/// ends       per polygon, where its corners end, never falling; those of fewer than three corners give none
PolygonTriangles triangulate_polygons(std::span<const double> vertices, std::span<const uint32_t> corners,
                                      std::span<const uint64_t> ends);

}  // namespace meander
