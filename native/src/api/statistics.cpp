// SPDX-License-Identifier: GPL-3.0-or-later
//
// The figures of a flow, and its history.
#include <algorithm>
#include <cstring>

#include "api/found.h"
#include "api/guard.h"

using namespace meander;

namespace {

void add_seconds(const FlowSeconds& seconds, meander_flow_statistics& figures) {
  figures.seconds_total = seconds.total;
  figures.seconds_medial_axis = seconds.medial_axis;
  figures.seconds_solve = seconds.solve;
  figures.seconds_retract = seconds.move.retract;
  figures.seconds_reconnect = seconds.move.reconnect;
  figures.seconds_crossings = seconds.move.crossings;
  figures.seconds_refine = seconds.refine;
}

void add_fit(const Flow& flow, meander_flow_statistics& figures) {
  const SeedFit& fit = flow.seed_fit();
  const double scale = flow.surface().scale();
  figures.seed_distance = fit.distance * scale;
  figures.seed_point = fit.point;
  figures.seed_jumps = fit.jumps;
  figures.seed_jump_length = fit.jump_length * scale;
  figures.seed_jump_point = fit.jump_from;
  figures.seed_jump_point2 = fit.jump_to;
}

void add_start(const StartReport& start, meander_flow_statistics& figures) {
  figures.start_asked_full = start.full_asked;
  figures.start_full_parts = start.full_parts();
  figures.start_grown_parts = start.grown_parts();
  figures.start_no_room_parts = start.count(StrandStart::kNoRoom);
  figures.start_crossing_parts = start.count(StrandStart::kCrossings);
  figures.completed_parts = start.completed;
}

}  // namespace

meander_flow_statistics meander::ready_statistics(const meander_flow& handle, const Statistics& s) {
  const Flow& flow = *handle.flow;
  const double scale = flow.surface().scale();
  meander_flow_statistics figures{};
  figures.stop_reason = stop_reason_of(flow);
  figures.iterations = static_cast<uint32_t>(flow.history().size());
  figures.nodes = flow.curve().size();
  figures.crossings = static_cast<uint32_t>(std::min<size_t>(s.crossings, UINT32_MAX));
  figures.polishing = flow.polishing();
  figures.strands = s.strands;
  figures.closed_strands = s.closed_strands;
  figures.guides = s.guides;
  figures.empty_components = s.empty_components;
  figures.small_components = s.small_components;
  figures.length = s.length * scale;
  figures.energy = s.energy * scale;
  figures.mean_step = flow.history().empty() ? 0 : flow.history().back().mean_step * scale;
  figures.spacing_target = 2 * flow.settings().radius * scale;
  figures.spacing_p05 = s.spacing_percentile(0.05) * scale;
  figures.spacing_median = s.spacing_percentile(0.5) * scale;
  figures.spacing_p95 = s.spacing_percentile(0.95) * scale;
  figures.evenness = s.evenness(2 * flow.settings().radius);
  figures.roughness = static_cast<float>(flow.roughness().mean);
  figures.smoothing = static_cast<float>(flow.roughness().smoothing);
  figures.stretch = static_cast<float>(flow.roughness().stretch);
  add_seconds(flow.seconds(), figures);
  add_fit(flow, figures);
  add_start(flow.start(), figures);
  return figures;
}

meander_status meander_flow_compute_statistics(meander_flow* flow, meander_flow_statistics* statistics,
                                               meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require_struct(statistics);
    check_cancelled(context);
    const meander_flow_statistics figures = ready_statistics(*flow, statistics_of(*flow->flow, cancel_of(context)));
    check_cancelled(context);
    write_struct(statistics, figures);
  });
}

meander_status meander_flow_get_history(const meander_flow* flow, meander_iteration* records, size_t record_size,
                                        size_t capacity, size_t* count, meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require(count != nullptr, "The pointer for the count is NULL.");
    constexpr size_t kSmallest = offsetof(meander_iteration, seconds) + sizeof(meander_iteration::seconds);
    require(record_size >= kSmallest && record_size <= kLargestStruct,
            "The size of a record is none that meander_iteration has; pass sizeof(meander_iteration).");
    const auto& history = flow->flow->history();
    const double scale = flow->flow->surface().scale();
    const bool fits = history.size() <= capacity;
    if (fits) require(records != nullptr || history.empty(), "The array for the records is NULL.");
    *count = history.size();
    if (!fits) return;
    auto* place = reinterpret_cast<unsigned char*>(records);
    for (size_t i = 0; i < history.size(); ++i, place += record_size) {
      const IterationRecord& h = history[i];
      const meander_iteration record{static_cast<uint32_t>(i + 1), h.nodes,          h.length * scale,
                                     h.mean_step * scale,          h.energy * scale, h.seconds};
      const size_t known = std::min(record_size, sizeof record);
      std::memcpy(place, &record, known);
      std::memset(place + known, 0, record_size - known);
    }
  });
}
