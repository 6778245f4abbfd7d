// SPDX-License-Identifier: GPL-3.0-or-later
//
// Places that the curve leaves empty.
#include "medial/gaps.h"

#include "api/caller_mesh.h"
#include "api/guard.h"
#include "curve/polylines.h"

using namespace meander;

meander_status meander_flow_find_gaps(meander_flow* flow, double least_size, double* positions, double* radii,
                                      double* sizes, uint32_t* faces, size_t capacity, size_t* count,
                                      meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require(count != nullptr, "The pointer for the count is NULL.");
    if (least_size != 0) require_range(least_size, 1, 1e6, "least_size (in units of the local r)");
    check_cancelled(context);
    Flow& f = *flow->flow;
    const std::function<bool()> asked = question(context);
    const auto watch = f.watch(asked);
    const std::vector<Gap> gaps = f.gaps(least_size != 0 ? least_size : kGapSize);
    check_cancelled(context);
    const bool fits = gaps.size() <= capacity;
    if (fits) require(gaps.empty() || positions, "The array for the positions is NULL.");
    *count = gaps.size();
    for (size_t k = 0; fits && k < gaps.size(); ++k) {
      const SurfacePoint& p = gaps[k].centre;
      const Vec3 x = caller_point(f.surface(), p.face, {p.weight(0), p.b.x, p.b.y});
      std::copy(x.data(), x.data() + 3, positions + 3 * k);
      if (radii) radii[k] = gaps[k].radius * f.surface().scale();
      if (sizes) sizes[k] = gaps[k].size;
      if (faces) faces[k] = caller_face(flow->map.get(), p.face);
    }
  });
}
