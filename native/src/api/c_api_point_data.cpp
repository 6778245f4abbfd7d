// SPDX-License-Identifier: GPL-3.0-or-later
//
// The border: data of every point of the curve.
#include "api/handles.h"
#include "curve/polylines.h"
#include "flow/point_data.h"

using namespace meander;

meander_status meander_flow_get_point_data(meander_flow* flow, double* arc_lengths, double* normals, double* tangents,
                                           double* radii, uint32_t* faces, double* barycentrics, size_t capacity,
                                           size_t* count, meander_error* error) {
  return guard(error, [&] {
    require(flow != nullptr && count != nullptr, "The flow or the pointer for the count is NULL.");
    require_idle(*flow);
    Flow& f = *flow->flow;
    *count = polyline_point_count(f.curve());
    if (*count > capacity) return MEANDER_OK;
    if (radii) f.update_radii();
    write_point_data(f, flow->map.get(), {arc_lengths, normals, tangents, radii, faces, barycentrics});
    return MEANDER_OK;
  });
}
