// SPDX-License-Identifier: GPL-3.0-or-later
//
// When growth gives way to the polish, and when the curve has settled or is stuck.
#pragma once

#include <vector>

#include "base/thread_pool.h"
#include "curve/local_metric.h"
#include "flow/plan.h"
#include "flow/rest_of_picture.h"
#include "flow/settings.h"

namespace meander {

/// What one iteration leaves for the decision. Means are over the nodes that may move.
struct IterationFigures {
  double length = 0;             ///< of the strands that may move, in the surface's unit
  double clamped_share = 0;      ///< of their nodes with a medial radius at the clamp
  double wanted = 0;             ///< mean length of the displacements, in the local r
  double moved = 0;              ///< mean distance that nodes have really gone, in the local r
  double displacement_norm = 0;  ///< |d|_2 / n of the displacements, in r (the paper's rule)
  double far_share = 0;          ///< of the area, what is far from the curve; only where asks_what_is_far()
  double alone_share = 0;        ///< of the nodes, those that lie_alone
  double slack_share = 0;        ///< of the nodes, those with room on both sides (slack_share)
  double balanced_share = 0;     ///< of the nodes, those that lie in balance (balanced_share)
  double correction = 1;         ///< of r, for the next iteration; see Domain
  bool laid = false;             ///< the iteration laid something; see Iteration::lay
};

/// The lengths of the curve after all iterations, and since when its present phase lasts.
class LengthsOfPhase {
 public:
  void begin_phase() { start_ = lengths_.size(); }
  void push(double length) { lengths_.push_back(length); }
  void pop() noexcept { lengths_.pop_back(); }

  size_t iterations() const { return lengths_.size(); }
  size_t iterations_in_phase() const { return lengths_.size() - start_; }
  /// Whether the curve is `times` as long as after the last iteration; not after the first.
  bool exceeds_last(double length, double times) const { return !lengths_.empty() && length > times * lengths_.back(); }
  /// By what share the length has changed in the iterations of the phase up to one after which it is this; 1 where
  /// these are fewer.
  double change_in(size_t window, double length) const;
  /// Whether the lengths of the phase go up and down, and for long no higher than before: of a few nodes, that come
  /// and go.
  bool swing() const;

 private:
  std::vector<double> lengths_;
  size_t start_ = 0;  // iteration at which the phase began
};

/// How a flow begins: it grows, or a curve is laid first, and then on strips that are all too narrow to turn in.
enum class Beginning { kGrown, kFull, kNarrow };

/// Which phase a flow is in, and whether it is at its end: what it is told after every iteration decides. One thread
/// at a time.
class Convergence {
 public:
  /// See FlowSettings.
  Convergence(StopRule rule, bool polish, uint32_t hairpin_removal_iterations, uint32_t polish_iterations)
      : Convergence(Lasting{rule, polish, hairpin_removal_iterations, polish_iterations}) {}

  /// Of a new flow with these settings. One that does not begin grown has no hairpins removed and a polish of its own
  /// once something has been laid; else it grows as if nothing else had been asked for.
  Convergence(const FlowSettings& settings, Beginning beginning);

  /// Takes note of an iteration and of the curve after it, whose metric is given. Strong guarantee: if it throws,
  /// nothing has been noted.
  void note(const Surface& surface, const Curve& curve, const LocalMetric& metric, const IterationFigures& figures,
            ThreadPool& pool);

  /// The same of an iteration on the way to the spacing asked for (Fig. 25): all that counts of it is what it has laid.
  void note_approach(const IterationFigures& figures) noexcept;

  /// Whether the next note() needs far_share of an iteration with these figures: growth would end, has lasted long, or
  /// is stuck. `side` is that of a square as large as the surface, in r.
  bool asks_what_is_far(const IterationFigures& figures, double side) const;

  /// What it is once the surface has moved: what was seen before counts no more. A curve that fills the surface
  /// already, with little of it at the clamp (see clamped_share), need not grow again and is only finished.
  Convergence restarted(double clamped_share) const;

  /// What it is once something else is asked for. A curve that is still growing, or that has not been made even yet,
  /// goes on with that. One that was at its end is fitted: a shorter polish, and no waiting until the picture rests.
  /// Where too much has changed since it grew, or other weights grow another curve, it grows again.
  ///
  /// `settings`  the new ones
  /// `change`    of r: the mean over the curve of |ln(r / r before)|
  /// `regrow`    whether the weights of growth are others
  Convergence revised(const FlowSettings& settings, double change, bool regrow) const;

  Phase phase() const { return phase_; }
  /// Whether something has been laid in the phase kStarting, or later most of the curve.
  bool began_full() const { return lasting_.began_full; }
  /// Whether segments are short from now on: long ones were stuck, and nothing could be laid beside them.
  bool cut_short() const { return tried_.cut_short; }
  /// How many iterations of the present phase have been noted.
  uint32_t iterations_in_phase() const;
  /// How many iterations in a row have been quiet by the paper's rule, at whose number it ends a run.
  uint32_t quiet_iterations() const { return static_cast<uint32_t>(quiet_); }
  bool converged() const { return converged_; }
  /// Nodes are to move, but nothing has moved for some iterations: crossings, guides or the boundary are in the way,
  /// and some of the surface is far from the curve. One that fills it is at rest, and so is a curve that nothing asks
  /// to move: they converge. By the paper's rule it does not matter what is far.
  bool stalled() const { return stalled_; }

 private:
  /// What stays when the surface moves: what is wanted, and how much of it has been done.
  struct Lasting {
    StopRule rule;
    bool polish_wanted;
    uint32_t hairpin_removal_iterations, polish_iterations;
    uint32_t full_polish_iterations = 0;  // where it begins full
    bool began_full = false;
    bool narrow = false;   // it begins on strips too narrow to turn in
    bool fitting = false;  // the polish is followed by the last iterations
    double change = 0;     // of r since the curve grew; see revised()
    uint32_t removed_for = 0, polished = 0;  // iterations that have passed of these phases
  };
  /// What growth has done where it would have ended.
  struct Tried {
    bool rest_laid = false, cut_short = false;
    bool loosened = false;    // what lay in balance has been pushed
    bool alone_laid = false;  // laying a way back beside what lies alone has been tried
    double far_before = 1;    // far_share when growth would have ended before
  };

  explicit Convergence(const Lasting& lasting) : lasting_(lasting) {}

  void begin(Phase phase);
  void begin_full() noexcept;
  bool awaits_rest() const;
  /// Where nothing can turn, all that growth would do beside what was laid is to run on, and what it would reach is
  /// what is far.
  bool only_runs_on(const IterationFigures& figures) const {
    return lasting_.narrow && (lasting_.began_full || figures.laid);
  }
  static bool is_stuck(const IterationFigures& figures);
  bool is_held() const;
  void note_idleness(const IterationFigures& figures);
  bool has_grown(double change, double clamped_share) const;
  void note_growth(const IterationFigures& figures, bool rests);

  Lasting lasting_;
  Tried tried_;
  Phase phase_ = Phase::kGrowing;
  LengthsOfPhase lengths_;
  RestOfPicture picture_;
  size_t idle_ = 0;   // iterations in a row in which nothing moved that should have
  size_t quiet_ = 0;  // iterations in a row below the paper's limit
  bool converged_ = false, stalled_ = false;
};

}  // namespace meander
