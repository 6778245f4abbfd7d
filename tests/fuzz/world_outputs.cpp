// SPDX-License-Identifier: GPL-3.0-or-later
//
// What comes out of a flow, with too little room, with arrays that are NULL, and as it should be.
#include "world.h"
#include "world_call.h"

namespace meander::fuzz {
namespace {

Shown<const meander_flow*> constant(const Shown<meander_flow*>& flow) { return {flow.value, flow.text}; }

}  // namespace

void World::flow_statistics() {
  if (!spend(3)) return;
  FlowSlot& slot = flow();
  auto given = made(kFlowStatisticsStruct, meander_flow_statistics{});
  auto argument = sized(given, "statistics", "meander_flow_statistics{}");
  if (missing(0)) argument = {nullptr, "nullptr"};
  const meander_status status = call("meander_flow_compute_statistics", meander_flow_compute_statistics, flow_handle(),
                                     argument, context());
  check_refusal_of_cancelled(status);
  after_change(slot, status, !slot.moved_on);
  if (status != MEANDER_STATUS_OK) return;
  const meander_flow_statistics s = given.value();
  if (s.crossings != 0) fail(transcript_, "crossings");
  if (s.strands == 0 || s.nodes == 0) fail(transcript_, "statistics of nothing");
  const double figures[] = {s.length,         s.energy,         s.mean_step, s.spacing_target, s.spacing_p05,
                            s.spacing_median, s.spacing_p95,    s.evenness,  s.seconds_total,  s.seed_distance,
                            s.seed_jump_length};
  for (const double x : figures) {
    if (std::isnan(x)) fail(transcript_, "NaN in statistics");
  }
  if (!(s.evenness >= 0 && s.evenness <= 1)) fail(transcript_, "an evenness outside of [0, 1]");
}

void World::history() {
  const auto handle = constant(flow_handle());
  size_t count = 0;
  const size_t size = record_.a ? record_.a * 4u : sizeof(meander_iteration);
  const auto get = [&](Shown<meander_iteration*> records, size_t room) {
    return call("meander_flow_get_history", meander_flow_get_history, handle, records, shown(size), shown(room),
                out(count, "count"));
  };
  if (get({nullptr, "nullptr"}, 0) != MEANDER_STATUS_OK) return;
  const size_t room = room_for(count);
  Outputs outputs(transcript_);
  const auto bytes = outputs.array<uint64_t>("records", (room * size + 7) / 8, missing(0));
  const meander_status status = get({reinterpret_cast<meander_iteration*>(bytes.value),
                                     bytes.value ? "reinterpret_cast<meander_iteration*>(records.data())" : "nullptr"},
                                    room);
  if (status != MEANDER_STATUS_OK || count > room) outputs.check(false);
}

void World::polylines() {
  if (!spend(1)) return;
  const auto handle = constant(flow_handle());
  size_t points = 0, strands = 0;
  const auto get = [&](Shown<double*> positions, Shown<double*> normals, size_t point_room, Shown<uint64_t*> offsets,
                       Shown<uint8_t*> closed, size_t strand_room) {
    return call("meander_flow_get_polylines", meander_flow_get_polylines, handle, positions, normals,
                shown(point_room), out(points, "point_count"), offsets, closed, shown(strand_room),
                out(strands, "strand_count"));
  };
  const Shown<double*> none{nullptr, "nullptr"};
  if (get(none, none, 0, {nullptr, "nullptr"}, {nullptr, "nullptr"}, 0) != MEANDER_STATUS_OK) return;
  const size_t point_room = room_for(points), strand_room = record_.a % 2 ? room_for(strands) : strands;
  Outputs outputs(transcript_);
  const auto positions = outputs.array<double>("positions", 3 * point_room, missing(0));
  const auto normals = outputs.array<double>("normals", 3 * point_room, missing(1));
  const auto offsets = outputs.array<uint64_t>("offsets_out", strand_room + 1, missing(2));
  const auto closed = outputs.array<uint8_t>("closed_out", strand_room, missing(3));
  const meander_status status = get(positions, normals, point_room, offsets, closed, strand_room);
  outputs.check(status == MEANDER_STATUS_OK && points <= point_room && strands <= strand_room);
  if (status != MEANDER_STATUS_OK || !normals.value || points > point_room || strands > strand_room) return;
  for (size_t i = 0; i < points; ++i) {
    const double* n = normals.value + 3 * i;
    const double length = std::hypot(n[0], n[1], n[2]);
    if (!(std::abs(length - 1) < 1e-6)) fail(transcript_, "a normal that is not of length 1");
  }
}

void World::guides() {
  const auto handle = constant(flow_handle());
  size_t count = 0;
  const auto get = [&](Shown<uint8_t*> array, size_t room) {
    return call("meander_flow_get_guides", meander_flow_get_guides, handle, array, shown(room), out(count, "count"));
  };
  if (get({nullptr, "nullptr"}, 0) != MEANDER_STATUS_OK) return;
  const size_t room = room_for(count);
  Outputs outputs(transcript_);
  const meander_status status = get(outputs.array<uint8_t>("guides_out", room, missing(0)), room);
  outputs.check(status == MEANDER_STATUS_OK && count <= room);
}

void World::nodes() {
  if (!spend(1)) return;
  const auto handle = constant(flow_handle());
  size_t count = 0;
  const auto get = [&](Shown<uint32_t*> faces, Shown<double*> weights, Shown<double*> radii, Shown<uint8_t*> fixed,
                       size_t room) {
    return call("meander_flow_get_nodes", meander_flow_get_nodes, handle, faces, weights, radii, fixed, shown(room),
                out(count, "count"));
  };
  const Shown<double*> none{nullptr, "nullptr"};
  if (get({nullptr, "nullptr"}, none, none, {nullptr, "nullptr"}, 0) != MEANDER_STATUS_OK) return;
  const size_t room = room_for(count);
  Outputs outputs(transcript_);
  const auto faces = outputs.array<uint32_t>("faces_out", room, missing(0));
  const auto weights = outputs.array<double>("weights", 3 * room, missing(1));
  const auto radii = outputs.array<double>("radii", 2 * room, missing(2));
  const auto fixed = outputs.array<uint8_t>("fixed_out", room, missing(3));
  const meander_status status = get(faces, weights, radii, fixed, room);
  const bool written = status == MEANDER_STATUS_OK && count <= room;
  outputs.check(written);
  const size_t face_count = flow().shape.faces.size() / 3;
  for (size_t i = 0; written && faces.value && i < count; ++i) {
    if (faces.value[i] >= face_count) fail(transcript_, "a node on a face that is not there");
  }
}

void World::point_data() {
  if (!spend(4)) return;
  FlowSlot& slot = flow();
  const auto handle = flow_handle();
  size_t count = 0;
  const auto get = [&](Shown<double*> lengths, Shown<double*> normals, Shown<double*> tangents, Shown<double*> radii,
                       Shown<uint32_t*> faces, Shown<double*> weights, size_t room) {
    return call("meander_flow_compute_point_data", meander_flow_compute_point_data, handle, lengths, normals, tangents,
                radii, faces, weights, shown(room), out(count, "count"), context());
  };
  const Shown<double*> none{nullptr, "nullptr"};
  if (get(none, none, none, none, {nullptr, "nullptr"}, none, 0) != MEANDER_STATUS_OK) return;
  const size_t room = room_for(count);
  Outputs outputs(transcript_);
  const auto lengths = outputs.array<double>("lengths", room, missing(0));
  const auto normals = outputs.array<double>("normals", 3 * room, missing(1));
  const auto tangents = outputs.array<double>("tangents", 3 * room, missing(2));
  const auto radii = outputs.array<double>("radii", 2 * room, missing(3));
  const auto faces = outputs.array<uint32_t>("faces_out", room, missing(4));
  const auto weights = outputs.array<double>("weights", 3 * room, missing(5));
  const meander_status status = get(lengths, normals, tangents, radii, faces, weights, room);
  if (count <= room) check_refusal_of_cancelled(status);  // else there is no work, and no context is asked
  outputs.check(status == MEANDER_STATUS_OK && count <= room);
  after_change(slot, status, !slot.moved_on);
}

void World::gaps() {
  if (!spend(10)) return;
  FlowSlot& slot = flow();
  const auto handle = flow_handle();
  const double least = record_.b ? hostile(record_.b) : record_.a / 64.0;
  size_t count = 0;
  const auto find = [&](Shown<double*> positions, Shown<double*> radii, Shown<double*> sizes, Shown<uint32_t*> faces,
                        size_t room) {
    return call("meander_flow_find_gaps", meander_flow_find_gaps, handle, shown(least), positions, radii, sizes, faces,
                shown(room), out(count, "count"), context());
  };
  const Shown<double*> none{nullptr, "nullptr"};
  if (find(none, none, none, {nullptr, "nullptr"}, 0) != MEANDER_STATUS_OK) return;
  const size_t needed = count, room = room_for(count);
  Outputs outputs(transcript_);
  const auto positions = outputs.array<double>("positions", 3 * room, missing(0));
  const auto radii = outputs.array<double>("radii", room, missing(1));
  const auto sizes = outputs.array<double>("sizes", room, missing(2));
  const auto faces = outputs.array<uint32_t>("faces_out", room, missing(3));
  const meander_status status = find(positions, radii, sizes, faces, room);
  check_refusal_of_cancelled(status);
  const bool written = status == MEANDER_STATUS_OK && count <= room;
  outputs.check(written);
  if (status == MEANDER_STATUS_OK && count != needed) fail(transcript_, "another number of gaps in the second call");
  for (size_t i = 1; written && sizes.value && i < count; ++i) {
    if (sizes.value[i] > sizes.value[i - 1]) fail(transcript_, "gaps that become larger");
  }
  after_change(slot, status, !slot.moved_on);
}

void World::cut_surface() {
  FlowSlot& slot = flow();
  double detail = record_.a ? slot.options.radius * (0.3 + record_.a / 64.0) : 0;
  if (record_.b) detail = hostile(record_.b);
  const double relative = detail / slot.shape.diagonal;
  if (relative > 0 && slot.shape.relative_area / relative / relative > 3000 && relative > 1e-8) return;  // takes long
  if (!spend(10)) return;
  const auto handle = constant(flow_handle());
  if (cut_) transcript_.line("meander_cut_destroy(cut);");
  meander_cut_destroy(cut_);
  cut_ = nullptr;
  const meander_status status =
      call("meander_flow_cut_surface", meander_flow_cut_surface, handle, shown(detail), shown(uint32_t{record_.c % 3u}),
           has(kNoCount) ? Shown<meander_cut**>{nullptr, "nullptr"} : Shown<meander_cut**>{&cut_, "&cut"}, context());
  check_refusal_of_cancelled(status);
  if ((status == MEANDER_STATUS_OK) != (cut_ != nullptr)) fail(transcript_, "a cut without success");
}

void World::cut_vertices() {
  const Shown<const meander_cut*> handle{has(kNoHandle) ? nullptr : cut_, has(kNoHandle) ? "nullptr" : "cut"};
  size_t count = 0;
  const auto get = [&](Shown<double*> positions, Shown<double*> distances, Shown<uint32_t*> faces,
                       Shown<double*> weights, size_t room) {
    return call("meander_cut_get_vertices", meander_cut_get_vertices, handle, positions, distances, faces, weights,
                shown(room), out(count, "count"));
  };
  const Shown<double*> none{nullptr, "nullptr"};
  if (get(none, none, {nullptr, "nullptr"}, none, 0) != MEANDER_STATUS_OK) return;
  const size_t room = room_for(count);
  Outputs outputs(transcript_);
  const auto positions = outputs.array<double>("positions", 3 * room, missing(0));
  const auto distances = outputs.array<double>("distances", room, missing(1), true);
  const auto faces = outputs.array<uint32_t>("faces_out", room, missing(2));
  const auto weights = outputs.array<double>("weights", 3 * room, missing(3));
  const meander_status status = get(positions, distances, faces, weights, room);
  outputs.check(status == MEANDER_STATUS_OK && count <= room);
}

void World::cut_faces() {
  const Shown<const meander_cut*> handle{has(kNoHandle) ? nullptr : cut_, has(kNoHandle) ? "nullptr" : "cut"};
  size_t count = 0, vertex_count = 0;
  const auto get = [&](Shown<uint32_t*> vertices, Shown<uint32_t*> origins, Shown<uint32_t*> strands,
                       Shown<uint32_t*> regions, Shown<int32_t*> sides, Shown<int32_t*> nearest, Shown<double*> along,
                       Shown<double*> distances, Shown<double*> weights, size_t room) {
    return call("meander_cut_get_faces", meander_cut_get_faces, handle, vertices, origins, strands, regions, sides,
                nearest, along, distances, weights, shown(room), out(count, "count"));
  };
  const Shown<double*> none{nullptr, "nullptr"};
  const Shown<uint32_t*> no_words{nullptr, "nullptr"};
  const Shown<int32_t*> no_signs{nullptr, "nullptr"};
  if (get(no_words, no_words, no_words, no_words, no_signs, no_signs, none, none, none, 0) != MEANDER_STATUS_OK) return;
  meander_cut_get_vertices(handle.value, nullptr, nullptr, nullptr, nullptr, 0, &vertex_count, nullptr);
  const size_t room = room_for(count);
  Outputs outputs(transcript_);
  const auto vertices = outputs.array<uint32_t>("cut_faces", 3 * room, missing(0));
  const auto origins = outputs.array<uint32_t>("origins", room, missing(1));
  const auto strands = outputs.array<uint32_t>("strands", room, missing(2));
  const auto regions = outputs.array<uint32_t>("regions", room, missing(3));
  const auto sides = outputs.array<int32_t>("sides", room, missing(4));
  const auto nearest = outputs.array<int32_t>("nearest_sides", room, missing(5));
  const auto along = outputs.array<double>("along", 3 * room, missing(6));
  const auto distances = outputs.array<double>("distances", 3 * room, missing(7), true);
  const auto weights = outputs.array<double>("weights", 9 * room, false);
  const meander_status status =
      get(vertices, origins, strands, regions, sides, nearest, along, distances, weights, room);
  const bool written = status == MEANDER_STATUS_OK && count <= room;
  outputs.check(written);
  for (size_t i = 0; written && vertices.value && i < 3 * count; ++i) {
    if (vertices.value[i] >= vertex_count) fail(transcript_, "a corner of a cut that is not there");
  }
}

void World::cut_line() {
  const Shown<const meander_cut*> handle{has(kNoHandle) ? nullptr : cut_, has(kNoHandle) ? "nullptr" : "cut"};
  size_t points = 0, strands = 0;
  const auto get = [&](Shown<uint32_t*> vertices, Shown<double*> arcs, size_t point_room, Shown<uint64_t*> offsets,
                       Shown<uint32_t*> names, Shown<uint8_t*> closed, Shown<double*> lengths, size_t strand_room) {
    return call("meander_cut_get_line", meander_cut_get_line, handle, vertices, arcs, shown(point_room),
                out(points, "point_count"), offsets, names, closed, lengths, shown(strand_room),
                out(strands, "strand_count"));
  };
  const Shown<double*> none{nullptr, "nullptr"};
  const Shown<uint32_t*> no_words{nullptr, "nullptr"};
  const meander_status asked =
      get(no_words, none, 0, {nullptr, "nullptr"}, no_words, {nullptr, "nullptr"}, none, 0);
  if (asked != MEANDER_STATUS_OK) return;
  const size_t point_room = room_for(points), strand_room = record_.a % 2 ? room_for(strands) : strands;
  Outputs outputs(transcript_);
  const auto vertices = outputs.array<uint32_t>("vertices_out", point_room, missing(0));
  const auto arcs = outputs.array<double>("arc_lengths", point_room, missing(1));
  const auto offsets = outputs.array<uint64_t>("offsets_out", strand_room + 1, missing(2));
  const auto names = outputs.array<uint32_t>("strands", strand_room, missing(3));
  const auto closed = outputs.array<uint8_t>("closed_out", strand_room, missing(4));
  const auto lengths = outputs.array<double>("lengths", strand_room, missing(5));
  const meander_status status = get(vertices, arcs, point_room, offsets, names, closed, lengths, strand_room);
  outputs.check(status == MEANDER_STATUS_OK && points <= point_room && strands <= strand_room);
}

}  // namespace meander::fuzz
