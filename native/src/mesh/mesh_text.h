// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polygons, lines and numbers in files of text: what is slow to read a line at a time elsewhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace meander {

/// What is read of a text.
enum class TextKind {
  kObjFaces,  ///< the v and f lines of a Wavefront OBJ file
  kObjLines,  ///< its v and l lines
  kStl        ///< the triangles of an STL file
};

/// The caller's arrays, which receive what fits; the counts say how much there is.
struct TextPolygons {
  std::span<double> positions;   ///< xyz xyz ...
  std::span<uint32_t> corners;   ///< of one polygon after another
  std::span<uint64_t> ends;      ///< per polygon, where its corners end
  std::span<uint32_t> lines;     ///< per polygon, the line of the text, from 1
  size_t position_count = 0;     ///< in points
  size_t corner_count = 0, polygon_count = 0;
  size_t left_out = 0;           ///< polygons of fewer than three corners
};

/// Reads a text in one pass. Lines end with \n, \r or both.
///
/// OBJ: a backslash at the end of a v, f or l line continues it, `#` ends it; of a reference such as 7/1/3 the vertex
/// is taken, negative ones count back from the line. Everything that is not asked for is passed over, whatever it
/// holds.
/// STL: `vertex` and its three numbers; a loop may have more than three of them. Names behind `solid` and `endsolid`
/// are passed over.
///
/// Numbers that are NaN or infinite are read. Throws Failure(FailureKind::kInvalidMesh) with the line and what is wrong
/// in it.
void read_text(std::string_view text, TextKind kind, TextPolygons& polygons);

/// Reads numbers between blanks until there is something else or no more room. Returns how many; `end` receives where
/// it stopped.
size_t read_numbers(std::string_view text, std::span<double> numbers, size_t& end);

}  // namespace meander
