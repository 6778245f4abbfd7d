// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs in the background, and previews of them.
#include <cmath>

#include "api/guard.h"
#include "api/results.h"

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
    flow->job.previews().keep_growth(length_step, point_limit);
  });
}

meander_status meander_flow_take_preview(meander_flow* flow, meander_preview* preview, meander_error* error) {
  return guard(error, [&] {
    require_started(flow);
    require_struct(preview);
    auto owner = std::make_unique<OwnedResult<Preview>>();  // before the copy is taken out, since memory may run out
    const std::optional<size_t> kept = flow->job.previews().take(owner->found);
    if (!kept) {
      write_struct(preview, {});
      return;
    }
    hand_out(preview, std::move(owner), [kept](const Preview& copy, meander_preview& p) {
      p.serial = copy.serial;
      p.iterations = copy.iterations;
      p.nodes = copy.nodes;
      p.length = copy.length;
      p.seconds = copy.seconds;
      p.kept = *kept;
      p.point_count = copy.polylines.point_count();
      p.strand_count = copy.polylines.closed.size();
      point_to(p.positions, copy.polylines.positions);
      point_to(p.offsets, copy.polylines.offsets);
      point_to(p.closed, copy.polylines.closed);
    });
  });
}
