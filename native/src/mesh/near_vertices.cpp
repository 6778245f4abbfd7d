// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/point_grid.h"
#include "mesh/repairs.h"

namespace meander {

void merge_vertices(Soup& soup, double distance, PrepareCounts& counts) {
  const auto positions = soup.positions();
  const std::vector<uint8_t> used = soup.used();
  std::vector<uint32_t> vertices;
  std::vector<Soup::Vec3> points;  // of those, seen from the first
  double extent = 0;
  for (uint32_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    vertices.push_back(v);
    points.push_back(positions[v] - positions[vertices[0]]);
    extent = std::max(extent, points.back().cwiseAbs().maxCoeff());
  }
  std::vector<uint32_t> name(positions.size());
  std::iota(name.begin(), name.end(), 0u);
  if (!std::isfinite(extent)) return;  // too large for the check as well
  CancelToken poll = soup.poll();
  const PointGrid grid(points, std::max(2 * distance, 1e-8 * extent), poll);
  // Points may have been rounded; their distances are those of the vertices.
  const double radius = 1.001 * distance + 1e-15 * extent;
  for (uint32_t i = 0; i < vertices.size(); ++i) {
    poll(4);
    const uint32_t v = vertices[i];
    if (name[v] != v) continue;
    grid.near(points[i], radius, [&](uint32_t j, double) {
      const uint32_t w = vertices[j];
      if (w <= v || name[w] != w || !((positions[w] - positions[v]).norm() <= distance)) return;
      name[w] = v;
      ++counts.merged_vertices;
    });
  }
  counts.dropped_faces += soup.rename([&](uint32_t v) { return name[v]; });
}

}  // namespace meander
