// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/plan.h"

#include <limits>

#include "base/tuning.h"

namespace meander {
namespace {

/// What moves slowly but for long, as fingers that are drawn in and others that follow, arrives sooner if it does not
/// begin anew in every iteration (the heavy ball of Polyak).
double momentum_in(Phase phase) {
  switch (phase) {
    case Phase::kHairpinRemoval: return tuning::kHairpinRemovalMomentum;
    case Phase::kPolishing: return tuning::kPolishMomentum;
    default: return 0;
  }
}

}  // namespace

Plan plan_iteration(const FlowSettings& settings, Phase phase) {
  const bool coarse = settings.polish && phase <= Phase::kPolishing;
  Plan plan;
  plan.phase = phase;
  plan.polishing = settings.polish && phase != Phase::kGrowing;
  plan.segment_length = settings.segment_length * (coarse ? settings.growth_coarsening : 1);
  plan.momentum = settings.polish ? momentum_in(phase) : 0;
  plan.longest_step =
      phase == Phase::kCooling ? tuning::kMostWhileCooling : std::numeric_limits<double>::infinity();
  plan.measure_balls = !settings.polish || phase >= Phase::kPolishing;
  plan.reuse_directions = settings.stop_rule == StopRule::kSettled &&
                          settings.boundary_distance <= 0.5 &&
                          phase != Phase::kCooling;
  return plan;
}

}  // namespace meander
