// SPDX-License-Identifier: GPL-3.0-or-later
#include "world.h"

#include <algorithm>

#include "world_call.h"

namespace meander::fuzz {

World::~World() {
  for (FlowSlot& slot : flows_) destroy_flow(slot);
  for (SurfaceSlot& slot : surfaces_) meander_surface_destroy(slot.handle);
  meander_context_destroy(context_);
}

void World::run(const Record& record) {
  record_ = record;
  if (in_.apply(record)) return;
  transcript_.line("{");
  call_surface();
  call_flow();
  call_getter();
  call_cut();
  call_context();
  transcript_.line("}");
}

void World::call_surface() {
  switch (record_.op % kOpCount) {
    case kSurfaceCreate: create_surface(); break;
    case kSurfaceDestroy:
      transcript_.line(std::string("meander_surface_destroy(surfaces[") + (has(kOther) ? "1" : "0") + "]);");
      meander_surface_destroy(surface().handle);
      surface() = {};
      break;
    case kSurfaceStatistics: surface_statistics(); break;
    case kFindFaults: find_faults(); break;
    case kFindClosest: find_closest(); break;
    case kCurvature:
    case kDirections: field_of_surface(); break;
    case kStrokeDirections: stroke_directions(); break;
    case kTurnDirections: turn_directions(); break;
    case kReadPolygons: read_polygons(); break;
    case kReadNumbers: read_numbers(); break;
    case kWriteRows: write_rows(); break;
    case kTriangulate: triangulate(); break;
    case kOutlines: outlines(); break;
    case kCost: cost(); break;
    default: break;
  }
}

void World::call_flow() {
  switch (record_.op % kOpCount) {
    case kFlowCreate: create_flow(); break;
    case kFlowDestroy: destroy_flow(flow()); break;
    case kStep:
    case kRun: run_flow(); break;
    case kStart: start_flow(); break;
    case kWait: wait_for_flow(); break;
    case kPreview: preview(); break;
    case kKeepGrowth: keep_growth(); break;
    case kSetRadius:
    case kSetDensity:
    case kSetOptions: revise_flow(); break;
    case kSetVertices: set_vertices(); break;
    case kSetDirections: set_directions(); break;
    default: break;
  }
}

void World::call_getter() {
  switch (record_.op % kOpCount) {
    case kFlowStatistics: flow_statistics(); break;
    case kHistory: history(); break;
    case kPolylines: polylines(); break;
    case kNodes: nodes(); break;
    case kPointData: point_data(); break;
    case kGaps: gaps(); break;
    case kRoundCurve: round_curve(); break;
    case kFree: free_functions(); break;
    case kThreads: several_threads(); break;
    default: break;
  }
}

void World::call_cut() {
  switch (record_.op % kOpCount) {
    case kCut: cut_surface(); break;
    case kMapPixels: map_pixels(); break;
    default: break;
  }
}

void World::call_context() {
  switch (record_.op % kOpCount) {
    case kCancel:
      transcript_.line("meander_context_cancel(context);");
      meander_context_cancel(context_);
      cancelled_ = context_ != nullptr;
      break;
    case kReset:
      if (flows_[0].started || flows_[1].started) break;  // a call is using it
      transcript_.line("meander_context_reset(context);");
      meander_context_reset(context_);
      cancelled_ = false;
      break;
    case kContextDestroy:
      transcript_.line("meander_context_destroy(context);");
      transcript_.line("context = nullptr;");
      meander_context_destroy(context_);
      context_ = nullptr;
      cancelled_ = false;
      for (FlowSlot& slot : flows_) slot.cancellable = false;
      break;
    default: break;
  }
}

void World::check_sentence(meander_status status) {
  if (status < MEANDER_STATUS_OK || status > MEANDER_STATUS_INTERNAL) fail(transcript_, "a status that is none");
  const meander_error e = error_.value();
  const size_t size = error_.bytes().size();
  const bool whole = size >= sizeof(meander_error) && e.struct_size <= kLargestSize;
  if (status == MEANDER_STATUS_INTERNAL || status == MEANDER_STATUS_OUT_OF_MEMORY) {
    fail(transcript_, std::string("status ") + meander_status_name(status) + ": " + e.text);
  }
  if (has(kNoError) || !whole) return;
  if (status == MEANDER_STATUS_OK) {
    if (e.status != 0 || e.text[0] != 0) fail(transcript_, "a call that succeeds has written an error");
    return;
  }
  const size_t length = strnlen(e.text, sizeof e.text);
  const std::string text(e.text, length);
  if (e.status != status) fail(transcript_, "the error's status is another one than the call's");
  if (length == sizeof e.text) fail(transcript_, "a sentence without an end");
  if (length < 10 || text.back() != '.') fail(transcript_, "no sentence: " + text);
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < ' ') fail(transcript_, "a sentence of more than one line: " + text);
  }
  const bool quotes = text.find('\'') != text.npos;  // what the caller's text says
  if (!quotes && text.find(" nan") != text.npos && text.find("nan;") == text.npos && text.find("nan.") == text.npos) {
    fail(transcript_, "not a number in a sentence: " + text);
  }
  if (e.element_kind > MEANDER_ELEMENT_SEED_POINT) fail(transcript_, "an element of no kind");
}

