// SPDX-License-Identifier: GPL-3.0-or-later
#include "convergence.h"

#include <algorithm>
#include <cmath>

#include "point_tree.h"
#include "segment_distance.h"

namespace meander {
namespace {

constexpr double kPaperLimit = 3e-4;      // Table 2, of |d|_2 / n in r
constexpr size_t kPaperIterations = 10;   // in as many iterations in a row: with few nodes one quiet step is no end
constexpr double kGrownLength = 0.02;     // growth ends when the length changes by less in a window,
constexpr double kGrownClamped = 0.01;    // and fewer nodes than this still see nothing beside them,
constexpr double kGrownForSure = 0.005;   // or the length has all but stopped changing
constexpr double kSettledLength = 0.0025;
constexpr double kSettledDistance = 0.04; // mean distance from the curve a window before, in local r
constexpr double kIdle = 1e-9;            // nodes that move less than this (in r) do not move
constexpr size_t kIdleIterations = 5;

}  // namespace

void Convergence::restart(double clamped_share) {
  polishing_ = polishing_ || (polish_wanted_ && clamped_share < kGrownClamped);
  converged_ = stalled_ = false;
  phase_start_ = idle_ = quiet_ = 0;
  lengths_.clear();
  picture_.reset();
}

void Convergence::note(const Surface& surface, const Curve& curve, const std::vector<double>& local_radius,
                       const IterationFigures& figures, Team& team) {
  lengths_.push_back(figures.length);
  const size_t now = lengths_.size();
  idle_ = figures.moved < kIdle ? idle_ + 1 : 0;
  stalled_ = idle_ >= kIdleIterations;
  if (rule_ == StopRule::kPaper) {
    quiet_ = figures.displacement_norm < kPaperLimit ? quiet_ + 1 : 0;
    converged_ = quiet_ >= kPaperIterations;
    return;
  }
  const size_t age = now - phase_start_;
  const double change =
      age > kWindow ? std::abs(figures.length / lengths_[now - 1 - kWindow] - 1) : 1;
  if (polish_wanted_ && !polishing_) {
    if ((change < kGrownLength && figures.clamped_share < kGrownClamped) || change < kGrownForSure) {
      polishing_ = true;
      phase_start_ = now;
      picture_.reset();
    }
    return;
  }
  if (picture_ && now - picture_->iteration < kWindow) return;
  Picture present{now, {}, {}, {}};
  for (uint32_t i = 0; i < curve.size(); ++i) {
    present.nodes.push_back(position(surface, curve.nodes[i]));
    present.next.push_back(curve.next(i));
    present.previous.push_back(curve.previous(i));
  }
  if (picture_) {
    const PointTree tree(picture_->nodes);
    std::vector<double> distance(curve.size());
    team.for_blocks(curve.size(), 512, [&](size_t, size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        const Vec3& p = present.nodes[i];
        const uint32_t near = tree.nearest(p)->index;
        double d = (p - picture_->nodes[near]).norm();
        for (const uint32_t other : {picture_->next[near], picture_->previous[near]}) {
          if (other != kNone) d = std::min(d, distance_to_segment(p, picture_->nodes[near], picture_->nodes[other]));
        }
        distance[i] = d / local_radius[i];
      }
    });
    double sum = 0, count = 0;
    for (uint32_t i = 0; i < curve.size(); ++i) {
      if (curve.on_guide(i)) continue;
      sum += distance[i];
      ++count;
    }
    converged_ = change < kSettledLength && sum / count < kSettledDistance;
  }
  picture_ = std::move(present);
}

}  // namespace meander
