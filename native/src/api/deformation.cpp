// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface that moves under the curve.
#include <span>
#include <vector>

#include "api/caller_mesh.h"
#include "api/guard.h"

using namespace meander;

namespace {

/// Where the vertices of the flow's surface are when the caller's are there.
std::vector<double> surface_vertices(const MeshMap* map, size_t count, std::span<const double> caller) {
  if (!map) return {caller.begin(), caller.end()};
  std::vector<double> vertices(3 * count);
  for (uint32_t v = 0; v < count; ++v) {
    const MeshMap::VertexOrigin& origin = map->vertex_origin(v);
    for (size_t k = 0; k < 3; ++k) {
      const double a = caller[3 * size_t{origin.a} + k], b = caller[3 * size_t{origin.b} + k];
      vertices[3 * size_t{v} + k] = origin.t == 0 ? a : (1 - origin.t) * a + origin.t * b;
    }
  }
  return vertices;
}

}  // namespace

meander_status meander_flow_set_vertices(meander_flow* flow, const double* vertices, size_t vertex_count,
                                         meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require(vertices || vertex_count == 0, "The vertices are NULL.");
    Flow& f = *flow->flow;
    const MeshMap* map = flow->map.get();
    const size_t expected = caller_vertex_count(f.surface(), map);
    if (vertex_count != expected) {
      throw Failure(FailureKind::kInvalidMesh,
                    "The mesh has " + std::to_string(vertex_count) + " vertices now and had " +
                        std::to_string(expected) +
                        " when the flow began; only their places may change, so start a new flow.");
    }
    check_cancelled(context);
    f.set_vertices(surface_vertices(map, f.surface().vertex_count(), std::span(vertices, 3 * vertex_count)), map,
                   cancel_of(context));
  });
}
