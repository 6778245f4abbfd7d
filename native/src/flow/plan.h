// SPDX-License-Identifier: GPL-3.0-or-later
//
// The plan of one iteration: what it is about, and by how much nodes may move in it.
#pragma once

#include "flow/settings.h"
#include "medial/medial_plan.h"

namespace meander {

/// What the flow is about. Without a polish it is growing until it settles, and then cools.
enum class Phase {
  kStarting,        ///< one iteration, which first lays a curve that fills the surface, and then grows
  kGrowing,         ///< until nothing advances any more and little is empty
  kLoosening,       ///< the same, where strands lie in balance with room on both sides
  kLayingRest,      ///< one iteration, which first lays what fills the empty rest of the surface, and then grows
  kHairpinRemoval,  ///< a given number of iterations
  kPolishing,       ///< a number of iterations with segments as long as they were
  kFinishing,       ///< until the picture has stopped changing, with segments as short as they are to be
  kCooling          ///< a few iterations with short steps, so that nothing is left in mid-leap
};

/// What becomes of the correction of r by how far apart strands come to be; see next_correction().
enum class SpacingCorrection {
  kKept,
  kSought,    ///< it follows what strands come to with long segments
  kTakenBack  ///< where it proves to have been too much, with short ones
};

/// Whether the curve still grows.
inline bool grows_in(Phase phase) { return phase <= Phase::kLayingRest; }

/// The same for all nodes, and for the whole of one iteration.
struct IterationPlan {
  Phase phase = Phase::kGrowing;
  bool polishing = false;     ///< past its growth: length weights follow the spacing
  double segment_length = 0;  ///< h where r is the nominal one, in the surface's own unit
  double momentum = 0;        ///< a node goes on by this share of its last step
  double longest_step = 0;    ///< in the local r; may be infinite
  double most_turn = 0;       ///< in radians: nodes where a strand turns by more are taken out; infinite in
                              ///< growth, at the end, without a polish, and where a strip along the boundary is
                              ///< to stay empty
  /// No step leads onto the boundary, and where it pushes hard the model knows how fast its push falls: what is
  /// squeezed between two boundaries comes to rest. Not where the flow follows the paper.
  bool firm_boundary = false;
  /// The same where a strand is squeezed between the boundary and another strand, as in a strip 3 r wide. Only for
  /// curves that fill the surface from their start, whose strips are full before there is anything to wait for.
  bool firm_when_squeezed = false;
  /// Strands that have so much room on both sides, in the local r, are pushed to one and the other in turn; see
  /// perturb_empty_stretches.
  double room = 0;
  SpacingCorrection correction = SpacingCorrection::kKept;
  double hairpin_pull = 0;    ///< the length weight that draws in runs between hairpins while these are removed
  /// Balls are measured near creases only from the middle of the polish on. Growth and hairpin removal only need to
  /// know what is hidden, and the first iterations of the polish too: curves are as even, for a fifth of the time less.
  /// After a gentle removal of hairpins the boundary pushes less, and strands may bend more freely beside it.
  MedialPlan medial;
  /// Nodes at rest keep the directions of their medial balls. The last iterations are exact, and so is every one
  /// where the flow follows the paper, and where a strip along the boundary is to stay empty: there it hardly comes
  /// to rest as it is.
  bool reuse_directions = false;
  /// And those balls along the surface that were measured; also in the last iterations, in which no node moves far. Not
  /// where the flow follows the paper.
  bool reuse_balls = false;
};

/// How long the phase kPolishing is: as patient as the removal of hairpins before it is gentle, and of a curve that
/// fills the surface from its start (`full`) in between.
uint32_t polish_iterations(const FlowSettings& settings, bool full);

/// The plan of the iteration after the first `iterations_in_phase` of this phase, of a curve that began full or not: a
/// function of the four alone.
IterationPlan plan_iteration(const FlowSettings& settings, Phase phase, uint32_t iterations_in_phase = 0,
                             bool full = false);

}  // namespace meander
