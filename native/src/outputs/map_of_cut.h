// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface cut along the curve, as lists of numbers.
#pragma once

#include <cstdint>
#include <span>

namespace meander {

/// What is asked of a surface cut along the curve, as CutSurface has it.
struct MapOfCut {
  std::span<const double> positions, distances;  ///< per vertex
  std::span<const uint32_t> faces, strands;      ///< three vertices, and the nearest strand, per face
  std::span<const double> along, face_distances; ///< per corner
  std::span<const uint32_t> line_vertices;
  std::span<const double> arc_lengths;
  std::span<const uint64_t> offsets;
  std::span<const uint32_t> line_strands;
  std::span<const uint8_t> closed;
  std::span<const double> lengths;
  double farthest = 0;  ///< distances end there
};

}  // namespace meander
