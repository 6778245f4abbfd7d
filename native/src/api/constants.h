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

/// Which share of the time of a strict check has passed when there is a surface; and of all, when the check has, which
/// most meshes pass, and when one that does not is mended.
inline constexpr double kSurfaceMade = 0.6;          // share of the check; 0 to 1; free
inline constexpr double kStrictlyChecked = 0.9;      // share of the time; 0 to 1; free
inline constexpr double kMended = 0.95;              // share of the time; kStrictlyChecked to 1; free

}  // namespace meander
