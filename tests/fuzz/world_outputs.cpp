// SPDX-License-Identifier: GPL-3.0-or-later
//
// What comes out of a flow, with too little room, with arrays that are NULL, and as it should be.
#include <algorithm>

#include "watched_run.h"
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
  Filled<meander_polylines> curve(transcript_, "meander_polylines", "curve", missing(0), missing(1));
  const meander_status status =
      call("meander_flow_get_polylines", meander_flow_get_polylines, constant(flow_handle()), curve.shown());
  if (!curve.check(status)) return;
  curve.numbers(curve->positions, 3 * curve->point_count);
  curve.offsets(curve->offsets, curve->strand_count, curve->point_count);
  for (size_t s = 0; s < curve->strand_count; ++s) {
    if (curve->closed[s] > 1 || curve->guides[s] > 1) fail(transcript_, "a flag that is neither 0 nor 1");
  }
}

void World::nodes() {
  if (!spend(1)) return;
  Filled<meander_nodes> nodes(transcript_, "meander_nodes", "nodes", missing(0), missing(1));
  const meander_status status =
      call("meander_flow_get_nodes", meander_flow_get_nodes, constant(flow_handle()), nodes.shown());
  if (!nodes.check(status)) return;
  nodes.indices(nodes->faces, nodes->count, flow().shape.faces.size() / 3);
  nodes.numbers(nodes->barycentrics, 3 * nodes->count);
  nodes.numbers(nodes->radii, 2 * nodes->count);
}

void World::point_data() {
  if (!spend(4)) return;
  FlowSlot& slot = flow();
  const uint32_t parts = record_.a % 40;
  Filled<meander_point_data> data(transcript_, "meander_point_data", "data", missing(0), missing(1));
  const meander_status status = call("meander_flow_compute_point_data", meander_flow_compute_point_data, flow_handle(),
                                     shown(parts), data.shown(), context());
  check_refusal_of_cancelled(status);
  if (data.check(status)) {
    const auto wanted = [&](uint32_t part, size_t columns) { return parts & part ? columns * data->count : 0; };
    data.numbers(data->arc_lengths, wanted(MEANDER_POINT_PARTS_ARC_LENGTHS, 1));
    data.numbers(data->normals, wanted(MEANDER_POINT_PARTS_NORMALS, 3));
    data.numbers(data->tangents, wanted(MEANDER_POINT_PARTS_TANGENTS, 3));
    data.numbers(data->radii, wanted(MEANDER_POINT_PARTS_RADII, 2));
    data.numbers(data->barycentrics, wanted(MEANDER_POINT_PARTS_PLACES, 3));
    data.indices(data->faces, wanted(MEANDER_POINT_PARTS_PLACES, 1), slot.shape.faces.size() / 3);
    for (size_t i = 0; i < wanted(MEANDER_POINT_PARTS_NORMALS, 1); ++i) {
      const double* n = data->normals + 3 * i;
      if (!(std::abs(std::hypot(n[0], n[1], n[2]) - 1) < 1e-6)) fail(transcript_, "a normal that is not of length 1");
    }
  }
  after_change(slot, status, !slot.moved_on);
}

void World::gaps() {
  if (!spend(10)) return;
  FlowSlot& slot = flow();
  const double least = record_.b ? hostile(record_.b) : record_.a / 64.0;
  Filled<meander_gaps> gaps(transcript_, "meander_gaps", "gaps", missing(0), missing(1));
  const meander_status status = call("meander_flow_find_gaps", meander_flow_find_gaps, flow_handle(), shown(least),
                                     gaps.shown(), context());
  check_refusal_of_cancelled(status);
  if (gaps.check(status)) {
    gaps.numbers(gaps->positions, 3 * gaps->count);
    gaps.numbers(gaps->radii, gaps->count);
    gaps.numbers(gaps->sizes, gaps->count);
    gaps.indices(gaps->faces, gaps->count, slot.shape.faces.size() / 3);
    for (size_t i = 1; i < gaps->count; ++i) {
      if (gaps->sizes[i] > gaps->sizes[i - 1]) fail(transcript_, "gaps that become larger");
    }
  }
  after_change(slot, status, !slot.moved_on);
}

