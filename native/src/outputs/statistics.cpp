// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/statistics.h"

#include <algorithm>
#include <limits>

#include "curve/crossings.h"
#include "flow/weighting.h"
#include "model/energy.h"
#include "outputs/constants.h"

namespace meander {
namespace {

void count_strands(const Flow& flow, Statistics& figures) {
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

std::vector<double> spacing_of(const Flow::Present& present) {
  const auto& [state, medial, plan, factor, pool, crossings] = present;
  const double nominal = 2 * state.settings.radius * factor;
  const Surface& surface = *state.domain.surface;
  const RadiusField judged = state.domain.judged_radius();
  std::vector<double> spacing;
  spacing.reserve(2 * state.curve.size());
  for (uint32_t i = 0; i < state.curve.size(); ++i) {
    if (state.curve.on_guide(i)) continue;
    for (size_t side = 0; side < 2; ++side) {
      const double radius = in_local_radii(medial.frames, state.metric, i, side, medial.radii[i][side]);
      spacing.push_back(nominal * radius / judged.at(surface, state.curve.nodes[i]));
    }
  }
  std::ranges::sort(spacing);
  return spacing;
}

double energy_of(const Flow::Present& present) {
  const auto& [state, medial, plan, factor, pool, crossings] = present;
  StrandSolver strands;
  Weights weights;
  choose_weights(plan, state, medial, strands, pool, weights);
  return energy(state.curve, medial.felt_radii, state.metric, weights, pool);
}

}  // namespace

double Statistics::spacing_percentile(double share) const {
  if (spacing.empty()) return 0;
  return spacing[static_cast<size_t>(share * static_cast<double>(spacing.size() - 1))];
}

double Statistics::evenness(double wanted) const {
  if (spacing.empty()) return 0;
  const auto first = std::ranges::lower_bound(spacing, (1 - kEvenWithin) * wanted);
  const auto last = std::ranges::upper_bound(spacing, (1 + kEvenWithin) * wanted);
  return first < last ? static_cast<double>(last - first) / static_cast<double>(spacing.size()) : 0;
}

Statistics statistics_of(Flow& flow, const CancelToken& cancel) {
  return flow.ask([&](const Flow::Present& present) { return statistics_of(flow, present); }, cancel);
}

Statistics statistics_of(const Flow& flow, const Flow::Present& present) {
  Statistics figures;
  count_strands(flow, figures);
  figures.small_components = small_components(flow.surface(), 2 * flow.settings().radius);
  figures.length = flow.length();
  figures.energy = energy_of(present);
  figures.spacing = spacing_of(present);
  figures.crossings = present.crossings.find(*present.state.domain.surface, present.state.curve, present.pool).size();
  return figures;
}

}  // namespace meander
