// SPDX-License-Identifier: GPL-3.0-or-later
//
// Flows: their life, what changes them, and runs on threads.
#include <algorithm>
#include <thread>

#include "watched_run.h"
#include "world.h"
#include "world_call.h"

namespace meander::fuzz {
namespace {

constexpr uint32_t kMostIterations = 12;  // of one flow

sweep::Mesh mesh_of(const std::vector<double>& vertices, const std::vector<uint32_t>& faces) {
  sweep::Mesh mesh;
  for (size_t v = 0; v < vertices.size() / 3; ++v) {
    mesh.vertices.push_back({vertices[3 * v], vertices[3 * v + 1], vertices[3 * v + 2]});
  }
  for (size_t f = 0; f < faces.size() / 3; ++f) {
    mesh.faces.push_back({faces[3 * f], faces[3 * f + 1], faces[3 * f + 2]});
  }
  return mesh;
}

}  // namespace

Sized<meander_flow_options> World::options_for(const Shape& shape) {
  meander_flow_options o = in_.options;
  o.radius = radius_for(shape);
  if (in_.relative_radius != 0) transcript_.line("options.radius = " + written(o.radius) + ";");
  return made(kFlowOptionsStruct, o);
}

Sized<meander_seed> World::seed_struct() {
  meander_seed s = in_.seed;
  s.point_count = in_.points.size() / 3;
  s.strand_count = in_.closed.size();
  const auto is_missing = [&](unsigned bit) { return (in_.missing_seed_arrays >> bit & 1) != 0; };
  s.points = is_missing(0) ? nullptr : data_of(in_.points);
  s.offsets = is_missing(1) ? nullptr : data_of(in_.offsets);
  s.closed = is_missing(2) ? nullptr : data_of(in_.closed);
  s.fixed = is_missing(3) ? nullptr : data_of(in_.fixed);
  s.guides = is_missing(4) ? nullptr : data_of(in_.guides);
  if (transcript_.open()) {
    transcript_.line("seed.point_count = points.size() / 3;");
    transcript_.line("seed.strand_count = closed.size();");
    const char* names[] = {"points", "offsets", "closed", "fixed", "guides"};
    const bool empty[] = {!s.points, !s.offsets, !s.closed, !s.fixed, !s.guides};
    for (unsigned k = 0; k < 5; ++k) {
      transcript_.line(std::string("seed.") + names[k] + " = " +
                       (empty[k] ? "nullptr" : std::string(names[k]) + ".data()") + ";");
    }
  }
  return made(kSeedStruct, s);
}

void World::destroy_flow(FlowSlot& slot) {
  if (slot.handle) {
    const std::string name = &slot == &flows_[0] ? "flows[0]" : "flows[1]";
    transcript_.line("meander_flow_destroy(" + name + ");");
    transcript_.line(name + " = nullptr;");
  }
  meander_flow_destroy(slot.handle);
  slot = {};
}

void World::begin_checks(FlowSlot& slot) {
  slot.checker.reset();
  if (!slot.shape.plain || slot.started) return;
  slot.checker.emplace(mesh_of(slot.shape.vertices, slot.shape.faces));
  try {
    slot.checker->begin(sweep::state_of(slot.handle));
  } catch (const sweep::Refusal& refusal) {
    fail(transcript_, "the curve cannot be read: " + refusal.sentence);
  }
  after_change(slot, MEANDER_STATUS_OK, false);
}

/// Looks at the curve after a call that may have changed it.
void World::after_change(FlowSlot& slot, meander_status status, bool stepped) {
  if (status == MEANDER_STATUS_OK) slot.moved_on = !stepped;
  if (!slot.handle || slot.started || !slot.checker) return;
  try {
    sweep::CurveState state = sweep::state_of(slot.handle);
    if (slot.moved_on) state.length.reset();  // that of the last iteration, not of the present curve
    // Guides are cut into other segments where the spacing or the surface changes; their nodes count as fixed.
    if (!stepped && std::find(state.guides.begin(), state.guides.end(), 1) != state.guides.end()) {
      slot.checker->begin(state);
    }
    const std::vector<sweep::Finding> findings = slot.checker->check(state);
    if (!findings.empty()) {
      fail(transcript_, std::string("the curve is wrong: ") + sweep::name_of(findings[0].fault) + ": " +
                            findings[0].text);
    }
  } catch (const sweep::Refusal& refusal) {
    fail(transcript_, "the curve cannot be read: " + refusal.sentence);
  }
}

void World::create_flow() {
  SurfaceSlot& on = surfaces_[has(kOther) && surfaces_[1].handle ? 1 : 0];
  FlowSlot& slot = flow();
  if (!affordable(on.shape, radius_for(on.shape), in_.options.segment_length) || !spend(5)) return;
  auto given_options = options_for(on.shape);
  auto options = sized(given_options, "sized_options", "options");
  if (missing(0)) options = {nullptr, "nullptr"};
  auto given_seed = seed_struct();
  auto seed = sized(given_seed, "sized_seed", "seed");
  if (!in_.has_seed) seed = {nullptr, "nullptr"};
  auto density = given(in_.density, "density");
  if (missing(1)) density = {nullptr, "nullptr"};
  const Shown<const meander_surface*> surface{has(kNoHandle) ? nullptr : on.handle,
                                              has(kNoHandle)         ? "nullptr"
                                              : &on == &surfaces_[0] ? "surfaces[0]"
                                                                     : "surfaces[1]"};
  destroy_flow(slot);
  meander_flow* handle = nullptr;
  const meander_status status =
      call("meander_flow_create", meander_flow_create, surface, Shown<const meander_seed*>{seed.value, seed.text},
           density, shown(in_.density.size()), Shown<const meander_flow_options*>{options.value, options.text},
           has(kNoCount) ? Shown<meander_flow**>{nullptr, "nullptr"}
                         : Shown<meander_flow**>{&handle, has(kOther) ? "&flows[1]" : "&flows[0]"},
           context());
  check_refusal_of_cancelled(status);
  if ((status == MEANDER_STATUS_OK) != (handle != nullptr)) fail(transcript_, "a flow without success");
  if (!handle) return;
  slot.handle = handle;
  slot.shape = on.shape;
  slot.options = in_.options;
  slot.options.radius = radius_for(on.shape);
  begin_checks(slot);
}

void World::run_flow() {
  FlowSlot& slot = flow();
  const uint32_t limit = slot.options.iteration_limit;
  // A run that may be long is one step, and so is one of a flow that was started, which is refused.
  const bool run = record_.op % kOpCount == kRun && limit <= kMostIterations;
  if (slot.taken + (run ? limit : 1) > 2 * kMostIterations || !spend(run ? 6 : 3)) return;
  const auto handle = flow_handle();
  const auto ctx = context();
  std::thread canceller;
  if (run && record_.a % 4 == 3 && ctx.value) {
    transcript_.line("// meanwhile another thread cancels the context");
    canceller = std::thread([c = ctx.value] {
      for (int k = 0; k < 50; ++k) {
        if (meander_context_progress(c) > 1 || meander_context_phase(c) > MEANDER_PHASE_POLISH) std::abort();
      }
      meander_context_cancel(c);
    });
  }
  const bool whole = slot.handle && !slot.started && handle.value;
  const bool was_cancelled = cancelled_ || has(kBefore);
  const meander_status status = run ? call("meander_flow_run", meander_flow_run, handle, ctx)
                                    : call("meander_flow_step", meander_flow_step, handle, ctx);
  if (canceller.joinable()) {
    canceller.join();
    cancelled_ = true;
  }
  const bool may_be_cancelled = ctx.value && (was_cancelled || cancelled_);
  if (status == MEANDER_STATUS_CANCELLED && !may_be_cancelled) fail(transcript_, "cancelled by nobody");
  if (whole && status == MEANDER_STATUS_OK) slot.taken += run ? limit : 1;
  if (whole && status != MEANDER_STATUS_OK && status != MEANDER_STATUS_CANCELLED) {
    fail(transcript_, "an iteration was refused");
  }
  if (meander_flow_stop_reason(handle.value) > MEANDER_STOP_REASON_CANCELLED) fail(transcript_, "no stop reason");
  // A cancelled run may have kept some iterations.
  after_change(slot, status, status == MEANDER_STATUS_OK);
}

void World::start_flow() {
  FlowSlot& slot = flow();
  const bool endless = slot.options.iteration_limit > kMostIterations;
  if (slot.taken > kMostIterations || (endless && !has(kContext)) || !spend(8)) return;
  const bool was_started = slot.started;
  const auto ctx = context();
  const auto handle = flow_handle();
  const meander_status status = call("meander_flow_start", meander_flow_start, handle, ctx);
  if (was_started && status == MEANDER_STATUS_OK) fail(transcript_, "a flow was started twice");
  if (status != MEANDER_STATUS_OK) return;
  slot.started = true;
  slot.cancellable = ctx.value != nullptr;
  slot.taken += std::min(slot.options.iteration_limit, kMostIterations);
}

void World::wait_for_flow() {
  FlowSlot& slot = flow();
  const auto handle = flow_handle();
  if (slot.started && slot.options.iteration_limit > kMostIterations) {
    if (!slot.cancellable) {  // it would take long
      destroy_flow(slot);
      return;
    }
    transcript_.line("meander_context_cancel(context);");
    meander_context_cancel(context_);
    cancelled_ = true;
  }
  const bool was_started = slot.started;
  const uint32_t running = meander_flow_is_running(handle.value);
  if (running > 1 || (running && !was_started)) fail(transcript_, "running without a start");
  const meander_status status = call("meander_flow_wait", meander_flow_wait, handle);
  if (!handle.value) return;
  if (!was_started) {
    if (status == MEANDER_STATUS_OK) fail(transcript_, "waited for what was never started");
    return;
  }
  slot.started = false;
  if (status != MEANDER_STATUS_OK && status != MEANDER_STATUS_CANCELLED) fail(transcript_, "a run was refused");
  after_change(slot, status, status == MEANDER_STATUS_OK);
}

void World::preview() {
  if (!spend(1)) return;
  const auto handle = flow_handle();
  Filled<meander_preview> preview(transcript_, "meander_preview", "preview", missing(4), missing(0));
  const meander_status status =
      call("meander_flow_take_preview", meander_flow_take_preview, handle, preview.shown());
  if (!preview.check(status)) return;
  preview.numbers(preview->positions, 3 * preview->point_count);
  preview.offsets(preview->offsets, preview->strand_count, preview->point_count);
}

void World::keep_growth() {
  const FlowSlot& slot = flow();
  const double step = record_.b ? hostile(record_.b) : slot.options.radius * record_.a;
  call("meander_flow_keep_growth", meander_flow_keep_growth, flow_handle(), shown(step),
       shown(size_t{record_.c} * record_.c));
}

void World::revise_flow() {
  FlowSlot& slot = flow();
  const auto handle = flow_handle();
  const double old_radius = slot.options.radius;
  if (slot.started || !handle.value || !slot.handle) {
    call("meander_flow_set_radius", meander_flow_set_radius, handle, shown(1.0));
    return;
  }
  if (!spend(6)) return;
  meander_status status = MEANDER_STATUS_OK;
  if (record_.op % kOpCount == kSetRadius) {
    const double radius = record_.b ? hostile(record_.b) : old_radius * (0.5 + record_.a / 170.0);
    const double segment = slot.options.segment_length * (radius / old_radius);
    if (!affordable(slot.shape, radius, segment)) return;
    status = call("meander_flow_set_radius", meander_flow_set_radius, handle, shown(radius));
    if (status == MEANDER_STATUS_OK) {
      slot.options.radius = radius;
      slot.options.segment_length = segment;
    }
  } else if (record_.op % kOpCount == kSetDensity) {
    if (!affordable(slot.shape, old_radius, slot.options.segment_length)) return;
    status = call("meander_flow_set_density", meander_flow_set_density, handle, given(in_.density, "density"),
                  shown(in_.density.size()));
  } else {
    if (!affordable(slot.shape, radius_for(slot.shape), in_.options.segment_length)) return;
    auto given_options = options_for(slot.shape);
    auto options = sized(given_options, "sized_options", "options");
    if (missing(0)) options = {nullptr, "nullptr"};
    status = call("meander_flow_set_options", meander_flow_set_options, handle,
                  Shown<const meander_flow_options*>{options.value, options.text});
    if (status == MEANDER_STATUS_OK) {
      const double radius = radius_for(slot.shape);
      slot.options = in_.options;
      slot.options.radius = radius;
    }
  }
  after_change(slot, status, false);
}

void World::set_vertices() {
  FlowSlot& slot = flow();
  if (!spend(5)) return;
  const auto handle = flow_handle();
  std::vector<double> moved = slot.shape.vertices;
  Noise noise(record_.a);
  const double reach = slot.shape.diagonal * std::ldexp(1.0, -(record_.b % 32));
  const double factor = record_.c == 0 ? 1 : record_.c < 100 ? 0.7 + record_.c / 200.0 : record_.c < 110 ? 0 : 1;
  for (double& x : moved) x = factor * (x + (noise.share() - 0.5) * (record_.b ? reach : 0));
  if (record_.c >= 200 && !moved.empty()) moved[record_.d % moved.size()] = hostile(record_.d);
  if (has(kShort)) moved.resize(moved.size() + 3);
  Shape shape = slot.shape;
  if (slot.handle && moved.size() == shape.vertices.size()) {
    shape = shape_of(moved, slot.shape.faces);
    shape.plain = shape.plain && slot.shape.plain;
    if (!affordable(shape, slot.options.radius, slot.options.segment_length)) return;
  }
  if (transcript_.open()) transcript_.line("std::vector<double> moved = " + written(moved) + ";");
  const meander_status status =
      call("meander_flow_set_vertices", meander_flow_set_vertices, handle,
           missing(0) ? Shown<const double*>{nullptr, "nullptr"} : given(moved, "moved"), shown(moved.size() / 3),
           context());
  check_refusal_of_cancelled(status);
  if (status == MEANDER_STATUS_OK) {
    slot.shape = shape;
    slot.moved_on = true;
    begin_checks(slot);
  } else {
    after_change(slot, status, false);
  }
}

void World::set_directions() {
  FlowSlot& slot = flow();
  const auto handle = flow_handle();
  std::vector<double> directions(3 * vertex_count_for(slot.shape));
  Noise noise(record_.a);
  for (double& x : directions) x = record_.b % 4 == 1 ? 0 : noise.share() - 0.5;
  if (record_.b % 4 == 2 && !directions.empty()) directions[record_.c % directions.size()] = hostile(record_.c);
  if (record_.b % 4 == 3) {
    for (double& x : directions) x *= hostile(record_.c);
  }
  if (transcript_.open()) transcript_.line("std::vector<double> directions = " + written(directions) + ";");
  const meander_status status =
      call("meander_flow_set_directions", meander_flow_set_directions, handle,
           missing(0) ? Shown<const double*>{nullptr, "nullptr"} : given(directions, "directions"),
           shown(directions.size() / 3), shown(uint32_t{record_.d % 3u}));
  after_change(slot, status, false);
}

/// Flows with the same inputs on several threads, on one surface; all are to give the same curve.
void World::several_threads() {
  SurfaceSlot& on = surface();
  if (!on.handle || in_.options.threads > 4 || in_.options.threads == 0 || !spend(25)) return;
  if (!affordable(on.shape, radius_for(on.shape), in_.options.segment_length)) return;
  auto options = options_for(on.shape);
  auto seed = seed_struct();
  const bool seeded = in_.has_seed;
  const int steps = 1 + record_.a % 3;
  transcript_.line("// " + std::to_string(steps) + " steps of flows on 3 threads at once, not written down");
  constexpr size_t kThreads = 3;
  meander_status statuses[kThreads] = {};
  uint64_t digests[kThreads] = {};
  bool readable[kThreads] = {true, true, true};
  std::vector<std::thread> threads;
  for (size_t t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      auto own_options = options;
      // Of a struct that is cut short there is no such field.
      const bool whole = own_options.bytes().size() >= sizeof(meander_flow_options);
      if (whole) own_options.data()->threads = 1 + static_cast<uint32_t>(t) % 2;
      meander_flow* flow = nullptr;
      statuses[t] = meander_flow_create(on.handle, seeded ? seed.data() : nullptr, nullptr, 0, own_options.data(),
                                        &flow, nullptr, nullptr);
      for (int k = 0; k < steps && flow && statuses[t] == MEANDER_STATUS_OK; ++k) {
        statuses[t] = meander_flow_step(flow, nullptr, nullptr);
      }
      try {
        if (flow) digests[t] = sweep::digest_of(sweep::state_of(flow));
      } catch (const sweep::Refusal&) {
        readable[t] = false;
      }
      meander_flow_destroy(flow);
    });
  }
  for (std::thread& t : threads) t.join();
  for (size_t t = 0; t < kThreads; ++t) {
    if (!readable[t] || statuses[t] == MEANDER_STATUS_INTERNAL) fail(transcript_, "a flow failed on a thread");
    if (statuses[t] != statuses[0] || digests[t] != digests[0]) fail(transcript_, "another curve on another thread");
  }
}

void World::finish() {
  record_ = {};
  for (size_t k = 0; k < 2; ++k) {
    FlowSlot& slot = flows_[k];
    if (!slot.handle) continue;
    record_.flags = k ? kOther : 0;
    transcript_.line("{");
    if (slot.started) wait_for_flow();
    if (slot.handle) {
      // Whatever was refused, it can go on.
      const meander_status status = call("meander_flow_step", meander_flow_step, flow_handle(), context());
      if (status != MEANDER_STATUS_OK) fail(transcript_, "a flow cannot go on");
      after_change(slot, status, true);
    }
    transcript_.line("}");
  }
}

}  // namespace meander::fuzz