void World::round_curve() {
  if (!spend(20)) return;
  FlowSlot& slot = flow();
  const double tolerance = record_.b ? hostile(record_.b) : record_.a / 512.0;
  Filled<meander_polylines> line(transcript_, "meander_polylines", "line", missing(0), missing(1));
  Filled<meander_point_data> data(transcript_, "meander_point_data", "data", missing(2), missing(3));
  const auto digest = [&] {
    return slot.handle && !slot.started ? sweep::digest_of(sweep::state_of(slot.handle)) : 0;
  };
  const uint64_t before = digest();
  const meander_status status = call("meander_flow_round_curve", meander_flow_round_curve, flow_handle(),
                                     shown(tolerance), line.shown(), data.shown(), context());
  check_refusal_of_cancelled(status);
  if (digest() != before) fail(transcript_, "the curve itself is another one");
  if (data.check(status)) {
    data.numbers(data->arc_lengths, data->count);
    data.numbers(data->normals, 3 * data->count);
    data.numbers(data->tangents, 3 * data->count);
    data.numbers(data->radii, 2 * data->count);
    data.numbers(data->barycentrics, 3 * data->count);
    data.indices(data->faces, data->count, slot.shape.faces.size() / 3);
  }
  if (!line.check(status)) return;
  line.numbers(line->positions, 3 * line->point_count);
  line.offsets(line->offsets, line->strand_count, line->point_count);
  if (data->result && data->count != line->point_count) fail(transcript_, "data of other points than the line's");
}

void World::cut_surface() {
  FlowSlot& slot = flow();
  double detail = record_.a ? slot.options.radius * (0.3 + record_.a / 64.0) : 0;
  if (record_.b) detail = hostile(record_.b);
  const double relative = detail / slot.shape.diagonal;
  if (relative > 0 && slot.shape.relative_area / relative / relative > 3000 && relative > 1e-8) return;  // takes long
  if (!spend(10)) return;
  Filled<meander_cut> cut(transcript_, "meander_cut", "cut", has(kNoCount), missing(1));
  const meander_status status =
      call("meander_flow_cut_surface", meander_flow_cut_surface, constant(flow_handle()), shown(detail),
           shown(uint32_t{record_.c % 3u}), cut.shown(), context());
  check_refusal_of_cancelled(status);
  if (!cut.check(status)) return;
  const size_t vertices = cut->vertex_count, faces = cut->face_count, given = slot.shape.faces.size() / 3;
  cut.numbers(cut->positions, 3 * vertices);
  cut.numbers(cut->distances, vertices, true);
  cut.numbers(cut->vertex_weights, 3 * vertices);
  cut.numbers(cut->along, 3 * faces);
  cut.numbers(cut->face_distances, 3 * faces, true);
  cut.numbers(cut->corner_weights, 9 * faces);
  cut.numbers(cut->arc_lengths, cut->point_count);
  cut.numbers(cut->lengths, cut->strand_count);
  cut.indices(cut->vertex_faces, vertices, given);
  cut.indices(cut->origins, faces, given);
  cut.indices(cut->faces, 3 * faces, vertices);
  cut.indices(cut->line_vertices, cut->point_count, vertices);
  cut.offsets(cut->offsets, cut->strand_count, cut->point_count);
  if (record_.d) places_of_cut(cut);
}

