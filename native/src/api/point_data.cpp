// SPDX-License-Identifier: GPL-3.0-or-later
//
// Data of every point of the curve.
#include "outputs/point_data.h"

#include "api/found.h"
#include "api/guard.h"

using namespace meander;

namespace {

/// Of the surface, between two asks.
constexpr uint32_t kFacesPerPoll = 4096;

}  // namespace

PointValues meander::point_values(const meander_flow& handle, const Curve& curve, const NodeData<uint32_t>* origin,
                                  meander_point_parts parts) {
  PointValues made;
  made.count = polyline_point_count(curve);
  const auto room = [&](auto& values, meander_point_parts part, size_t columns) {
    if (!(parts & part)) return decltype(values.data()){};
    values.resize(columns * made.count);
    return values.data();
  };
  PointArrays arrays;
  arrays.arc_lengths = room(made.arc_lengths, MEANDER_POINT_PARTS_ARC_LENGTHS, 1);
  arrays.normals = room(made.normals, MEANDER_POINT_PARTS_NORMALS, 3);
  arrays.tangents = room(made.tangents, MEANDER_POINT_PARTS_TANGENTS, 3);
  arrays.radii = room(made.radii, MEANDER_POINT_PARTS_RADII, 2);
  arrays.faces = room(made.faces, MEANDER_POINT_PARTS_PLACES, 1);
  arrays.barycentrics = room(made.weights, MEANDER_POINT_PARTS_PLACES, 3);
  write_point_data(*handle.flow, curve, origin, handle.map.get(), arrays);
  return made;
}

Ready<meander_point_data> meander::ready_point_data(PointValues values) {
  return ready<meander_point_data>(std::move(values), [](const PointValues& made, meander_point_data& data) {
    data.count = made.count;
    point_to(data.arc_lengths, made.arc_lengths);
    point_to(data.normals, made.normals);
    point_to(data.tangents, made.tangents);
    point_to(data.radii, made.radii);
    point_to(data.faces, made.faces);
    point_to(data.barycentrics, made.weights);
  });
}

meander_status meander_flow_compute_point_data(meander_flow* flow, meander_point_parts parts,
                                               meander_point_data* point_data, meander_context* context,
                                               meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require_struct(point_data);
    require(parts <= MEANDER_POINT_PARTS_ALL, "The parts are no sum of MEANDER_POINT_PARTS_...");
    Flow& f = *flow->flow;
    check_cancelled(context);
    const CancelToken cancel = cancel_of(context);
    if (parts & MEANDER_POINT_PARTS_RADII) f.update_radii(cancel);
    if (parts & MEANDER_POINT_PARTS_NORMALS) f.normals().prepare(cancel.every(kFacesPerPoll));
    check_cancelled(context);
    ready_point_data(point_values(*flow, f.curve(), nullptr, parts)).hand_out(point_data);
  });
}
