// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants of the border: what is refused, and how far a call is; curve/constants.h says how to read a line.
#pragma once

#include <cstddef>
#include <cstdint>

namespace meander {

// ---- What is refused ------------------------------------------------------------------------------------------------

/// More than any struct will ever need: beyond it a size is one that nobody has set.
inline constexpr size_t kLargestStruct = 4096;       // bytes; > 0; free
inline constexpr uint32_t kLargestImage = 32768;     // pixels of a side; >= 1; free
/// Corners of polygons have numbers of 32 bits, and triangles up to three for each of them.
inline constexpr size_t kMostPolygons = 0x40000000;  // polygons, vertices; >= 1; geometry
/// What rounding does to the quotient of two lengths must not refuse the ends of a range themselves.
inline constexpr double kRatioRounding = 1e-9;       // share of it; 0 to 1; free
/// Nor what it does to a density that is found again from the r that it made.
inline constexpr double kDensityRounding = 1e-12;    // share of it; 0 to 1; free

// ---- What is taken --------------------------------------------------------------------------------------------------

/// Segments, where none are asked for.
inline constexpr double kUsualSegment = 0.2;         // r; 0.01 to 1; free
/// As seen from the surface, a point that is farther away than this is as good as there: what is nearest to it hardly
/// changes, but a stroke is looked at every half of an edge.
inline constexpr double kFarAway = 16;               // diagonals; > 1; free

// ---- Progress -------------------------------------------------------------------------------------------------------

/// What it takes for each face to make a surface, and to look whether it may have doubled polygons, in microseconds of
/// a processor; balls of 1,000,000 and 2,000,000 faces. That counts so many pieces of work for each face. Most surfaces
/// are done then: such a share of what else may have to be done is counted on.
inline constexpr double kMakingSurface = 0.42;       // us; > 0; above
inline constexpr double kSeekingDoubles = 0.28;      // us; > 0; above
inline constexpr size_t kPiecesOfSeeking = 22;       // a face; >= 1; above
inline constexpr double kMendedSurfaces = 0.03;      // share of surfaces; 0 to 1; free

}  // namespace meander
