// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/convergence.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "flow/constants.h"

namespace meander {

double LengthsOfPhase::change_in(size_t window, double length) const {
  return iterations_in_phase() >= window ? std::abs(length / lengths_[lengths_.size() - window] - 1) : 1;
}

bool LengthsOfPhase::swing() const {
  const std::span<const double> lengths = std::span(lengths_).subspan(start_);
  if (lengths.size() <= 2 * kSwingWindow) return false;
  const std::span<const double> before = lengths.first(lengths.size() - kSwingWindow);
  return std::ranges::max(lengths.last(kSwingWindow)) < (1 + kGrownForSure) * std::ranges::max(before);
}

Convergence::Convergence(const FlowSettings& settings, Beginning beginning)
    : Convergence(settings.stop_rule, settings.polish, settings.hairpin_removal_iterations,
                  polish_iterations(settings, false)) {
  lasting_.full_polish_iterations = polish_iterations(settings, true);
  if (beginning == Beginning::kNarrow) {
    lasting_.narrow = settings.polish;
    lasting_.full_polish_iterations = std::min(lasting_.full_polish_iterations, kNarrowPolishIterations);
  }
  if (beginning != Beginning::kGrown) phase_ = Phase::kStarting;
}

Convergence Convergence::restarted(double clamped_share) const {
  Convergence next(lasting_);
  const bool grown = !grows_in(phase_) || clamped_share < kGrownClamped;
  // What is past its growth but has long segments still goes on where it is: else they would all be cut at
  // once.
  const bool under_way = phase_ == Phase::kHairpinRemoval || phase_ == Phase::kPolishing;
  if (under_way || (grows_in(phase_) && !(grown && lasting_.polish_wanted))) {
    next.phase_ = phase_;
  } else {
    next.phase_ = lasting_.polish_wanted ? Phase::kFinishing : Phase::kGrowing;
  }
  return next;
}

Convergence Convergence::revised(const FlowSettings& settings, double change, bool regrow) const {
  Convergence next(settings, settings.full_start ? Beginning::kFull : Beginning::kGrown);
  next.phase_ = grows_in(phase_) ? phase_ : Phase::kGrowing;
  if (lasting_.began_full) next.begin_full();
  if (!settings.polish || !lasting_.polish_wanted || grows_in(phase_)) return next;
  next.lasting_.change = lasting_.change + change;
  if (regrow || next.lasting_.change > kMostFitted) {
    next.lasting_.change = 0;
    return next;
  }
  next.lasting_.fitting = lasting_.fitting || phase_ == Phase::kCooling;
  next.lasting_.removed_for = lasting_.removed_for;
  const bool removing =
      phase_ == Phase::kHairpinRemoval && lasting_.removed_for < next.lasting_.hairpin_removal_iterations;
  next.phase_ = removing ? phase_ : Phase::kPolishing;
  next.lasting_.polished = std::min(lasting_.polished, next.lasting_.polish_iterations - kFittingIterations);
  return next;
}

/// What is laid has few hairpins, and they hold its pattern: of a curve that fills the surface from its start, or that
/// consists mostly of a rest that was laid, none are drawn in.
void Convergence::begin_full() noexcept {
  lasting_.began_full = true;
  lasting_.hairpin_removal_iterations = 0;
  lasting_.polish_iterations = lasting_.full_polish_iterations;
}

void Convergence::note_approach(const IterationFigures& figures) noexcept {
  if (phase_ == Phase::kStarting && figures.laid) begin_full();
  if (phase_ == Phase::kStarting || phase_ == Phase::kLayingRest) phase_ = Phase::kGrowing;
}

void Convergence::begin(Phase phase) {
  phase_ = phase;
  lengths_.begin_phase();
  picture_.forget();
}

bool Convergence::asks_what_is_far(const IterationFigures& figures, double side) const {
  if (!grows_in(phase_) || lasting_.rule == StopRule::kPaper) return false;
  if (only_runs_on(figures)) return true;
  if (is_stuck(figures) && (!tried_.rest_laid || idle_ + 1 >= kIdleIterations)) return true;
  if (lasting_.polish_wanted) {
    if (has_grown(lengths_.change_in(kGrowthWindow, figures.length), figures.clamped_share)) return true;
  } else if (lengths_.change_in(kSettledWindow, figures.length) < kSettledLength) {
    return true;
  }
  const size_t age = lengths_.iterations_in_phase() + 1;
  return !tried_.rest_laid && age % kGrowthWindow == 0 &&
         static_cast<double>(age) > static_cast<double>(kLeastPatience) + kPatience * side;
}

bool Convergence::has_grown(double change, double clamped_share) const {
  return (change < kGrownLength && clamped_share < kGrownClamped) || change < kGrownForSure ||
         lengths_.swing();
}

/// Does the present phase last until the curve has come to rest?
bool Convergence::awaits_rest() const {
  if (lasting_.rule == StopRule::kPaper) return false;
  return phase_ == Phase::kFinishing || (grows_in(phase_) && !lasting_.polish_wanted);
}

bool Convergence::is_stuck(const IterationFigures& figures) { return figures.wanted >= kIdle && figures.moved < kIdle; }

void Convergence::note_idleness(const IterationFigures& figures) {
  idle_ = is_stuck(figures) ? idle_ + 1 : 0;
  const bool unfinished = lasting_.rule == StopRule::kPaper || (grows_in(phase_) && figures.far_share > kMostFar);
  stalled_ = idle_ >= kIdleIterations && unfinished;
}

/// What fills the surface and cannot move any more has come to rest, in any phase: a polish would only draw its tips
/// back from where it is narrow.
bool Convergence::is_held() const { return idle_ >= kIdleIterations && !stalled_; }

/// `rests`: the curve hardly changes any more.
void Convergence::note_growth(const IterationFigures& figures, bool rests) {
  const bool far = figures.far_share > kMostFar;
  const bool alone = rests && figures.alone_share > kMostAlone;
  if ((!tried_.rest_laid && far) || (!tried_.alone_laid && alone)) {
    tried_.cut_short = !tried_.rest_laid && idle_ > 0;
    tried_.rest_laid = true;
    tried_.alone_laid = alone;
    idle_ = 0;
    stalled_ = false;
    begin(Phase::kLayingRest);
  } else if (rests && far && figures.far_share < tried_.far_before - kLessFar) {
    tried_.far_before = figures.far_share;
    begin(Phase::kLayingRest);
  } else if (rests && !tried_.loosened && (figures.balanced_share > 0 || figures.slack_share > kMostSlack)) {
    tried_.loosened = true;
    begin(Phase::kLoosening);
  } else if (rests && lasting_.polish_wanted && !is_held()) {
    begin(lasting_.hairpin_removal_iterations > 0 ? Phase::kHairpinRemoval : Phase::kPolishing);
  } else if (rests) {
    begin(Phase::kCooling);
  }
}

uint32_t Convergence::iterations_in_phase() const {
  switch (phase_) {
    case Phase::kHairpinRemoval: return lasting_.removed_for;  // over all restarts, as is the next
    case Phase::kPolishing: return lasting_.polished;
    default: return static_cast<uint32_t>(lengths_.iterations_in_phase());
  }
}

void Convergence::note(const Surface& surface, const Curve& curve, const LocalMetric& metric,
                       const IterationFigures& figures, ThreadPool& pool) {
  const bool mostly_laid =
      phase_ == Phase::kLayingRest && figures.laid && lengths_.exceeds_last(figures.length, kMostlyLaid);
  const double settling = lengths_.change_in(kSettledWindow, figures.length);
  const bool grown = has_grown(lengths_.change_in(kGrowthWindow, figures.length), figures.clamped_share);
  lengths_.push(figures.length);
  const size_t age = lengths_.iterations_in_phase();
  bool settled = false;
  try {
    settled = awaits_rest() &&
              picture_.has_settled(lengths_.iterations(), surface, curve, metric, settling, pool);
  } catch (...) {
    lengths_.pop();
    throw;
  }
  if (mostly_laid && !lasting_.began_full) begin_full();
  if (figures.laid) tried_.cut_short = false;
  note_approach(figures);
  note_idleness(figures);
  if (lasting_.rule == StopRule::kPaper) {
    quiet_ = figures.displacement_norm < kPaperLimit ? quiet_ + 1 : 0;
    converged_ = quiet_ >= kPaperIterations;
    return;
  }
  if (is_held() && !grows_in(phase_) && phase_ != Phase::kCooling) {
    begin(Phase::kCooling);
    return;
  }
  switch (phase_) {
    case Phase::kStarting:
    case Phase::kGrowing:
    case Phase::kLoosening:
    case Phase::kLayingRest:
      note_growth(figures, is_held() || only_runs_on(figures) || (lasting_.polish_wanted ? grown : settled));
      break;
    case Phase::kHairpinRemoval:
      if (++lasting_.removed_for >= lasting_.hairpin_removal_iterations) begin(Phase::kPolishing);
      break;
    case Phase::kPolishing:
      if (++lasting_.polished >= lasting_.polish_iterations) {
        begin(lasting_.fitting ? Phase::kCooling : Phase::kFinishing);
      }
      break;
    case Phase::kFinishing:
      if (settled) begin(Phase::kCooling);
      break;
    case Phase::kCooling:
      converged_ = age >= kCoolingIterations;
      break;
  }
}

}  // namespace meander
