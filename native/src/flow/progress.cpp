// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/progress.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "flow/constants.h"
#include "seed/full_start.h"

namespace meander {
namespace {

double cube(double x) { return x * x * x; }

/// What growth costs as a function of the length, in units of that of a curve that fills the surface: long curves cost
/// more an iteration, and grow more slowly.
double share_of_growth(double length) {
  return cube(std::min(1.0, length / kLengthWhenGrown));
}

/// Without a polish the length says how far a curve is, until it is quiet; then the iterations do.
double share_without_polish(const FlowSettings& settings, const ProgressFigures& figures) {
  const double length = figures.length / figures.expected_length;
  const double beyond =
      std::clamp((length - kLengthWhenGrown) / (kUnpolishedLength - kLengthWhenGrown), 0.0, 1.0);
  const double until = kUnpolishedGrowth, last = kUnpolishedEnd;
  double end = 0;
  if (settings.stop_rule == StopRule::kPaper) {
    end = figures.quiet_iterations / static_cast<double>(kPaperIterations);
  } else if (figures.phase == Phase::kCooling) {
    end = figures.iterations_in_phase / static_cast<double>(kCoolingIterations);
  }
  if (end > 0) return 1 - last * (1 - std::min(end, 1.0));
  return until * share_of_growth(length) + (1 - until - last) * beyond;
}

/// x while little is expected to be left, and then ever more slowly, so that it stays below 1.
double slowed(double x) {
  return x <= kSlowedFrom ? x : 1 - (1 - kSlowedFrom) * elementary::exp(-(x - kSlowedFrom) / (1 - kSlowedFrom));
}

/// The work of the phases of a flow with a polish, in iterations with long segments on a curve that fills the surface.
double share_with_polish(const FlowSettings& settings, const ProgressFigures& figures) {
  const double removal = figures.full ? 0 : settings.hairpin_removal_iterations;
  const double polish = polish_iterations(settings, figures.full);
  const double fine = figures.full ? kFineWhereLaid : settings.growth_coarsening;  // an iteration with short segments
  const double settling = figures.full ? kFullFinishingIterations : kFinishingIterations;
  const double finishing = fine * settling, cooling = fine * kCoolingIterations;
  const double laying = kLayingWork * (1 + laying_of_faces(figures.faces_a_node));
  const double growth = figures.full ? laying + kFullGrowthIterations : kGrowthWork;
  const double all = growth + removal + polish + finishing + cooling;
  const double age = figures.iterations_in_phase + figures.part;
  double done = growth;
  switch (figures.phase) {
    case Phase::kStarting: done = laying * figures.laid; break;
    case Phase::kGrowing:
      if (figures.full) {
        done = laying + kFullGrowthIterations * slowed(age / kFullGrowthIterations);
        break;
      }
      [[fallthrough]];
    case Phase::kLoosening:
    case Phase::kLayingRest: done *= share_of_growth(figures.length / figures.expected_length); break;
    case Phase::kHairpinRemoval: done += std::min(age, removal); break;
    case Phase::kPolishing: done += removal + std::min(age, polish); break;
    case Phase::kFinishing: done += removal + polish + finishing * slowed(age / settling); break;
    case Phase::kCooling: done = all - cooling + std::min(fine * age, cooling); break;
  }
  return done / all;
}

}  // namespace

double progress_of(const FlowSettings& settings, const ProgressFigures& figures) {
  const double work = settings.polish ? share_with_polish(settings, figures)
                                      : share_without_polish(settings, figures);
  return std::clamp(std::max(work, static_cast<double>(figures.iterations) / settings.iteration_limit), 0.0, 1.0);
}

}  // namespace meander
