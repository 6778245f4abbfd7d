// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs in the background, and previews of them.
#include <algorithm>
#include <cmath>

#include "api/structs.h"

using namespace meander;

meander_status meander_flow_start(meander_flow* flow, meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    flow->job.start(*flow->flow, context ? context->control : nullptr);
  });
}

uint32_t meander_flow_is_running(const meander_flow* flow) { return flow && flow->job.running() ? 1 : 0; }

meander_status meander_flow_wait(meander_flow* flow, meander_error* error) {
  return guard(error, [&] {
    require_started(flow);
    require_finished(flow->job.wait());
  });
}

meander_status meander_flow_keep_growth(meander_flow* flow, double length_step, size_t point_limit,
                                        meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require(std::isfinite(length_step) && length_step >= 0,
            "The length step of copies is negative or not finite; give 0 for none.");
    flow->job.keep_growth(length_step, point_limit);
  });
}

meander_status meander_flow_get_preview(meander_flow* flow, meander_preview* preview, double* positions,
                                        double* normals, size_t point_capacity, size_t* point_count,
                                        uint64_t* offsets, uint8_t* closed, size_t strand_capacity,
                                        size_t* strand_count, meander_error* error) {
  return guard(error, [&] {
    require_started(flow);
    require(point_count != nullptr && strand_count != nullptr, "A pointer for a count is NULL.");
    require_struct(preview);
    flow->job.with_preview([&](const Preview& p, size_t kept) {
      const size_t points = p.polylines.point_count(), strands = p.polylines.closed.size();
      const bool fits = points <= point_capacity && strands <= strand_capacity;
      if (fits) require(positions && offsets && closed, "An array for the polylines is NULL.");
      write_struct(preview, {0, p.serial, p.iterations, p.nodes, p.length, p.seconds, kept, {}});
      *point_count = points;
      *strand_count = strands;
      if (!fits) return false;
      std::ranges::copy(p.polylines.positions, positions);
      if (normals) std::ranges::copy(p.polylines.normals, normals);
      std::ranges::copy(p.polylines.offsets, offsets);
      std::ranges::copy(p.polylines.closed, closed);
      return true;
    });
  });
}
