// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polygons, lines and numbers in files of text: what is slow to read a line at a time elsewhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace meander {

/// What is read of a text.
enum class TextKind {
  kObjFaces,  ///< the v and f lines of a Wavefront OBJ file
  kObjLines,  ///< its v and l lines
  kStl        ///< the triangles of an STL file
};

struct TextPolygons {
  std::vector<double> positions;  ///< xyz xyz ...
  std::vector<uint32_t> corners;  ///< of one polygon after another
  std::vector<uint64_t> ends;     ///< per polygon, where its corners end
  std::vector<uint32_t> lines;    ///< per polygon, the line of the text, from 1
  size_t left_out = 0;            ///< polygons of fewer than three corners

  size_t point_count() const { return positions.size() / 3; }
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
TextPolygons read_text(std::string_view text, TextKind kind);

/// Reads numbers between blanks until there is something else or no more room. Returns how many; `end` receives where
/// it stopped.
size_t read_numbers(std::string_view text, std::span<double> numbers, size_t& end);

}  // namespace meander
