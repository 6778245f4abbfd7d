// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far a run has come.
#pragma once

#include "flow/plan.h"

namespace meander {

/// What the progress is a function of.
struct ProgressFigures {
  Phase phase = Phase::kGrowing;
  uint32_t iterations_in_phase = 0;
  double length = 0;           ///< of the curve that grows, and
  double expected_length = 1;  ///< of one that fills the surface, in the same unit
  uint32_t iterations = 0;     ///< of this run, which count for the limit
  uint32_t quiet_iterations = 0;  ///< in a row, as the paper's rule counts them
  bool full = false;              ///< the curve began full
  double part = 0;                ///< of the iteration under way, from 0 to 1
  double laid = 0;                ///< of a first curve that is being laid, from 0 to 1
  double faces_a_node = 0;        ///< of a curve that fills the surface
};

/// About the share of the work that is done, from 0 to 1, and 1 only where the limit is reached: by what is laid of a
/// first curve, in growth by the length, then by the iterations of each phase, as far as their number is known. Where
/// it is not, the curve comes ever nearer to the end of the phase, so that it never stands still. A run that its
/// iteration limit will end is no less far than that share of its iterations. It rises within a run but for a curve
/// that grows shorter for a while; whoever shows it keeps the most.
double progress_of(const FlowSettings& settings, const ProgressFigures& figures);

}  // namespace meander
