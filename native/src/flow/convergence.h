// SPDX-License-Identifier: GPL-3.0-or-later
//
// When growth gives way to the polish, and when the curve has settled.
#pragma once

#include <optional>
#include <vector>

#include "base/thread_pool.h"
#include "curve/curve.h"
#include "curve/local_metric.h"

namespace meander {

/// What one iteration leaves for the decision.
struct IterationFigures {
  double length = 0;          ///< of the strands that may move, as are the other figures
  double clamped_share = 0;   ///< of nodes with a medial radius at the clamp
  double moved = 0;           ///< mean distance that nodes were really moved, in the local r
  double displacement_norm = 0;  ///< |d|_2 / n of the proposed displacements, in r (the paper's rule)
};

enum class StopRule { kSettled, kPaper };

/// What the flow is about. Without a polish it is growing until the end.
enum class Phase {
  kGrowing,   ///< until the length hardly changes and little is empty
  kHairpinRemoval,  ///< a given number of iterations
  kPolishing, ///< a number of iterations with segments as long as they were
  kFinishing, ///< until the picture has stopped changing, with segments as short as they are to be
  kCooling    ///< a few iterations with short steps, so that nothing is left in mid-leap
};

class Convergence {
 public:
  Convergence(StopRule rule, bool polish, uint32_t hairpin_removal_iterations)
      : rule_(rule), polish_wanted_(polish), hairpin_removal_iterations_(hairpin_removal_iterations) {}

  /// Takes note of an iteration and of the curve after it.
  void note(const Surface& surface, const Curve& curve, const LocalMetric& metric,
            const IterationFigures& figures, ThreadPool& pool);

  /// The surface has moved: what was seen before counts no more. A curve that fills it already, with no
  /// more than `clamped_share` of its nodes at the clamp, need not grow again and is only finished.
  void restart(double clamped_share);

  Phase phase() const { return phase_; }
  /// Is it past its growth?
  bool polishing() const { return polish_wanted_ && phase_ != Phase::kGrowing; }
  /// May its segments be longer than they are to be in the end?
  bool coarse() const { return polish_wanted_ && phase_ <= Phase::kPolishing; }
  bool converged() const { return converged_; }
  bool stalled() const { return stalled_; }

 private:
  /// Lengths and curves are compared with those of this many iterations before.
  static constexpr size_t kWindow = 10;

  void begin(Phase phase);
  bool has_grown(double change, double clamped_share) const;
  bool has_settled(const Surface& surface, const Curve& curve, const LocalMetric& metric,
                   double change, ThreadPool& pool);

  StopRule rule_;
  bool polish_wanted_, converged_ = false, stalled_ = false;
  uint32_t hairpin_removal_iterations_, removed_for_ = 0, polished_ = 0;
  Phase phase_ = Phase::kGrowing;
  std::vector<double> lengths_;
  size_t phase_start_ = 0;  // iteration at which the phase began
  size_t idle_ = 0;         // iterations in a row without movement
  size_t quiet_ = 0;        // iterations in a row below the paper's limit
  struct Picture {
    size_t iteration = 0;
    std::vector<Vec3> nodes;
    std::vector<uint32_t> next, previous;
  };
  std::optional<Picture> picture_;
};

}  // namespace meander
