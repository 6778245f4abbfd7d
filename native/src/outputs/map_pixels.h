// SPDX-License-Identifier: GPL-3.0-or-later
//
// A square image of triangles in the plane: which of them each pixel lies in, and where.
#pragma once

#include <cstdint>
#include <span>

#include "base/thread_pool.h"

namespace meander {

/// An image of size x size pixels, row by row; the caller's arrays.
struct MapPixels {
  uint32_t size = 0;
  std::span<int32_t> faces;   ///< per pixel, -1 where there is none
  std::span<float> weights;   ///< three per pixel: of the corners of its face
};

/// How many pixels lie in faces, without the margin, and how many of them well inside of several.
struct PixelCounts {
  size_t covered = 0, twice = 0;
};

/// Gives each pixel the last face that its centre lies in.
///
/// corners   of the faces, two coordinates each, in pixels, whose centres are whole numbers; rows count downwards.
///           Faces without area, and those of a coordinate that is not finite, are on no pixel
/// margin    so many pixels around what lies in faces get the face and the weights of the nearest ones
PixelCounts find_pixels(std::span<const double> corners, uint32_t margin, const MapPixels& pixels, ThreadPool& pool);

}  // namespace meander
