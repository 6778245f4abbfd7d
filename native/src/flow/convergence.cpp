// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/convergence.h"

#include <algorithm>
#include <cmath>

#include "base/point_tree.h"
#include "base/segment_distance.h"

namespace meander {
namespace {

constexpr double kPaperLimit = 3e-4;      // Table 2, of |d|_2 / n in r
constexpr size_t kPaperIterations = 10;   // in as many iterations in a row: with few nodes one quiet step is no end
constexpr double kGrownLength = 0.02;     // growth ends when the length changes by less in a window,
constexpr double kGrownClamped = 0.01;    // and fewer nodes than this still see nothing beside them,
constexpr double kGrownForSure = 0.005;   // or the length has all but stopped changing
constexpr double kSettledLength = 0.0025;
constexpr double kSettledDistance = 0.05; // mean distance from the curve a window before, in local r
constexpr uint32_t kPolishIterations = 30;
constexpr size_t kCoolingIterations = 6;
constexpr double kIdle = 1e-9;            // nodes that move less than this (in r) do not move
constexpr size_t kIdleIterations = 5;

}  // namespace

void Convergence::restart(double clamped_share) {
  lengths_.clear();
  const bool grown = phase_ != Phase::kGrowing || clamped_share < kGrownClamped;
  // What is past its growth but has long segments still goes on where it is: else they would all be cut at
  // once.
  const bool under_way = phase_ == Phase::kHairpinRemoval || phase_ == Phase::kPolishing;
  begin(under_way ? phase_ : grown && polish_wanted_ ? Phase::kFinishing : Phase::kGrowing);
  converged_ = stalled_ = false;
  idle_ = quiet_ = 0;
}

void Convergence::begin(Phase phase) {
  phase_ = phase;
  phase_start_ = lengths_.size();
  picture_.reset();
}

bool Convergence::has_grown(double change, double clamped_share) const {
  return (change < kGrownLength && clamped_share < kGrownClamped) || change < kGrownForSure;
}

/// Compares the curve with the one of a window before; the first time it only takes that one down.
bool Convergence::has_settled(const Surface& surface, const Curve& curve, const LocalMetric& metric,
                              double change, ThreadPool& pool) {
  const size_t now = lengths_.size();
  if (picture_ && now - picture_->iteration < kWindow) return false;
  Picture present{now, {}, {}, {}};
  present.nodes.reserve(curve.size());
  present.next.reserve(curve.size());
  present.previous.reserve(curve.size());
  for (uint32_t i = 0; i < curve.size(); ++i) {
    present.nodes.push_back(position(surface, curve.nodes[i]));
    present.next.push_back(curve.next(i));
    present.previous.push_back(curve.previous(i));
  }
  bool settled = false;
  if (picture_ && change < kSettledLength) {
    const PointTree tree(picture_->nodes);
    std::vector<double> distance(curve.size());
    pool.for_blocks(curve.size(), 512, [&](size_t, size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        const Vec3& p = present.nodes[i];
        const uint32_t near = tree.nearest(p)->index;
        double d = (p - picture_->nodes[near]).norm();
        for (const uint32_t other : {picture_->next[near], picture_->previous[near]}) {
          if (other != kNone) d = std::min(d, distance_to_segment(p, picture_->nodes[near], picture_->nodes[other]));
        }
        distance[i] = d / metric.radius[i];
      }
    });
    double sum = 0;
    for (const double d : distance) sum += d;
    settled = sum / curve.size() < kSettledDistance;
  }
  picture_ = std::move(present);
  return settled;
}

void Convergence::note(const Surface& surface, const Curve& curve, const LocalMetric& metric,
                       const IterationFigures& figures, ThreadPool& pool) {
  lengths_.push_back(figures.length);
  const size_t now = lengths_.size(), age = now - phase_start_;
  idle_ = figures.moved < kIdle ? idle_ + 1 : 0;
  stalled_ = idle_ >= kIdleIterations;
  if (rule_ == StopRule::kPaper) {
    quiet_ = figures.displacement_norm < kPaperLimit ? quiet_ + 1 : 0;
    converged_ = quiet_ >= kPaperIterations;
    return;
  }
  const double change = age > kWindow ? std::abs(figures.length / lengths_[now - 1 - kWindow] - 1) : 1;
  switch (phase_) {
    case Phase::kGrowing:
      if (!polish_wanted_) {
        if (has_settled(surface, curve, metric, change, pool)) begin(Phase::kCooling);
      } else if (has_grown(change, figures.clamped_share)) {
        begin(hairpin_removal_iterations_ > 0 ? Phase::kHairpinRemoval : Phase::kPolishing);
      }
      break;
    case Phase::kHairpinRemoval:
      if (++removed_for_ >= hairpin_removal_iterations_) begin(Phase::kPolishing);
      break;
    case Phase::kPolishing:
      if (++polished_ >= kPolishIterations) begin(Phase::kFinishing);
      break;
    case Phase::kFinishing:
      if (has_settled(surface, curve, metric, change, pool)) begin(Phase::kCooling);
      break;
    case Phase::kCooling:
      converged_ = age >= kCoolingIterations;
      break;
  }
}

}  // namespace meander