/// Of calls that ask the context before they begin.
void World::check_refusal_of_cancelled(meander_status status) {
  if (status == MEANDER_STATUS_OK && cancelled_ && has(kContext) && context_) {
    fail(transcript_, "a call with a cancelled context has succeeded");
  }
}

bool World::spend(unsigned cost) {
  if (budget_ < cost) return false;
  budget_ -= cost;
  return true;
}

size_t World::room_for(size_t count) const {
  if (has(kNothingFits) || count == 0) return 0;
  return has(kShort) ? count - 1 : count;
}

Shown<meander_context*> World::context() {
  if (!has(kContext)) return {nullptr, "nullptr"};
  if (!context_) {
    transcript_.line("meander_context_create(&context, nullptr);");
    if (meander_context_create(&context_, nullptr) != MEANDER_STATUS_OK) fail(transcript_, "no context");
    cancelled_ = false;
  }
  return {context_, "context"};
}

Shown<meander_surface*> World::surface_handle() {
  if (has(kNoHandle)) return {nullptr, "nullptr"};
  return {surface().handle, has(kOther) ? "surfaces[1]" : "surfaces[0]"};
}

Shown<meander_flow*> World::flow_handle() {
  if (has(kNoHandle)) return {nullptr, "nullptr"};
  return {flow().handle, has(kOther) ? "flows[1]" : "flows[0]"};
}

World::Shape World::shape_of(std::vector<double> vertices, std::vector<uint32_t> faces) {
  Shape s;
  s.vertices = std::move(vertices);
  s.faces = std::move(faces);
  const size_t vertex_count = s.vertices.size() / 3, face_count = s.faces.size() / 3;
  double low[3], high[3];
  for (size_t c = 0; c < 3; ++c) {
    low[c] = std::numeric_limits<double>::max();
    high[c] = -low[c];
  }
  for (const uint32_t v : s.faces) {
    for (size_t c = 0; v < vertex_count && c < 3; ++c) {
      low[c] = std::min(low[c], s.vertices[3 * v + c]);
      high[c] = std::max(high[c], s.vertices[3 * v + c]);
    }
  }
  s.diagonal = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  s.extreme = !(s.diagonal > 1e-100 && s.diagonal < 1e100);
  for (size_t f = 0; f < face_count; ++f) {
    double e[2][3];
    for (size_t k = 0; k < 2; ++k) {
      for (size_t c = 0; c < 3; ++c) {
        const size_t a = s.faces[3 * f] % vertex_count, b = s.faces[3 * f + k + 1] % vertex_count;
        e[k][c] = s.vertices[3 * b + c] / s.diagonal - s.vertices[3 * a + c] / s.diagonal;
      }
    }
    s.relative_area += 0.5 * std::hypot(e[0][1] * e[1][2] - e[0][2] * e[1][1], e[0][2] * e[1][0] - e[0][0] * e[1][2],
                                        e[0][0] * e[1][1] - e[0][1] * e[1][0]);
  }
  std::set<std::array<uint32_t, 3>> different;
  for (size_t f = 0; f < face_count; ++f) {
    std::array<uint32_t, 3> corners{s.faces[3 * f], s.faces[3 * f + 1], s.faces[3 * f + 2]};
    std::sort(corners.begin(), corners.end());
    different.insert(corners);
  }
  s.plain = different.size() == face_count && !s.extreme;
  return s;
}

double World::radius_for(const Shape& shape) const {
  if (in_.relative_radius == 0) return in_.options.radius;
  return in_.relative_radius * std::sqrt(shape.relative_area) * shape.diagonal;
}

/// False for what the library should do, but would take long.
bool World::affordable(const Shape& shape, double radius, double segment_length) const {
  const double r = radius / shape.diagonal, h = segment_length > 0 ? segment_length / shape.diagonal : 0.2 * r;
  if (!(r > 0) || !(h > 0) || !std::isfinite(r) || 2 * r > 1) return true;  // is refused
  double density = 1;
  for (const double d : in_.density) {
    if (std::isfinite(d)) density = std::max(density, d);
  }
  const double nodes = shape.relative_area / r / h * density / 2.8, across = std::sqrt(density) / h;
  const double pieces = static_cast<double>(in_.points.size() / 3 + 2);
  return (nodes <= 80 && across * pieces <= 600) || nodes > 1e10;
}

