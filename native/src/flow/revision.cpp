// SPDX-License-Identifier: GPL-3.0-or-later
//
// Another spacing, another density, other weights: the flow goes on from where it is.
#include <cmath>
#include <utility>

#include "base/elementary.h"
#include "flow/flow.h"
#include "flow/free_nodes.h"

namespace meander {
namespace {

/// How much r changes along the curve: the mean of the logarithm of its factor, without its sign.
double mean_change(const FlowState& before, const FlowState& next, ThreadPool& pool) {
  const Curve& curve = before.curve;
  const Surface& surface = *before.domain.surface;
  const double sum = sum_over_free(curve, pool, [&](uint32_t i) {
    const SurfacePoint& p = curve.nodes[i];
    const double ratio = next.domain.wanted_radius.at(surface, p) / before.domain.wanted_radius.at(surface, p);
    return std::abs(elementary::log(ratio));
  });
  return sum / std::max(1.0, free_nodes(curve, pool));
}

/// Whether growth would make another curve, whatever its spacing. A polish forgets these weights; it has its own.
bool grows_otherwise(const FlowSettings& a, const FlowSettings& b) {
  return a.length_weight != b.length_weight || a.bending_weight != b.bending_weight ||
         a.medial_weight != b.medial_weight || a.alignment_weight != b.alignment_weight ||
         a.length_power != b.length_power || a.medial_power != b.medial_power ||
         a.medial_axis != b.medial_axis || a.boundary_rule != b.boundary_rule ||
         a.boundary_distance != b.boundary_distance || a.grow_into_empty != b.grow_into_empty ||
         a.hold_ends != b.hold_ends || a.roughness != b.roughness ||
         a.hairpin_removal_iterations != b.hairpin_removal_iterations ||
         a.hairpin_removal_gentleness != b.hairpin_removal_gentleness;
}

/// Of the settings asked for, what only the beginning has needed is as it was.
void keep_what_is_past(const FlowSettings& before, bool began_full, FlowSettings& settings) {
  settings.full_start = before.full_start;
  settings.widen_loops = before.widen_loops;
  settings.variation = before.variation;
  settings.start_spacing_factor = before.start_spacing_factor;
  settings.threads = before.threads;
  if (began_full) settings.hairpin_removal_iterations = before.hairpin_removal_iterations;
}

}  // namespace

void Flow::revise(FlowSettings settings, const VertexData<double>* density, const CancelToken& cancel) {
  ThreadPool pool = pool_.with(cancel);
  keep_what_is_past(state_.settings, convergence_.began_full(), settings);
  FlowState next{{}, settings, state_.domain.revised(state_.settings, settings, density, pool), state_.start};
  if (settings == state_.settings && next.domain.wanted_radius == state_.domain.wanted_radius) return;
  next.curve = state_.curve;
  next.domain.set_radius(approach_.factor(), next.curve, settings);
  next.nodes.radii = state_.nodes.radii;
  MoveSeconds seconds = record_.seconds.move;
  if (next.domain.surface != state_.domain.surface) {
    measure_segments(*next.domain.surface, next.curve, pool);
    work_.retraction.straighten(*next.domain.surface, next.curve, work_.spare.curve, pool, seconds);
  }
  Convergence convergence = convergence_.revised(settings, mean_change(state_, next, pool),
                                                 grows_otherwise(state_.settings, settings));
  if (grows_in(convergence.phase())) next.domain.correct(1);
  go_on_from(std::move(next), std::move(convergence), 1, seconds, pool);
}

}  // namespace meander
