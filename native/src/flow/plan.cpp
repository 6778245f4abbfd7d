// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flow/constants.h"

namespace meander {
namespace {

/// What moves slowly but for long, as fingers that are drawn in and others that follow, arrives sooner if it does not
/// begin anew in every iteration (the heavy ball of Polyak).
double momentum_in(Phase phase, double gentleness) {
  switch (phase) {
    case Phase::kHairpinRemoval: return std::lerp(kRoughMomentum, kGentleMomentum, gentleness);
    case Phase::kPolishing: return kPolishMomentum;
    default: return 0;
  }
}

/// Growth goes through gaps, and into corners, that are hardly wider than a spike, and what would be taken out there
/// again and again would never come to rest. So it is done only in phases of a given length, and not where a strip
/// along the boundary is to stay empty, which strands must find out of.
double most_turn_in(const FlowSettings& settings, Phase phase) {
  const bool of_given_length = phase == Phase::kHairpinRemoval || phase == Phase::kPolishing;
  if (!settings.polish || !of_given_length || settings.boundary_distance > 0.5) {
    return std::numeric_limits<double>::infinity();
  }
  return std::lerp(kMostTurn, kMostGentleTurn, settings.hairpin_removal_gentleness);
}

double longest_step_in(Phase phase, uint32_t iterations_in_phase) {
  if (phase == Phase::kCooling) return kMostWhileCooling;
  if (phase != Phase::kFinishing || iterations_in_phase < kSwinging) return std::numeric_limits<double>::infinity();
  return 1.0 / (iterations_in_phase - kSwinging + 1);
}

}  // namespace

uint32_t polish_iterations(const FlowSettings& settings, bool full) {
  const double iterations =
      std::lerp(static_cast<double>(full ? kFullPolishIterations : kPolishIterations),
                static_cast<double>(full ? kLongFullPolishIterations : kLongPolishIterations),
                settings.hairpin_removal_gentleness);
  return static_cast<uint32_t>(std::lround(iterations));
}

IterationPlan plan_iteration(const FlowSettings& settings, Phase phase, uint32_t iterations_in_phase, bool full) {
  const double gentleness = settings.hairpin_removal_gentleness;
  const bool settles = settings.stop_rule == StopRule::kSettled;  // else the flow follows the paper
  const bool coarse = settings.polish && phase <= Phase::kPolishing;
  IterationPlan plan;
  plan.phase = phase;
  plan.polishing = settings.polish && !grows_in(phase);
  plan.segment_length = settings.segment_length * (coarse ? settings.growth_coarsening : 1);
  plan.momentum = settings.polish ? momentum_in(phase, gentleness) : 0;
  plan.room = phase == Phase::kLoosening ? kSlack : std::numeric_limits<double>::infinity();
  plan.hairpin_pull = std::lerp(kRoughPull, kGentlePull, gentleness);
  plan.medial.boundary_ease = gentleness;
  plan.longest_step = longest_step_in(phase, iterations_in_phase);
  plan.most_turn = most_turn_in(settings, phase);
  plan.medial.measure = !settings.polish || phase > Phase::kPolishing ||
                        (phase == Phase::kPolishing && iterations_in_phase >= kUnmeasuredPolish);
  plan.medial.boundary_within = plan.medial.boundary_ease > 0 ? kBesideBoundary : 0;
  if (phase == Phase::kPolishing && plan.medial.measure) plan.correction = SpacingCorrection::kSought;
  if (phase == Phase::kFinishing) plan.correction = SpacingCorrection::kTakenBack;
  if (!settles) plan.medial.very_near = kVeryNearOfPaper;
  plan.firm_boundary = settles;
  plan.firm_when_squeezed = settles && full;
  plan.reuse_directions = settles && settings.boundary_distance <= 0.5 && phase != Phase::kCooling;
  plan.reuse_balls = settles;
  return plan;
}

}  // namespace meander
