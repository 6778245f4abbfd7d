// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh as the caller knows it, where the surface may be a prepared form of it: whatever crosses the
// border speaks of the caller's vertices and faces. `map` is null where the surface is the caller's mesh.
#pragma once

#include <vector>

#include "mesh/mesh_map.h"
#include "mesh/surface.h"

namespace meander {

inline size_t caller_vertex_count(const Surface& surface, const MeshMap* map) {
  return map ? map->caller_vertex_count() : surface.vertex_count();
}

/// One value for each vertex of the surface from one for each of the caller's; none from none.
inline std::vector<double> surface_values(const MeshMap* map, std::vector<double> of_caller_vertices) {
  return map && !of_caller_vertices.empty() ? map->of_vertices(of_caller_vertices) : of_caller_vertices;
}

inline uint32_t caller_vertex(const MeshMap* map, uint32_t vertex) { return map ? map->vertex(vertex) : vertex; }

inline uint32_t caller_face(const MeshMap* map, uint32_t face) { return map ? map->face(face) : face; }

}  // namespace meander
