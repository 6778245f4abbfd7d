// SPDX-License-Identifier: GPL-3.0-or-later
//
// The radius r wanted at every point of the surface.
#pragma once

#include <vector>

#include "mesh/surface_point.h"

namespace meander {

/// r at a vertex, from its values at the vertices; a single value says that it is the same everywhere, which
/// costs nothing to fetch.
inline double radius_at(const std::vector<double>& vertex_radius, uint32_t v) {
  return vertex_radius.size() == 1 ? vertex_radius[0] : vertex_radius[v];
}
/// r at a point.
inline double radius_at(const std::vector<double>& vertex_radius, const Triangle& corners, const SurfacePoint& p) {
  if (vertex_radius.size() == 1) return vertex_radius[0];
  return p.weight(0) * vertex_radius[corners[0]] + p.b.x * vertex_radius[corners[1]] +
         p.b.y * vertex_radius[corners[2]];
}
inline double radius_at(const Surface& surface, const std::vector<double>& vertex_radius, const SurfacePoint& p) {
  return vertex_radius.size() == 1 ? vertex_radius[0] : radius_at(vertex_radius, surface.face(p.face), p);
}

}  // namespace meander
