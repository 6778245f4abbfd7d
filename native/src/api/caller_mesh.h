// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh as the caller knows it, where the surface may be a prepared form of it: whatever the
// header says speaks of the caller's vertices and faces. `map` is null where the surface is the caller's mesh.
#pragma once

#include <span>
#include <vector>

#include "mesh/mesh_map.h"
#include "mesh/surface.h"

namespace meander {

inline size_t caller_vertex_count(const Surface& surface, const MeshMap* map) {
  return map ? map->caller_vertex_count() : surface.vertex_count();
}

/// The values of the surface's vertices from those of the caller's; none from none.
inline VertexData<double> surface_values(const MeshMap* map, std::span<const double> of_caller_vertices) {
  if (map && !of_caller_vertices.empty()) return map->of_vertices(of_caller_vertices);
  return VertexData<double>(std::vector<double>(of_caller_vertices.begin(), of_caller_vertices.end()));
}

inline uint32_t caller_vertex(const MeshMap* map, uint32_t vertex) { return map ? map->vertex(vertex) : vertex; }

inline uint32_t caller_face(const MeshMap* map, uint32_t face) { return map ? map->face(face) : face; }

}  // namespace meander
