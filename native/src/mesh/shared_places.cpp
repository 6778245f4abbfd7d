// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/shared_places.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/point_grid.h"

namespace meander {

std::vector<uint32_t> shared_places(std::span<const Eigen::Vector3d> positions, std::span<const uint8_t> used,
                                    double distance, double cell, CancelToken poll) {
  std::vector<uint32_t> place(positions.size()), vertices;
  std::iota(place.begin(), place.end(), 0u);
  std::vector<Eigen::Vector3d> points;  // seen from the first
  double extent = 0;
  for (uint32_t v = 0; v < used.size(); ++v) {
    poll();
    if (!used[v]) continue;
    vertices.push_back(v);
    points.push_back(positions[v] - positions[vertices[0]]);
    extent = std::max(extent, points.back().cwiseAbs().maxCoeff());
  }
  const double side = std::max(cell * distance, 1e-8 * extent);
  if (!(side > 0) || !std::isfinite(extent)) return place;
  const PointGrid grid(points, side, poll);
  // Points may have been rounded; their distances are those of the vertices.
  const double radius = 1.001 * distance + 1e-15 * extent;
  for (uint32_t i = 0; i < vertices.size(); ++i) {
    poll(4);
    const uint32_t v = vertices[i];
    if (place[v] != v) continue;
    grid.near(points[i], radius, [&](uint32_t j, double) {
      const uint32_t w = vertices[j];
      if (w > v && place[w] == w && (positions[w] - positions[v]).norm() <= distance) place[w] = v;
    });
  }
  return place;
}

}  // namespace meander
