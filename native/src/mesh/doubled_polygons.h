// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polygons that are there twice: two-sided faces, copies that were never moved, a Solidify without a thickness. They
// are found before any repair, by their outlines and by where these lie: how a polygon was divided into triangles, and
// which numbers its vertices have, says nothing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/tell.h"
#include "mesh/soup.h"
#include "mesh/surface.h"

namespace meander {

/// Triangles to be left out, and the vertices whose places are taken by those of what stays.
struct DoubledPolygons {
  std::vector<uint32_t> faces;  ///< rising
  /// A vertex of a polygon that goes, and that of the one that stays in the same place.
  std::vector<std::pair<uint32_t, uint32_t>> vertices;
};

/// Of polygons with the same outline all but the one with the lowest face, unless that would tear a surface.
///
/// A polygon is the faces that the caller says are one; so are faces in one plane that continue each other at edges
/// where nothing else meets, and two on the corners of a quad, bent or not, that is there once more with the other
/// diagonal. Two have the same outline where its edges lie between the same places, in either
/// direction; vertices share a place within kOnePlace of the size of the soup, so that the two sides of whatever has a
/// thickness never do. Polygons of faces that nobody has called one must also be such quads, or lie in one plane.
///
/// Polygons side by side go or stay together. They stay where one of them lies between two surfaces that it closes, as
/// two boxes with vertices of their own that touch along a wall have it twice, and none has a free edge. Copies that
/// are wound alike are left out nevertheless.
///
/// polygons   the polygon of each of the caller's faces, any numbers; empty: none is known
DoubledPolygons find_doubled_polygons(Soup& soup, std::span<const uint32_t> polygons, const Tell& tell = {});

/// Whether a surface may have some; false in little time for nearly all that have none.
bool may_have_doubled_polygons(const Surface& surface, std::span<const uint32_t> polygons, const CancelToken& cancel);

}  // namespace meander
