// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/convergence.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/segment_distance.h"
#include "flow/constants.h"
#include "flow/free_nodes.h"
#include "medial/near_points.h"

namespace meander {
namespace {

/// The mean distance of the nodes of `curve` that may move, which are at `nodes`, from an earlier one, in the local r.
double mean_distance(const Curve& curve, const std::vector<Vec3>& nodes, const LocalMetric& metric,
                     const Convergence::Picture& earlier, ThreadPool& pool) {
  const CurveBvh tree(earlier.nodes, pool);
  std::vector<uint32_t> nearest(nodes.size());
  pool.for_blocks(nodes.size(), kNodeGrain, [&](size_t, size_t begin, size_t end) {
    // Of a neighbour it is about as far.
    uint32_t near = std::min(static_cast<uint32_t>(begin), static_cast<uint32_t>(earlier.nodes.size() - 1));
    for (size_t i = begin; i < end; ++i) nearest[i] = near = nearest_point(tree, nodes[i], near);
  });
  return mean_over_movable(curve, pool, [&](uint32_t i) {
    const Vec3& p = nodes[i];
    const uint32_t near = nearest[i];
    double d = (p - earlier.nodes[near]).norm();
    for (const uint32_t other : {earlier.next[near], earlier.previous[near]}) {
      if (other != kNone) d = std::min(d, distance_to_segment(p, earlier.nodes[near], earlier.nodes[other]));
    }
    return d / metric.radius[i];
  });
}

/// Whether these lengths go up and down, and for long no higher than before: of a few nodes, that come and go.
bool swings(std::span<const double> lengths) {
  if (lengths.size() <= 2 * kSwingWindow) return false;
  const std::span<const double> before = lengths.first(lengths.size() - kSwingWindow);
  return std::ranges::max(lengths.last(kSwingWindow)) < (1 + kGrownForSure) * std::ranges::max(before);
}

}  // namespace

Convergence::Convergence(const FlowSettings& settings, Beginning beginning)
    : Convergence(settings.stop_rule, settings.polish, settings.hairpin_removal_iterations,
                  polish_iterations(settings, false)) {
  full_polish_iterations_ = polish_iterations(settings, true);
  if (beginning == Beginning::kNarrow) {
    full_polish_iterations_ = std::min(full_polish_iterations_, kNarrowPolishIterations);
  }
  if (beginning != Beginning::kGrown) phase_ = Phase::kStarting;
}

Convergence Convergence::restarted(double clamped_share) const {
  Convergence next(rule_, polish_wanted_, hairpin_removal_iterations_, polish_iterations_);
  next.began_full_ = began_full_;
  next.full_polish_iterations_ = full_polish_iterations_;
  next.removed_for_ = removed_for_;
  next.polished_ = polished_;
  next.fitting_ = fitting_;
  next.change_ = change_;
  const bool grown = !grows_in(phase_) || clamped_share < kGrownClamped;
  // What is past its growth but has long segments still goes on where it is: else they would all be cut at
  // once.
  const bool under_way = phase_ == Phase::kHairpinRemoval || phase_ == Phase::kPolishing;
  if (under_way || (grows_in(phase_) && !(grown && polish_wanted_))) {
    next.phase_ = phase_;
  } else {
    next.phase_ = polish_wanted_ ? Phase::kFinishing : Phase::kGrowing;
  }
  return next;
}

Convergence Convergence::revised(const FlowSettings& settings, double change, bool regrow) const {
  Convergence next(settings, settings.full_start ? Beginning::kFull : Beginning::kGrown);
  next.phase_ = grows_in(phase_) ? phase_ : Phase::kGrowing;
  if (began_full_) next.begin_full();
  if (!settings.polish || !polish_wanted_ || grows_in(phase_)) return next;
  next.change_ = change_ + change;
  if (regrow || next.change_ > kMostFitted) {
    next.change_ = 0;
    return next;
  }
  next.fitting_ = fitting_ || phase_ == Phase::kCooling;
  next.removed_for_ = removed_for_;
  const bool removing = phase_ == Phase::kHairpinRemoval && removed_for_ < next.hairpin_removal_iterations_;
  next.phase_ = removing ? phase_ : Phase::kPolishing;
  next.polished_ = std::min(polished_, next.polish_iterations_ - kFittingIterations);
  return next;
}

/// What is laid has few hairpins, and they hold its pattern: of a curve that fills the surface from its start, or that
/// consists mostly of a rest that was laid, none are drawn in.
void Convergence::begin_full() noexcept {
  began_full_ = true;
  hairpin_removal_iterations_ = 0;
  polish_iterations_ = full_polish_iterations_;
}

void Convergence::note_approach(const IterationFigures& figures) noexcept {
  if (phase_ == Phase::kStarting && figures.laid) begin_full();
  if (phase_ == Phase::kStarting || phase_ == Phase::kLayingRest) phase_ = Phase::kGrowing;
}

void Convergence::begin(Phase phase) {
  phase_ = phase;
  phase_start_ = lengths_.size();
  picture_.reset();
}

/// By what share the length has changed in the iterations up to one after which it is this.
double Convergence::change_in(size_t window, double length) const {
  const size_t before = lengths_.size() - phase_start_;
  return before >= window ? std::abs(length / lengths_[lengths_.size() - window] - 1) : 1;
}

bool Convergence::asks_what_is_far(const IterationFigures& figures, double side) const {
  if (!grows_in(phase_) || rule_ == StopRule::kPaper) return false;
  if (is_stuck(figures) && (!rest_laid_ || idle_ + 1 >= kIdleIterations)) return true;
  if (polish_wanted_) {
    if (has_grown(change_in(kGrowthWindow, figures.length), figures.clamped_share)) return true;
  } else if (change_in(kSettledWindow, figures.length) < kSettledLength) {
    return true;
  }
  const size_t age = lengths_.size() + 1 - phase_start_;
  return !rest_laid_ && age % kGrowthWindow == 0 &&
         static_cast<double>(age) > static_cast<double>(kLeastPatience) + kPatience * side;
}

bool Convergence::has_grown(double change, double clamped_share) const {
  return (change < kGrownLength && clamped_share < kGrownClamped) || change < kGrownForSure ||
         swings(std::span(lengths_).subspan(phase_start_));
}

/// Compares the curve with the one of a window before; the first time it only takes that one down.
bool Convergence::has_settled(const Surface& surface, const Curve& curve, const LocalMetric& metric,
                              double change, ThreadPool& pool) {
  const size_t now = lengths_.size();
  if (picture_ && now - picture_->iteration < kSettledWindow) return false;
  const size_t count = curve.size();
  Picture present{now, std::vector<Vec3>(count), std::vector<uint32_t>(count), std::vector<uint32_t>(count)};
  pool.for_each(count, kNodeGrain, [&](uint32_t i) {
    present.nodes[i] = position(surface, curve.nodes[i]);
    present.next[i] = curve.next(i);
    present.previous[i] = curve.previous(i);
  });
  const bool settled = picture_ && change < kSettledLength &&
                       mean_distance(curve, present.nodes, metric, *picture_, pool) < kSettledDistance;
  picture_ = std::move(present);
  return settled;
}

/// Does the present phase last until the curve has come to rest?
bool Convergence::awaits_rest() const {
  if (rule_ == StopRule::kPaper) return false;
  return phase_ == Phase::kFinishing || (grows_in(phase_) && !polish_wanted_);
}

bool Convergence::is_stuck(const IterationFigures& figures) { return figures.wanted >= kIdle && figures.moved < kIdle; }

void Convergence::note_idleness(const IterationFigures& figures) {
  idle_ = is_stuck(figures) ? idle_ + 1 : 0;
  const bool unfinished = rule_ == StopRule::kPaper || (grows_in(phase_) && figures.far_share > kMostFar);
  stalled_ = idle_ >= kIdleIterations && unfinished;
}

/// What fills the surface and cannot move any more has come to rest, in any phase: a polish would only draw its tips
/// back from where it is narrow.
bool Convergence::is_held() const { return idle_ >= kIdleIterations && !stalled_; }

/// `rests`: the curve hardly changes any more.
void Convergence::note_growth(const IterationFigures& figures, bool rests) {
  const bool far = figures.far_share > kMostFar;
  const bool alone = rests && figures.alone_share > kMostAlone;
  if ((!rest_laid_ && far) || (!alone_laid_ && alone)) {
    cut_short_ = !rest_laid_ && idle_ > 0;
    rest_laid_ = true;
    alone_laid_ = alone;
    idle_ = 0;
    stalled_ = false;
    begin(Phase::kLayingRest);
  } else if (rests && far && figures.far_share < far_before_ - kLessFar) {
    far_before_ = figures.far_share;
    begin(Phase::kLayingRest);
  } else if (rests && !loosened_ && figures.slack_share > kMostSlack) {
    loosened_ = true;
    begin(Phase::kLoosening);
  } else if (rests && polish_wanted_ && !is_held()) {
    begin(hairpin_removal_iterations_ > 0 ? Phase::kHairpinRemoval : Phase::kPolishing);
  } else if (rests) {
    begin(Phase::kCooling);
  }
}

uint32_t Convergence::iterations_in_phase() const {
  switch (phase_) {
    case Phase::kHairpinRemoval: return removed_for_;  // over all restarts, as is the next
    case Phase::kPolishing: return polished_;
    default: return static_cast<uint32_t>(lengths_.size() - phase_start_);
  }
}

void Convergence::note(const Surface& surface, const Curve& curve, const LocalMetric& metric,
                       const IterationFigures& figures, ThreadPool& pool) {
  const bool mostly_laid = phase_ == Phase::kLayingRest && figures.laid && !lengths_.empty() &&
                           figures.length > kMostlyLaid * lengths_.back();
  const double settling = change_in(kSettledWindow, figures.length);
  const bool grown = has_grown(change_in(kGrowthWindow, figures.length), figures.clamped_share);
  lengths_.push_back(figures.length);
  const size_t age = lengths_.size() - phase_start_;
  bool settled = false;
  try {
    settled = awaits_rest() && has_settled(surface, curve, metric, settling, pool);
  } catch (...) {
    lengths_.pop_back();
    throw;
  }
  if (mostly_laid && !began_full_) begin_full();
  if (figures.laid) cut_short_ = false;
  note_approach(figures);
  note_idleness(figures);
  if (rule_ == StopRule::kPaper) {
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
      note_growth(figures, is_held() || (polish_wanted_ ? grown : settled));
      break;
    case Phase::kHairpinRemoval:
      if (++removed_for_ >= hairpin_removal_iterations_) begin(Phase::kPolishing);
      break;
    case Phase::kPolishing:
      if (++polished_ >= polish_iterations_) {
        begin(fitting_ ? Phase::kCooling : Phase::kFinishing);
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
