// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the benchmark reads from a flow once it has ended.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh.h"

namespace meander::bench {

/// The curve as full polylines: strand s has the points offsets[s] .. offsets[s + 1] - 1.
struct Polylines {
  std::vector<Point> points;
  std::vector<uint64_t> offsets;
  std::vector<uint8_t> closed;
};

/// The nodes of the curve, strand after strand.
struct Nodes {
  std::vector<uint32_t> faces;
  std::vector<Point> barycentrics;
  std::vector<std::array<double, 2>> radii;

  Point position(const Mesh& mesh, size_t i) const {
    const Corners& f = mesh.faces[faces[i]];
    const Point& w = barycentrics[i];
    return w[0] * mesh.vertices[f[0]] + w[1] * mesh.vertices[f[1]] + w[2] * mesh.vertices[f[2]];
  }
};

}  // namespace meander::bench
