// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/shared_places.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/point_grid.h"

namespace meander {

std::vector<uint32_t> shared_places(std::span<const Eigen::Vector3d> positions, std::span<const uint8_t> used,
                                    double distance, CancelToken poll) {
  std::vector<uint32_t> place(positions.size()), vertices;
  std::iota(place.begin(), place.end(), 0u);
  std::vector<Eigen::Vector3d> points;  // seen from the first
  double extent = 0;
  for (uint32_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    vertices.push_back(v);
    points.push_back(positions[v] - positions[vertices[0]]);
    extent = std::max(extent, points.back().cwiseAbs().maxCoeff());
  }
  if (!(extent > 0) || !std::isfinite(extent)) return place;
  // Cubes of many times the distance, so that most queries look into one.
  const PointGrid grid(points, std::max(16 * distance, 1e-8 * extent), poll);
  for (uint32_t i = 0; i < vertices.size(); ++i) {
    poll(2);
    const uint32_t v = vertices[i];
    if (place[v] != v) continue;
    grid.near(points[i], distance, [&](uint32_t j, double) {
      const uint32_t w = vertices[j];
      if (w > v && place[w] == w) place[w] = v;
    });
  }
  return place;
}

}  // namespace meander
