// SPDX-License-Identifier: GPL-3.0-or-later
//
// The figures of a flow, and its history.
#include <algorithm>
#include <cstring>
#include <limits>

#include "api/structs.h"

using namespace meander;

namespace {

/// How far the spacing may be from what is wanted and still be even, as a share of that.
constexpr double kEvenWithin = 0.2;

void count_strands(const Flow& flow, meander_flow_statistics& figures) {
  const Curve& curve = flow.curve();
  std::vector<uint8_t> grown(flow.surface().component_count(), 0);
  figures.strands = static_cast<uint32_t>(curve.strands.size());
  for (const Strand& s : curve.strands) {
    figures.closed_strands += s.closed;
    figures.guides += s.guide;
    if (!s.guide) grown[flow.surface().component(curve.nodes[s.first].face)] = 1;
  }
  figures.empty_components = static_cast<uint32_t>(std::ranges::count(grown, 0));
}

/// Components that are smaller than the spacing: the curve has no room on them.
uint32_t small_components(const Surface& surface, double spacing) {
  const Vec3 infinite = Vec3::Constant(std::numeric_limits<double>::infinity());
  std::vector<Vec3> low(surface.component_count(), infinite), high(surface.component_count(), -infinite);
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    const uint32_t part = surface.component(f);
    for (const uint32_t v : surface.face(f)) {
      low[part] = low[part].cwiseMin(surface.position(v));
      high[part] = high[part].cwiseMax(surface.position(v));
    }
  }
  uint32_t small = 0;
  for (size_t part = 0; part < low.size(); ++part) small += (high[part] - low[part]).norm() < spacing;
  return small;
}

double percentile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return 0;
  return sorted[static_cast<size_t>(share * static_cast<double>(sorted.size() - 1))];
}

/// The share of the values that are within `tolerance` times `wanted` of it.
double share_within(const std::vector<double>& sorted, double wanted, double tolerance) {
  if (sorted.empty()) return 0;
  const auto first = std::ranges::lower_bound(sorted, (1 - tolerance) * wanted);
  const auto last = std::ranges::upper_bound(sorted, (1 + tolerance) * wanted);
  return first < last ? static_cast<double>(last - first) / static_cast<double>(sorted.size()) : 0;
}

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

meander_flow_statistics statistics_of(const meander_flow& handle) {
  Flow& flow = *handle.flow;
  const double scale = flow.surface().scale();
  const Flow::Measure m = flow.measure();
  meander_flow_statistics figures{};
  figures.stop_reason = meander_flow_stop_reason(&handle);
  figures.iterations = static_cast<uint32_t>(flow.history().size());
  figures.nodes = flow.curve().size();
  figures.crossings = static_cast<uint32_t>(std::min<size_t>(m.crossings, UINT32_MAX));
  figures.polishing = flow.polishing();
  count_strands(flow, figures);
  figures.small_components = small_components(flow.surface(), 2 * flow.settings().radius);
  figures.length = m.length * scale;
  figures.energy = m.energy * scale;
  figures.mean_step = flow.history().empty() ? 0 : flow.history().back().mean_step * scale;
  figures.spacing_target = 2 * flow.settings().radius * scale;
  figures.spacing_p05 = percentile(m.spacing, 0.05) * scale;
  figures.spacing_median = percentile(m.spacing, 0.5) * scale;
  figures.spacing_p95 = percentile(m.spacing, 0.95) * scale;
  figures.evenness = share_within(m.spacing, 2 * flow.settings().radius, kEvenWithin);
  figures.roughness = static_cast<float>(flow.roughness().mean);
  figures.smoothing = static_cast<float>(flow.roughness().smoothing);
  figures.stretch = static_cast<float>(flow.roughness().stretch);
  add_seconds(flow.seconds(), figures);
  add_fit(flow, figures);
  return figures;
}

}  // namespace

meander_status meander_flow_compute_statistics(meander_flow* flow, meander_flow_statistics* statistics,
                                               meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require_struct(statistics);
    check_cancelled(context);
    const std::function<bool()> asked = question(context);
    const auto watch = flow->flow->watch(asked);
    const meander_flow_statistics figures = statistics_of(*flow);
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
