// SPDX-License-Identifier: GPL-3.0-or-later
//
// Data of every point of the curve.
#include "flow/point_data.h"

#include "api/guard.h"
#include "curve/polylines.h"

using namespace meander;

namespace {

/// Of the surface, between two asks.
constexpr uint32_t kFaces = 4096;

}  // namespace

meander_status meander_flow_compute_point_data(meander_flow* flow, double* arc_lengths, double* normals,
                                               double* tangents, double* radii, uint32_t* faces, double* barycentrics,
                                               size_t capacity, size_t* count, meander_context* context,
                                               meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require(count != nullptr, "The pointer for the count is NULL.");
    Flow& f = *flow->flow;
    const size_t points = polyline_point_count(f.curve());
    if (points <= capacity) {
      check_cancelled(context);
      const std::function<bool()> asked = question(context);
      const auto watch = f.watch(asked);
      if (radii) f.update_radii();
      if (normals) f.normals().prepare(CancelPoll(asked, kFaces));
      check_cancelled(context);
      write_point_data(f, flow->map.get(), {arc_lengths, normals, tangents, radii, faces, barycentrics});
    }
    *count = points;
  });
}
