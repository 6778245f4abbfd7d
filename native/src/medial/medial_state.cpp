// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/medial_state.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "medial/constants.h"

namespace meander {
namespace {

void find_radii(const MedialScene& scene, const NodeData<MeasuredBalls>* balls, ThreadPool& pool, MedialState& state) {
  state.measured.clear();
  if (!scene.patches) {
    compute_medial_axis(state.frames, scene.boundary, scene.rules.boundary, state.reach, pool, state.tree,
                        state.radii);
  } else {
    compute_geodesic_medial_axis(scene.surface, *scene.patches, scene.curve, state.frames, scene.boundary,
                                 scene.rules.boundary, scene.rules.plan.measure, scene.metric, state.reach, pool,
                                 state.tree, state.radii, {balls, balls ? &state.measured : nullptr});
  }
}

}  // namespace

void find_medial_state(const MedialScene& scene, const AtRest& known, const NodeData<Radii>& radii, ThreadPool& pool,
                       MedialState& state) {
  compute_frames(scene.surface, scene.curve, scene.metric, scene.radius, pool, state.frames,
                 known.directions && !known.directions->empty() ? known.directions : nullptr);
  const MedialRules& rules = scene.rules;
  const ReachScene reach{scene.surface,  scene.curve,   state.frames, scene.boundary,
                         rules.boundary, scene.patches, scene.metric, rules.plan};
  state.radii = radii;
  compute_reach(reach, state.radii, pool, state.reach);
  find_radii(scene, known.balls, pool, state);
  state.tree.hand_on();
  complete_reach(reach, pool, state.reach, state.radii);
  state.felt_radii.resize(state.radii.size());
  pool.for_each(state.radii.size(), kNodeGrain, [&](uint32_t i) {
    for (size_t side = 0; side < 2; ++side) {
      const double driving = std::max(0.0, state.reach[i][side].driving);
      state.felt_radii[i][side] =
          in_local_radii(state.frames, scene.metric, i, side, std::min(state.radii[i][side], driving));
    }
  });
}

void MedialState::hand_on() noexcept {
  frames.hand_on();
  tree.hand_on();
  meander::hand_on(reach, radii, felt_radii, measured);
}

double in_local_radii(const Frames& frames, const LocalMetric& metric, size_t node, size_t side, double radius) {
  const double growth = std::clamp(2 * frames.radius_slope[node][side] * radius / metric.radius[node],
                                   kLeastRadiusGrowth, kMostRadiusGrowth);
  return growth == 0 ? radius : radius * (elementary::log1p(growth) / growth);
}

}  // namespace meander
