// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces: made of meshes of all kinds, and what is computed on them alone.
#include <algorithm>
#include <cmath>

#include "world.h"
#include "world_call.h"

namespace meander::fuzz {

void World::create_surface() {
  if (!spend(2)) return;
  SurfaceSlot& slot = surface();
  meander_surface_options o = in_.surface_options;
  o.face_mask = data_of(in_.face_mask);
  o.face_mask_count = in_.face_mask.size();
  o.vertex_mask = data_of(in_.vertex_mask);
  o.vertex_mask_count = in_.vertex_mask.size();
  transcript_.line("surface_options.face_mask = face_mask.empty() ? nullptr : face_mask.data();");
  transcript_.line("surface_options.face_mask_count = face_mask.size();");
  transcript_.line("surface_options.vertex_mask = vertex_mask.empty() ? nullptr : vertex_mask.data();");
  transcript_.line("surface_options.vertex_mask_count = vertex_mask.size();");
  auto given_options = made(kSurfaceOptionsStruct, o);
  auto options = sized(given_options, "sized_options", "surface_options");
  if (missing(0)) options = {nullptr, "nullptr"};
  auto vertices = given(in_.vertices, "vertices");
  auto faces = given(in_.faces, "faces");
  if (missing(1)) vertices = {nullptr, "nullptr"};
  if (missing(2)) faces = {nullptr, "nullptr"};
  // As a thread that does nothing else would.
  if (slot.handle) transcript_.line(std::string("meander_surface_destroy(surfaces[") + (has(kOther) ? "1]);" : "0]);"));
  meander_surface_destroy(slot.handle);
  slot = {};
  const char* name = has(kNoCount) ? "nullptr" : has(kOther) ? "&surfaces[1]" : "&surfaces[0]";
  const Shown<meander_surface**> made_surface{has(kNoCount) ? nullptr : &slot.handle, name};
  const meander_status status =
      call("meander_surface_create", meander_surface_create, vertices, shown(in_.vertex_count()), faces,
           shown(in_.face_count()), Shown<const meander_surface_options*>{options.value, options.text}, made_surface,
           context());
  if ((status == MEANDER_STATUS_OK) != (slot.handle != nullptr)) fail(transcript_, "a surface without success");
  check_refusal_of_cancelled(status);
  if (!slot.handle) return;
  slot.shape = shape_of(in_.vertices, in_.faces);
  if (!(slot.shape.diagonal > 0 && std::isfinite(slot.shape.diagonal))) {
    slot.shape.plain = false;
  }
  meander_surface_statistics figures;
  meander_surface_statistics_init(&figures, sizeof figures);
  meander_surface_get_statistics(slot.handle, &figures, nullptr);
  if (figures.merged_vertices || figures.dropped_faces || figures.split_vertices || figures.cut_edges ||
      figures.masked_faces || figures.clipped_faces || figures.welded_edges || figures.opened_edges) {
    slot.shape.plain = false;
  }
}

void World::surface_statistics() {
  auto statistics = made(kSurfaceStatisticsStruct, meander_surface_statistics{});
  auto argument = sized(statistics, "statistics", "meander_surface_statistics{}");
  if (missing(0)) argument = {nullptr, "nullptr"};
  const auto handle = surface_handle();
  const meander_status status =
      call("meander_surface_get_statistics", meander_surface_get_statistics,
           Shown<const meander_surface*>{handle.value, handle.text}, argument);
  const meander_surface_statistics s = statistics.value();
  if (status != MEANDER_STATUS_OK) return;
  if (std::isnan(s.area) || std::isnan(s.diagonal)) fail(transcript_, "NaN in statistics");
  if (s.faces == 0 || s.components == 0) fail(transcript_, "a surface of nothing");
}

void World::find_faults() {
  if (!spend(1)) return;
  const double weld = record_.b ? hostile(record_.b) : record_.a / 64.0;
  auto vertices = given(in_.vertices, "vertices");
  auto faces = given(in_.faces, "faces");
  if (missing(2)) vertices = {nullptr, "nullptr"};
  if (missing(3)) faces = {nullptr, "nullptr"};
  Filled<meander_faults> faults(transcript_, "meander_faults", "faults", missing(0), missing(1));
  const meander_status status =
      call("meander_mesh_find_faults", meander_mesh_find_faults, vertices, shown(in_.vertex_count()), faces,
           shown(in_.face_count()), shown(weld), faults.shown(), context());
  check_refusal_of_cancelled(status);
  if (!faults.check(status)) return;
  faults.indices(faults->kinds, faults->count, MEANDER_FAULT_SEAM + 1);
  for (size_t i = 0; i < faults->count; ++i) {
    const bool of_face = faults->kinds[i] == MEANDER_FAULT_NO_AREA || faults->kinds[i] == MEANDER_FAULT_DOUBLED_FACE;
    faults.indices(faults->elements + 2 * i, 2, of_face ? in_.face_count() : in_.vertex_count());
  }
}

void World::find_closest() {
  if (!spend(1)) return;
  Noise noise(record_.a);
  const size_t count = record_.b % 32;
  std::vector<double> asked(3 * count);
  for (double& x : asked) x = 4 * noise.share() - 2;
  if (record_.c && count > 0) asked[record_.c % asked.size()] = hostile(record_.c);
  if (transcript_.open()) transcript_.line("std::vector<double> asked = " + written(asked) + ";");
  auto vertices = given(in_.vertices, "vertices");
  auto faces = given(in_.faces, "faces");
  auto places = given(asked, "asked");
  if (missing(3)) vertices = {nullptr, "nullptr"};
  if (missing(4)) faces = {nullptr, "nullptr"};
  if (missing(5)) places = {nullptr, "nullptr"};
  Outputs outputs(transcript_);
  const auto found = outputs.array<uint32_t>("found", count, missing(0));
  const auto weights = outputs.array<double>("weights", 3 * count, missing(1));
  const auto distances = outputs.array<double>("distances", count, missing(2), true);
  const uint32_t threads = record_.e % 2 ? record_.e : 1u + record_.e % 4u;
  const bool on_surface = record_.d % 2 == 1;
  const auto handle = surface_handle();
  const meander_status status =
      on_surface ? call("meander_surface_find_closest", meander_surface_find_closest,
                        Shown<const meander_surface*>{handle.value, handle.text}, places, shown(count),
                        shown(threads), found, weights, distances, context())
                 : call("meander_mesh_find_closest", meander_mesh_find_closest, vertices, shown(in_.vertex_count()),
                        faces, shown(in_.face_count()), places, shown(count), shown(threads), found, weights,
                        distances, context());
  check_refusal_of_cancelled(status);
  outputs.check(status == MEANDER_STATUS_OK);
  if (status != MEANDER_STATUS_OK) return;
  const size_t face_count = (on_surface ? surface().shape.faces.size() : in_.faces.size()) / 3;
  for (size_t i = 0; i < count; ++i) {
    if (found.value && found.value[i] >= face_count) fail(transcript_, "a nearest face that is not there");
    if (distances.value && !(distances.value[i] >= 0)) fail(transcript_, "a distance below nothing");
    if (!weights.value) continue;
    const double* w = weights.value + 3 * i;
    if (!(w[0] >= 0 && w[1] >= 0 && w[2] >= 0 && std::abs(w[0] + w[1] + w[2] - 1) < 1e-12)) {
      fail(transcript_, "weights that are no share of a face");
    }
  }
}

void World::field_of_surface() {
  if (!spend(4)) return;
  const Shape& shape = surface().shape;
  const bool curvature = record_.op % kOpCount == kCurvature;
  const uint32_t kind = record_.a < 200 ? record_.a % (curvature ? 6u : 4u) : 0xffffffff;
  const double smoothing = record_.c ? hostile(record_.c) : shape.diagonal * record_.b / 128;
  const size_t count = vertex_count_for(shape);
  const auto handle = surface_handle();
  const Shown<const meander_surface*> argument{handle.value, handle.text};
  Outputs outputs(transcript_);
  const auto values = outputs.array<double>("values", count * (curvature ? 1 : 3), missing(0), shape.extreme);
  const meander_status status =
      curvature ? call("meander_surface_compute_curvature", meander_surface_compute_curvature, argument, shown(kind),
                       shown(smoothing), values, shown(count), context())
                : call("meander_surface_compute_directions", meander_surface_compute_directions, argument, shown(kind),
                       shown(smoothing), values, shown(count), context());
  check_refusal_of_cancelled(status);
  outputs.check(status == MEANDER_STATUS_OK);
}

void World::stroke_directions() {
  if (!spend(4)) return;
  const Shape& shape = surface().shape;
  const size_t count = vertex_count_for(shape), strokes = in_.offsets.size() - 1;
  const auto handle = surface_handle();
  auto points = given(in_.points, "points");
  auto offsets = given(in_.offsets, "offsets");
  if (missing(1)) points = {nullptr, "nullptr"};
  if (missing(2)) offsets = {nullptr, "nullptr"};
  Outputs outputs(transcript_);
  const auto values = outputs.array<double>("values", 3 * count, missing(0), shape.extreme);
  const meander_status status =
      call("meander_surface_compute_stroke_directions", meander_surface_compute_stroke_directions,
           Shown<const meander_surface*>{handle.value, handle.text}, points, shown(in_.points.size() / 3), offsets,
           shown(strokes), values, shown(count), context());
  check_refusal_of_cancelled(status);
  outputs.check(status == MEANDER_STATUS_OK);
}

void World::turn_directions() {
  if (!spend(2)) return;
  const Shape& shape = surface().shape;
  const size_t count = vertex_count_for(shape);
  Noise noise(record_.a);
  std::vector<double> directions(3 * count), angles(count);
  for (double& x : directions) x = noise.share() - 0.5;
  for (double& x : angles) x = 20 * noise.share() - 10;
  if (record_.b % 4 == 1 && count > 0) directions[record_.c % directions.size()] = hostile(record_.c);
  if (record_.b % 4 == 2 && count > 0) angles[record_.c % count] = hostile(record_.c);
  if (record_.b % 4 == 3) {
    for (double& x : directions) x *= hostile(record_.c);
  }
  if (transcript_.open()) {
    transcript_.line("std::vector<double> directions = " + written(directions) + ";");
    transcript_.line("std::vector<double> angles = " + written(angles) + ";");
  }
  const std::vector<double> before = directions;
  const auto handle = surface_handle();
  const Shown<double*> turned{missing(0) ? nullptr : directions.data(), missing(0) ? "nullptr" : "directions.data()"};
  const meander_status status = call("meander_surface_turn_directions", meander_surface_turn_directions,
                                     Shown<const meander_surface*>{handle.value, handle.text}, turned,
                                     missing(1) ? Shown<const double*>{nullptr, "nullptr"} : given(angles, "angles"),
                                     shown(count), context());
  check_refusal_of_cancelled(status);
  if (status != MEANDER_STATUS_OK) {
    if (!std::equal(before.begin(), before.end(), directions.begin(),
                    [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); })) {
      fail(transcript_, "directions were written by a call that gives nothing");
    }
    return;
  }
  for (const double x : directions) {
    if (!(std::abs(x) <= 1.001)) fail(transcript_, "a direction that is no unit vector");
  }
}

