// SPDX-License-Identifier: GPL-3.0-or-later
//
// The curve as it leaves the library: full geodesic polylines in the caller's units.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "curve/curve.h"
#include "mesh/mesh_map.h"

namespace meander {

/// A point of a face, given by the weights of the face's corners, between the caller's own vertices.
Vec3 caller_point(const Surface& surface, uint32_t face, const std::array<double, 3>& weights);

/// Weights of a point for the corners of the caller's face, in his order; `map` may be null.
inline std::array<double, 3> caller_weights(const Surface& surface, const MeshMap* map, uint32_t face,
                                            std::array<double, 3> w) {
  if (surface.flipped(face)) std::swap(w[1], w[2]);
  return map ? map->weights(face, w) : w;
}

/// Weights of the corners of a crossing's face.
std::array<double, 3> crossing_weights(const Crossing& c);

/// The number of points of the polylines: nodes, and crossings of edges between them.
size_t polyline_point_count(const Curve& curve);

/// A copy of the polylines, strands in the order of the seed's. Its memory is used again by the next copy.
struct Polylines {
  std::vector<Vec3> positions;    ///< in the caller's units
  std::vector<uint64_t> offsets;  ///< one more than there are strands
  std::vector<uint8_t> closed, guides;

  void copy_from(const Surface& surface, const Curve& curve);
  size_t point_count() const { return positions.size(); }
};

}  // namespace meander