void World::places_of_cut(const Filled<meander_cut>& cut) {
  Noise noise(record_.d);
  const size_t count = record_.d % 32;
  std::vector<int32_t> faces(count);
  for (int32_t& f : faces) f = static_cast<int32_t>(noise.next() % (cut->face_count + 1)) - 1;
  std::vector<float> weights(3 * count);
  for (float& w : weights) w = static_cast<float>(noise.share());
  if (record_.e && count > 0) {
    weights[record_.e % weights.size()] = static_cast<float>(hostile(record_.e));
    if (record_.e >= 224) faces[record_.e % count] = static_cast<int32_t>(noise.next()) - (1 << 23);
  }
  if (transcript_.open()) {
    transcript_.line("std::vector<int32_t> places = " + written(faces) + ";");
    transcript_.line("std::vector<float> weights = " + written(weights) + ";");
  }
  const double distance = has(kShort) ? hostile(record_.e) : flow().options.radius;
  Outputs outputs(transcript_);
  const auto distances = outputs.array<double>("distances", count, missing(2), true);
  const auto away = outputs.array<double>("away", 3 * count, missing(3), true);
  const auto strands = outputs.array<uint32_t>("strands", count, missing(4));
  const auto along = outputs.array<double>("along", count, missing(5), true);
  const meander_status status =
      call("meander_cut_find_places", meander_cut_find_places, Shown<const meander_cut*>{cut.operator->(), "&cut"},
           shown(distance), given(faces, "places"), given(weights, "weights"), shown(count),
           shown(1u + record_.e % 3u), distances, away, strands, along, context());
  check_refusal_of_cancelled(status);
  if (status == MEANDER_STATUS_OK && flow().shape.extreme) return;
  outputs.check(status == MEANDER_STATUS_OK);
  if (status != MEANDER_STATUS_OK) return;
  for (size_t i = 0; i < count; ++i) {
    if (distances.value && !(distances.value[i] >= 0 && distances.value[i] <= distance)) {
      fail(transcript_, "a distance beyond the farthest");
    }
    const uint32_t strand = strands.value ? strands.value[i] : UINT32_MAX;
    if (strand == UINT32_MAX) continue;
    const uint32_t* const end = cut->line_strands + cut->strand_count;
    const auto which = static_cast<size_t>(std::find(cut->line_strands, end, strand) - cut->line_strands);
    if (which == cut->strand_count) fail(transcript_, "a strand that is not there");
    if (along.value && !(along.value[i] >= 0 && along.value[i] <= cut->lengths[which] * (1 + 1e-12))) {
      fail(transcript_, "a place beyond the end of its strand");
    }
  }
}

void World::map_pixels() {
  if (!spend(1)) return;
  Noise noise(record_.a);
  const uint32_t side = record_.d % 40, margin = record_.e % 8;
  std::vector<double> drawing(6u * (record_.b % 24u));
  for (double& x : drawing) x = (noise.share() * 1.5 - 0.25) * side;
  if (record_.c && !drawing.empty()) drawing[record_.c % drawing.size()] = hostile(record_.c);
  if (transcript_.open()) {
    transcript_.line("std::vector<double> drawing = " + written(drawing) + ";");
    transcript_.line("size_t covered = 0, twice = 0;");
  }
  const size_t pixels = size_t{side} * side, face_count = drawing.size() / 6;
  Outputs outputs(transcript_);
  const auto nearest = outputs.array<int32_t>("nearest", pixels, missing(0));
  const auto weights = outputs.array<float>("weights", 3 * pixels, missing(1));
  size_t covered = 0, twice = 0;
  const meander_status status =
      call("meander_map_find_pixels", meander_map_find_pixels, given(drawing, "drawing"), shown(face_count),
           shown(side), shown(margin), shown(1u + record_.e % 3u), nearest, weights, out(covered, "covered"),
           out(twice, "twice"), context());
  check_refusal_of_cancelled(status);
  if (status != MEANDER_STATUS_CANCELLED) outputs.check(status == MEANDER_STATUS_OK);
  if (status != MEANDER_STATUS_OK) return;
  size_t filled = 0;
  for (size_t p = 0; p < pixels; ++p) {
    const int32_t face = nearest.value[p];
    const float* const w = weights.value + 3 * p;
    if (face < -1 || face >= static_cast<int32_t>(face_count)) fail(transcript_, "a pixel of no face");
    if (!(std::abs(w[0] + w[1] + w[2] - (face < 0 ? 0 : 1)) < 1e-5F)) fail(transcript_, "weights of no face");
    filled += face >= 0;
  }
  if (twice > covered || covered > filled || (margin == 0 && covered != filled)) {
    fail(transcript_, "a wrong number of pixels");
  }
}

}  // namespace meander::fuzz
