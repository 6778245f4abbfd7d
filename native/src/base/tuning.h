// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants that decide how a curve grows, in the order in which an iteration meets them.
//
// Each has its unit, and what chose it: a page of docs/, or the commit whose message has the figures. "Not measured"
// means that the first value that was tried has stayed. r is the local r unless something else is said; sizes of
// blocks, limits of rounding and what only saves time stand beside the code that they belong to. What callers may
// choose (weights, powers, numbers of iterations) is not here: the presets of the C API have it.
//
// A change here changes every curve: measure it as docs/quality.md does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>

namespace meander::tuning {

// ---- The metric at the nodes, and the boundary ----------------------------------------------------------------------

/// In front of an empty strip wider than this, in spacings, the boundary pushes no harder than other strands do: they
/// have room to give way there, and between two such strips they would never come to rest. Measured: docs/surfaces.md.
inline constexpr double kWideStrip = 1;

/// Samples of the boundary are at most this far apart, in h. Not measured.
inline constexpr double kBoundarySampling = 0.5;

/// Along a medial ball's diameter r counts as growing by no less and no more than this, as a share: where the density
/// jumps, the slope at its start says nothing. Not measured; the diameter itself was ("flow: Measure a ball's whole
/// diameter in the local r").
inline constexpr double kLeastRadiusGrowth = -0.75, kMostRadiusGrowth = 3;

// ---- Strands that see nothing ---------------------------------------------------------------------------------------

/// Length weight where both sides of a strand are empty. Not measured.
inline constexpr double kIntoEmpty = -1;

/// There one side and the other are favoured in turn by this share of the radius, with this wavelength in r, which has
/// room for two fingers. A wide smooth loop stood still for up to 60 iterations before (docs/quality.md); the two
/// numbers are not measured.
inline constexpr double kPerturbation = 0.3, kPerturbationWavelength = 8;

/// Closed strands shorter than a circle of this radius, in r, are not bent or shortened yet. Not measured.
inline constexpr double kYoung = 1.5;

// ---- The model ------------------------------------------------------------------------------------------------------

/// The Hessian of a pure length weight must stay positive; where the gradient's weight is below this (it may be
/// negative, to let a strand grow), the Hessian uses this. Not measured.
inline constexpr double kLeastLengthStiffness = 0.05;

// ---- Powers other than 2 (eq. 13) -----------------------------------------------------------------------------------

/// What alpha is multiplied by so that a power q of the medial term leaves the spacing as it is falls from 1 at q = 2
/// to this limit, at this rate. Measured on a square of 17 x 17 spacings with both presets: with alpha left as it is,
/// the spacing falls by 11 to 16 % for q from 3 to 8.
inline constexpr double kPowerLimit = 0.53, kPowerRate = 1.1;

/// What is added to the length weights of a polish to the same end: this, and so much more for each unit of q. Measured
/// likewise: growth with q above 2 leaves the curve 7 to 16 % too dense.
inline constexpr double kPolishBalance = 0.5, kPolishBalanceSlope = 0.05;

// ---- A field (eq. 11) -----------------------------------------------------------------------------------------------

/// The length weight that pushes strands along the field: this many beta, and no more than so much, before a polish and
/// in it. Measured in "flow: Lie along fields ..." and "flow: Lay strands along a field from any seed, and not
/// overfull", docs/terms.md: a push that rises with beta beyond 2 fills overfull; a beta of 6 with a push of 2 leaves
/// zigzags, since nothing can turn any more and tilted strands are all that still fills. With beta = 4 and a push of 2
/// the share of the length within 15 degrees of the field is the same wherever the seed lies, which with beta = 2 it
/// is not.
inline constexpr double kAlignedGrowth = 1, kMostAlignedGrowth = 2;
inline constexpr double kAlignedPolish = 0.35, kMostAlignedPolish = 1.6;

/// Where strands are nearer than the smaller of these, in local spacings, nothing pushes them along the field; from the
/// larger on all of it does. Measured in the second of these commits: hand_closed had a packing of 1.31 without.
inline constexpr double kOverfull = 0.4, kHardlyOverfull = 0.7;

// ---- Hairpin removal ------------------------------------------------------------------------------------------------

/// This share of the runs between opposite hairpins is drawn in, the shortest, by this length weight. An eighth of the
/// runs, or a weight of 2: within noise (docs/quality.md, "What was tried and did not help").
inline constexpr double kHairpinRemovalShare = 0.2;
inline constexpr double kHairpinRemovalPull = 3;

/// A hairpin turns by more than this, in radians, within this many r; a run that is drawn in is marked with this many r
/// beyond its hairpins. Not measured.
inline constexpr double kHairpinTurn = 2 * std::numbers::pi / 3;
inline constexpr double kHairpinWindow = 4;
inline constexpr double kHairpinMargin = 2;

// ---- The polish -----------------------------------------------------------------------------------------------------

/// The spacing that the polish follows is smoothed along the curve over this many r. Not measured.
inline constexpr double kSpacingSmoothing = 2;

/// Its length weights stay between these. Not measured; the offset and the gain are options.
inline constexpr double kLeastPolishLength = -1, kMostPolishLength = 3;

/// Length weight in a strip along the boundary that is to stay empty, and the highest power q of the polish where such
/// a strip is wider than a spacing: higher ones hardly feel balls smaller than r, which are what pushes strands out of
/// it. "flow: Keep strips along the boundary empty also with the polish's higher power": distances from round holes of
/// 1.92 spacings where 2 are asked for, .85 before.
inline constexpr double kOutOfStrip = 3;
inline constexpr double kMostPowerAtStrips = 4;

// ---- The step -------------------------------------------------------------------------------------------------------

/// A node goes on by this share of its last step while hairpins are removed, and in the polish while segments are long.
/// In growth it makes more hairpins; from 0.7 on in the polish a curve does not come to rest. Measured: docs/quality.md,
/// "Nodes that go on".
inline constexpr double kHairpinRemovalMomentum = 0.7, kPolishMomentum = 0.3;

/// A node moves no more than this share of its medial radius on the side to which it moves, so that it cannot leap over
/// the strand beside it. Not measured: anything below 1 keeps that promise.
inline constexpr double kMostOfRadius = 0.9;

/// But this many r where it is the boundary that ends the ball: in a corner of the surface there may be none at all on
/// either side, and no node could leave it. "boundary_reach: Keep strands from corners, and let them leave one".
inline constexpr double kMostAtBoundary = 0.25;

/// And no more than this many r while the flow cools. So much the last two curves differ by (docs/quality.md).
inline constexpr double kMostWhileCooling = 0.04;

// ---- When a phase ends ----------------------------------------------------------------------------------------------

/// Lengths and curves are compared with those of this many iterations before. Not measured.
inline constexpr size_t kWindow = 10;

/// The paper's rule: |d|_2 / n in r (Table 2), in as many iterations in a row. With few nodes one quiet step is no end:
/// "native: Let the paper's rule hold for ten iterations before it ends a run".
inline constexpr double kPaperLimit = 3e-4;
inline constexpr size_t kPaperIterations = 10;

/// Growth ends when the length changes by less than this share in a window and fewer nodes than this still see nothing
/// beside them, or when the length has all but stopped changing. Not measured.
inline constexpr double kGrownLength = 0.02, kGrownClamped = 0.01;
inline constexpr double kGrownForSure = 0.005;

/// Iterations of the polish with long segments: as far as the picture comes to rest in (docs/quality.md, "Nodes that go
/// on").
inline constexpr uint32_t kPolishIterations = 30;

/// A curve has settled when its length changes by less than this share in a window, and the mean distance of its nodes
/// from what it was is less than so many r: .05 instead of .04 takes a tenth of the work (docs/quality.md).
inline constexpr double kSettledLength = 0.0025, kSettledDistance = 0.05;

/// Iterations with short steps at the end. Not measured.
inline constexpr uint32_t kCoolingIterations = 6;

/// Nodes that move less than this, in r, do not move; when none of those that are to move does in as many iterations
/// in a row, the flow is stuck. With the same weights and curve the next iteration would be the same, so the number
/// only leaves refinement the time to end. The limit is far above rounding and far below any step that counts.
inline constexpr double kIdle = 1e-9;
inline constexpr size_t kIdleIterations = 5;

// ---- Progressive spacing (Fig. 25) ----------------------------------------------------------------------------------

/// The wide curve is there when its length changes by less than this share in a window, or after as many iterations.
/// Not measured.
inline constexpr double kWideGrown = 0.02;
inline constexpr size_t kWideIterations = 150;

/// What the spacing is multiplied by in each iteration from then on. "flow: Let the spacing shrink more slowly from a
/// wide start": 0.98 leaves a quarter more hairpins.
inline constexpr double kShrinking = 0.99;

/// The wide curve is one only if (2 r)^2 fits into the surface this many times. Not measured.
inline constexpr double kWideTurns = 50;

}  // namespace meander::tuning
