// SPDX-License-Identifier: GPL-3.0-or-later
//
// The curve as it is drawn: with round turns.
#include "outputs/rounding.h"

#include "api/found.h"
#include "api/guard.h"
#include "outputs/rounded_points.h"

using namespace meander;

namespace {

/// The values of the points that are drawn only, `columns` of each.
template <class Value>
void keep(std::vector<Value>& values, const std::vector<uint8_t>& drawn, size_t columns) {
  size_t to = 0;
  for (size_t p = 0; p < drawn.size(); ++p) {
    if (!drawn[p]) continue;
    for (size_t k = 0; k < columns; ++k) values[to++] = values[columns * p + k];
  }
  values.resize(to);
}

void leave_out(Polylines& lines, const std::vector<uint8_t>& drawn) {
  size_t point = 0;
  uint64_t kept = 0;
  for (uint64_t& offset : lines.offsets) {
    for (; point < offset; ++point) kept += drawn[point];
    offset = kept;
  }
  keep(lines.positions, drawn, 1);
}

void leave_out(PointValues& values, const std::vector<uint8_t>& drawn) {
  keep(values.arc_lengths, drawn, 1);
  keep(values.normals, drawn, 3);
  keep(values.tangents, drawn, 3);
  keep(values.radii, drawn, 2);
  keep(values.faces, drawn, 1);
  keep(values.weights, drawn, 3);
  values.count = values.faces.size();
}

}  // namespace

void meander::require_tolerance(double tolerance) { require_range(tolerance, 0, 0.5, "tolerance (in spacings)"); }

DrawnCurve meander::drawn_curve(const Flow::Present& present, double tolerance, WatchedPart told) {
  const FlowState& state = present.state;
  DrawnCurve made{rounded(state.domain, state.curve, tolerance, present.pool, told), {}};
  made.drawn = drawn_points(state.domain, made.curve.curve, present.pool);
  return made;
}

ReadyLine meander::ready_line(const meander_flow& handle, DrawnCurve line) {
  const Curve& curve = line.curve.curve;
  Polylines lines;
  lines.copy_from(handle.flow->surface(), curve);
  PointValues values = point_values(handle, curve, &line.curve.origin, MEANDER_POINT_PARTS_ALL);
  leave_out(lines, line.drawn);
  leave_out(values, line.drawn);
  return {ready_polylines(std::move(lines)), ready_point_data(std::move(values))};
}

meander_status meander_flow_round_curve(meander_flow* flow, double tolerance, meander_polylines* polylines,
                                        meander_point_data* point_data, meander_context* context,
                                        meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require_struct(polylines);
    if (point_data) require_struct(point_data);
    require_tolerance(tolerance);
    check_cancelled(context);
    const CancelToken cancel = cancel_of(context);
    Flow& f = *flow->flow;
    DrawnCurve line =
        f.ask([&](const Flow::Present& present) { return drawn_curve(present, tolerance); }, cancel);
    f.normals().prepare(cancel.every(1u << 12));
    ReadyLine ready = ready_line(*flow, std::move(line));
    check_cancelled(context);
    ready.polylines.hand_out(polylines);
    if (point_data) ready.data.hand_out(point_data);
  });
}
