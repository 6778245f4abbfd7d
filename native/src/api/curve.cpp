// SPDX-License-Identifier: GPL-3.0-or-later
//
// The curve out: polylines, guides, nodes.
#include "api/caller_mesh.h"
#include "api/guard.h"
#include "curve/polylines.h"

using namespace meander;

meander_status meander_flow_get_polylines(const meander_flow* flow, double* positions, double* normals,
                                          size_t point_capacity, size_t* point_count, uint64_t* offsets,
                                          uint8_t* closed, size_t strand_capacity, size_t* strand_count,
                                          meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require(point_count != nullptr && strand_count != nullptr, "A pointer for a count is NULL.");
    const Flow& f = *flow->flow;
    const size_t points = polyline_point_count(f.curve()), strands = f.curve().strands.size();
    const bool fits = points <= point_capacity && strands <= strand_capacity;
    if (fits) require(positions && offsets && closed, "An array for the polylines is NULL.");
    if (fits && normals) f.normals().prepare();
    *point_count = points;
    *strand_count = strands;
    if (fits) write_polylines(f.surface(), f.curve(), f.normals(), positions, normals, offsets, closed);
  });
}

meander_status meander_flow_get_guides(const meander_flow* flow, uint8_t* guides, size_t capacity, size_t* count,
                                       meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require(count != nullptr, "The pointer for the count is NULL.");
    const std::vector<Strand>& strands = flow->flow->curve().strands;
    const bool fits = strands.size() <= capacity;
    if (fits) require(guides != nullptr, "The array for the guides is NULL.");
    *count = strands.size();
    for (size_t s = 0; fits && s < strands.size(); ++s) guides[s] = strands[s].guide;
  });
}

meander_status meander_flow_get_nodes(const meander_flow* flow, uint32_t* faces, double* barycentrics, double* radii,
                                      uint8_t* fixed, size_t capacity, size_t* count, meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require(count != nullptr, "The pointer for the count is NULL.");
    const Flow& f = *flow->flow;
    const Curve& curve = f.curve();
    const bool fits = curve.size() <= capacity;
    if (fits) require(faces && barycentrics, "An array for the nodes is NULL.");
    *count = curve.size();
    if (!fits) return;
    const double scale = f.surface().scale();
    for (uint32_t i = 0; i < curve.size(); ++i) {
      const SurfacePoint& node = curve.nodes[i];
      const auto w = caller_weights(f.surface(), flow->map.get(), node.face, {node.weight(0), node.b.x, node.b.y});
      faces[i] = caller_face(flow->map.get(), node.face);
      std::copy(w.begin(), w.end(), barycentrics + 3 * size_t{i});
      if (radii) {
        const Radii r = f.radii_of(i);
        radii[2 * size_t{i}] = r[0] * scale;
        radii[2 * size_t{i} + 1] = r[1] * scale;
      }
      if (fixed) fixed[i] = curve.fixed[i];
    }
  });
}