/// Without meaning before a surface has been made: one for each vertex of its mesh.
size_t World::vertex_count_for(const Shape& shape) const {
  const size_t count = shape.vertices.size() / 3;
  return has(kShort) ? count + 1 : has(kNothingFits) ? 0 : count;
}

// ------------------------------------------------------------------------------------------------
// Functions on structs alone

void World::free_functions() {
  const uint32_t size = record_.b ? record_.b * 16u + record_.c % 16u : sizeof(meander_flow_options);
  std::vector<unsigned char> raw(size + 8, 0x77);
  void* memory = raw.data();
  const bool none = has(kNoHandle);
  meander_status status = 0;
  switch (record_.a % 12) {
    case 0: status = meander_error_init(none ? nullptr : static_cast<meander_error*>(memory), size); break;
    case 1: status = meander_seed_init(none ? nullptr : static_cast<meander_seed*>(memory), size); break;
    case 2:
      status = meander_flow_options_init(none ? nullptr : static_cast<meander_flow_options*>(memory), size,
                                         record_.d % 5u);
      break;
    case 3: status = meander_surface_options_init(none ? nullptr : static_cast<meander_surface_options*>(memory), size);
      break;
    case 4: status = meander_preview_init(none ? nullptr : static_cast<meander_preview*>(memory), size); break;
    case 5:
      status = meander_flow_statistics_init(none ? nullptr : static_cast<meander_flow_statistics*>(memory), size);
      break;
    case 6:
      status = meander_surface_statistics_init(none ? nullptr : static_cast<meander_surface_statistics*>(memory), size);
      break;
    case 10: status = meander_extent_init(none ? nullptr : static_cast<meander_extent*>(memory), size); break;
    case 11: status = meander_cost_init(none ? nullptr : static_cast<meander_cost*>(memory), size); break;
    case 7: {
      constexpr const char* kNames[] = {"meander_seed", "meander_error", "meander_flow_options", "", "meander_flow"};
      std::vector<size_t> layout(record_.c % 40u);
      const size_t count = meander_struct_layout(none ? nullptr : kNames[record_.d % 5], data_of(layout) ? layout.data()
                                                 : nullptr, layout.size());
      if (count > 60) fail(transcript_, "a struct of very many fields");
      return;
    }
    case 8: {
      meander_flow_options o = in_.options;
      if (in_.relative_radius != 0) o.radius = in_.relative_radius;
      auto options = made(kFlowOptionsStruct, o);
      size_t needed = 0;
      auto argument = sized(options, "sized_options", "options");
      if (none) argument = {nullptr, "nullptr"};
      const Shown<const meander_flow_options*> given_options{argument.value, argument.text};
      const auto warn = [&](Shown<char*> text, size_t room) {
        return call("meander_flow_options_get_warning", meander_flow_options_get_warning, given_options,
                    shown(size_t{record_.d} % 4), text, shown(room), out(needed, "count"));
      };
      if (warn({nullptr, "nullptr"}, 0) != MEANDER_STATUS_OK) return;
      const size_t room = has(kShort) ? needed / 2 : needed;
      Outputs outputs(transcript_);
      const auto text = outputs.array<char>("text", room, missing(0));
      if (warn(text, room) == MEANDER_STATUS_OK && room > 0 && text.value && strnlen(text.value, room) >= room) {
        fail(transcript_, "a warning without an end");
      }
      return;
    }
    default:
      if (!meander_status_name(static_cast<int8_t>(record_.b))[0]) fail(transcript_, "a status without a name");
      if (!meander_version()[0] || meander_abi_version() != MEANDER_ABI_VERSION) fail(transcript_, "no version");
      if (!(meander_context_progress(context_) >= 0 && meander_context_progress(context_) <= 1)) {
        fail(transcript_, "progress outside of [0, 1]");
      }
      if (meander_context_phase(context_) > MEANDER_PHASE_POLISH) fail(transcript_, "no phase");
      return;
  }
  const size_t written = status == MEANDER_STATUS_OK ? size : 0;
  if (std::any_of(raw.begin() + static_cast<std::ptrdiff_t>(written), raw.end(), [](auto x) { return x != 0x77; })) {
    fail(transcript_, "_init has written beyond the size that it was given");
  }
}

}  // namespace meander::fuzz
