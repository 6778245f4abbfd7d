// SPDX-License-Identifier: GPL-3.0-or-later
//
// The curve as it is drawn: with round turns.
#include "outputs/rounding.h"

#include "api/guard.h"
#include "api/results.h"
#include "outputs/point_data.h"
#include "outputs/polylines.h"
#include "outputs/rounded_points.h"

using namespace meander;

namespace {

struct DrawnLine {
  Polylines lines;
  std::vector<double> arc_lengths, normals, tangents, radii, weights;
  std::vector<uint32_t> faces;
};

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

DrawnLine all_points(const Flow& flow, const MeshMap* map, const RoundedCurve& rounded) {
  DrawnLine made;
  made.lines.copy_from(flow.surface(), rounded.curve);
  const size_t count = made.lines.point_count();
  PointArrays arrays;
  const auto room = [&](auto& values, size_t columns) {
    values.resize(columns * count);
    return values.data();
  };
  arrays.arc_lengths = room(made.arc_lengths, 1);
  arrays.normals = room(made.normals, 3);
  arrays.tangents = room(made.tangents, 3);
  arrays.radii = room(made.radii, 2);
  arrays.faces = room(made.faces, 1);
  arrays.barycentrics = room(made.weights, 3);
  write_point_data(flow, rounded.curve, &rounded.origin, map, arrays);
  return made;
}

void leave_out(DrawnLine& line, const std::vector<uint8_t>& drawn) {
  size_t point = 0;
  uint64_t kept = 0;
  for (uint64_t& offset : line.lines.offsets) {
    for (; point < offset; ++point) kept += drawn[point];
    offset = kept;
  }
  keep(line.lines.positions, drawn, 1);
  keep(line.arc_lengths, drawn, 1);
  keep(line.normals, drawn, 3);
  keep(line.tangents, drawn, 3);
  keep(line.radii, drawn, 2);
  keep(line.faces, drawn, 1);
  keep(line.weights, drawn, 3);
}

}  // namespace

meander_status meander_flow_round_curve(meander_flow* flow, double tolerance, meander_polylines* polylines,
                                        meander_point_data* point_data, meander_context* context,
                                        meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require_struct(polylines);
    if (point_data) require_struct(point_data);
    require_range(tolerance, 0, 0.5, "tolerance (in spacings)");
    check_cancelled(context);
    const CancelToken cancel = cancel_of(context);
    Flow& f = *flow->flow;
    std::vector<uint8_t> drawn;
    const RoundedCurve curve = f.ask(
        [&](const Flow::Present& present) {
          const FlowState& state = present.state;
          RoundedCurve made = rounded(state.domain, state.curve, tolerance, present.pool);
          drawn = drawn_points(state.domain, made.curve, present.pool);
          return made;
        },
        cancel);
    f.normals().prepare(cancel.every(1u << 12));
    auto line = std::make_unique<OwnedResult<DrawnLine>>(all_points(f, flow->map.get(), curve));
    leave_out(line->found, drawn);
    auto data = std::make_unique<OwnedResult<DrawnLine>>();
    if (point_data) data->found = line->found;
    check_cancelled(context);
    hand_out(polylines, std::move(line), [](const DrawnLine& made, meander_polylines& p) {
      p.point_count = made.lines.point_count();
      p.strand_count = made.lines.closed.size();
      point_to(p.positions, made.lines.positions);
      point_to(p.offsets, made.lines.offsets);
      point_to(p.closed, made.lines.closed);
      point_to(p.guides, made.lines.guides);
    });
    if (!point_data) return;
    hand_out(point_data, std::move(data), [](const DrawnLine& made, meander_point_data& d) {
      d.count = made.arc_lengths.size();
      point_to(d.arc_lengths, made.arc_lengths);
      point_to(d.normals, made.normals);
      point_to(d.tangents, made.tangents);
      point_to(d.radii, made.radii);
      point_to(d.faces, made.faces);
      point_to(d.barycentrics, made.weights);
    });
  });
}
