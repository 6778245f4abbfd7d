// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far places of a cut surface are from the curve, in space: what images of it show.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/eigen.h"

#include "base/thread_pool.h"

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

/// Places of faces with their weights of corners; distances[i] becomes that of place i, and `away`, three values a
/// place or none, the way to it from the nearest place on the curve, of any length. Of the face -1: 0.
///
/// Between corners a distance is no straight line, above all round the tips of turns: it is that from the place on the
/// curve between their nearest places, and in proportion to their own distances where the surface bends on the way. It
/// is never more than what lies straight between corners, be it of their distances from this strand's turn or from any.
void measure_distances(const MapOfCut& cut, std::span<const int32_t> faces, std::span<const float> weights,
                       std::span<double> distances, std::span<double> away, ThreadPool& pool);

}  // namespace meander