void World::outlines() {
  if (!spend(8)) return;
  const Shape& shape = surface().shape;
  double spacing = 2 * radius_for(shape), distance = spacing * (record_.a ? 0.1 + 1.9 * record_.a / 255 : 0.5);
  if (record_.b) spacing = hostile(record_.b);
  if (record_.c) distance = hostile(record_.c);
  // What would take long: many points, or many small faces along the boundary.
  if (spacing > 0 && spacing < 0.02 * shape.diagonal) return;
  if (distance >= 0.1 * spacing && distance < 0.05 * shape.diagonal) return;
  const auto handle = surface_handle();
  Filled<meander_outlines> outlines(transcript_, "meander_outlines", "outlines", missing(0), missing(1));
  const meander_status status =
      call("meander_surface_find_outlines", meander_surface_find_outlines,
           Shown<const meander_surface*>{handle.value, handle.text}, shown(distance), shown(spacing),
           outlines.shown(), context());
  check_refusal_of_cancelled(status);
  if (!outlines.check(status)) return;
  outlines.numbers(outlines->positions, 3 * outlines->point_count);
  outlines.offsets(outlines->offsets, outlines->strand_count, outlines->point_count);
}

void World::cost() {
  if (!spend(1)) return;
  const auto handle = surface_handle();
  auto measured = made(kExtentStruct, meander_extent{});
  const auto extent = sized(measured, "extent", "meander_extent{}");
  const meander_status status =
      call("meander_surface_measure_extent", meander_surface_measure_extent,
           Shown<const meander_surface*>{handle.value, handle.text}, given(in_.density, "density"),
           shown(in_.density.size()), missing(0) ? Shown<meander_extent*>{nullptr, "nullptr"} : extent);
  meander_extent figures = measured.value();
  const double sums[] = {figures.length_area, figures.node_area, figures.edge_density};
  for (const double x : sums) {
    if (status == MEANDER_STATUS_OK && !(x >= 0)) fail(transcript_, "an extent that is no number");
  }
  if (record_.b) figures.length_area = hostile(record_.b);
  if (record_.c) figures.node_area = hostile(record_.c);
  if (record_.d) figures.edge_density = hostile(record_.d);
  if (record_.e) figures.faces = record_.e == 255 ? 0xffffffff : record_.e;
  if (transcript_.open()) {
    transcript_.line("meander_extent figures = extent.value();");
    transcript_.line("figures.length_area = " + written(figures.length_area) + ";");
    transcript_.line("figures.node_area = " + written(figures.node_area) + ";");
    transcript_.line("figures.edge_density = " + written(figures.edge_density) + ";");
    transcript_.line("figures.faces = " + written(figures.faces) + ";");
  }
  auto asked = made(kExtentStruct, figures);
  const auto asked_extent = sized(asked, "asked", "figures");
  auto given_options = options_for(surface().shape);
  auto options = sized(given_options, "sized_options", "options");
  auto found = made(kCostStruct, meander_cost{});
  auto argument = sized(found, "cost", "meander_cost{}");
  if (missing(1)) argument = {nullptr, "nullptr"};
  if (call("meander_extent_estimate_cost", meander_extent_estimate_cost,
           Shown<const meander_extent*>{asked_extent.value, asked_extent.text},
           Shown<const meander_flow_options*>{options.value, options.text}, argument) != MEANDER_STATUS_OK) {
    return;
  }
  const meander_cost c = found.value();
  const double costs[] = {c.nodes, c.points, c.length, c.memory, c.processor_seconds};
  for (const double x : costs) {
    if (!(x >= 0)) fail(transcript_, "a cost that is no number");
  }
}

}  // namespace meander::fuzz
