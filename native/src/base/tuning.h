// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants that decide how a curve grows, in the order in which an iteration meets them.
//
// Each has its unit, and what chose it: a page of docs/, or the commit whose message has the figures. "Not measured"
// means that the first value that was tried has stayed. r is the local r unless something else is said; sizes of
// blocks, limits of rounding and of approximations, and what only saves time stand beside the code that they belong
// to. What callers may choose (weights, powers, numbers of iterations) is not here: the presets of the C API have it.
//
// A change here changes every curve: measure it as docs/quality.md does, and say in docs/decisions.md what chose it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>

namespace meander::tuning {

// ---- The first loops ------------------------------------------------------------------------------------------------

/// The radius of a loop that is wider than the face it begins in, in r. Not measured.
inline constexpr double kFirstLoop = 1.5;

/// The outline of a face whose incircle is smaller than this, in r and as a share of its perimeter, has no room to move
/// in: it would stay where it is for ever. "first_curve: Begin with a circle where the first face is a sliver".
inline constexpr double kTightFace = 0.3, kSliverFace = 0.02;

/// A circle is made no narrower than the first, in r, to fit; the second is the largest share of the distance to
/// the nearest guide that its radius may have. Not measured.
inline constexpr double kNarrowestLoop = 0.01, kLoopShareOfRoom = 0.4;

/// A drawn seed jumps where the path between two neighbouring points is longer than the first times the way between
/// them plus the second in r. Half way round a sphere the path is pi / 2 times the way. Not measured.
inline constexpr double kJumpFactor = 2, kJumpRadii = 2;

// ---- The metric at the nodes, and the boundary ----------------------------------------------------------------------

/// In front of an empty strip wider than this, in spacings, the boundary pushes no harder than other strands do: they
/// have room to give way there, and between two such strips they would never come to rest
/// (docs/decisions.md, "Wide strips").
inline constexpr double kWideStrip = 1;

/// Samples of the boundary are at most this far apart, in h. Not measured.
inline constexpr double kBoundarySampling = 0.5;

/// Along a medial ball's diameter r counts as growing by no less and no more than this, as a share: where the density
/// jumps, the slope at its start says nothing. Not measured; the diameter itself was ("flow: Measure a ball's whole
/// diameter in the local r").
inline constexpr double kLeastRadiusGrowth = -0.75, kMostRadiusGrowth = 3;

// ---- The medial balls -----------------------------------------------------------------------------------------------

/// Balls grow along the chord to where a geodesic arrives after this much of r: most of the distance to the centre of a
/// ball of the wanted size. Farther, and strands on thin limbs come to lie too far apart; nearer, and those at creases
/// come too close. Spot at twice the radius: near_target .81 in the mean, .80 with a whole r (docs/decisions.md,
/// "Chords").
inline constexpr double kChord = 0.75;

/// A node keeps its directions while it is no farther than this from where it found them, in r, and its strand has
/// turned by less than this since, as a sine. Measured: docs/decisions.md, "What stands still".
inline constexpr double kRest = 0.05, kTurn = 0.1;

/// A node keeps a ball that was measured along the surface while it is no farther than the first of these from where
/// that was, in r, and the straight ball differs from what it was by less than the second, as a share. It is measured again
/// after kBallIterations at the latest, what had to be searched for after kSearchedIterations. Measured:
/// docs/decisions.md, "Kept balls".
inline constexpr double kBallRest = 0.1, kBallChange = 0.1;
inline constexpr uint32_t kBallIterations = 6, kSearchedIterations = 4;

/// The polish measures balls after this many iterations. 16 instead of 10 is within noise. Measured: docs/decisions.md,
/// "What growth sees".
inline constexpr uint32_t kUnmeasuredPolish = 16;

/// Weight of the radius that a ball lacks at the boundary: 2, or 1 in gentle runs; below a share kVeryNear of the
/// distance wanted kVeryNearPush is added to it. "flow: Let the boundary push twice as hard ..." and
/// "boundary_reach: Keep strands from corners ..."; docs/decisions.md, "Push of the boundary".
inline constexpr double kPush = 2, kEasedPush = 1;
inline constexpr double kVeryNear = 0.8, kVeryNearPush = 6;

/// The first of these where the flow follows the paper, whose curves stay what they were.
inline constexpr double kVeryNearOfPaper = 0.7;

/// Factor of the Hessian of the medial term where the boundary pushes harder than an empty ball. The force itself
/// falls eight times as fast, and with a factor of 8 voids at the boundary are filled too late. Measured:
/// docs/decisions.md, "Necks".
inline constexpr double kPushStiffness = 3;

/// What of the boundary is turned to a side of a node by less than this, as a cosine, does not limit its ball. Not
/// measured.
inline constexpr double kFacing = 0.5;

// ---- Strands that see nothing ---------------------------------------------------------------------------------------

/// Length weight where both sides of a strand are empty. Not measured.
inline constexpr double kIntoEmpty = -1;

/// There one side and the other are favoured in turn by this share of the radius, with this wavelength in r, which has
/// room for two fingers. A wide smooth loop stands still for up to 60 iterations without (docs/decisions.md, "Wide
/// loops"); the two numbers are not measured.
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

/// What is added to the length weights of a polish to the same end: the first, and the second for each unit of q.
/// Measured likewise: growth with q above 2 leaves the curve 7 to 16 % too dense. With a bending of 1.2 in the
/// polish the spacing is .86 to .90 of the one asked for; .5 instead of .8 leaves .84 to .87.
inline constexpr double kPolishBalance = 0.8, kPolishBalanceSlope = 0.05;

// ---- A field (eq. 11) -----------------------------------------------------------------------------------------------

/// The length weight that pushes strands along the field, as a multiple of beta, and its largest value, before a
/// polish and in it. Measured in "flow: Lie along fields ..." and "flow: Lay strands along a field from any seed,
/// and not overfull" (docs/decisions.md, "Fields"): a push that rises with beta beyond 2 fills overfull; a beta of
/// 6 with a push of 2 leaves zigzags, since nothing can turn any more and tilted strands are all that still fills.
/// With beta = 4 and a push of 2 the share of the length within 15 degrees of the field is the same wherever the
/// seed lies, which with beta = 2 it is not.
inline constexpr double kAlignedGrowth = 1, kMostAlignedGrowth = 2;
inline constexpr double kAlignedPolish = 0.25, kMostAlignedPolish = 1.1;

/// Where strands are nearer than the smaller of these, in local spacings, nothing pushes them along the field; from the
/// larger on all of it does. Measured in the second of these commits: hand_closed had a packing of 1.31 without.
inline constexpr double kOverfull = 0.4, kHardlyOverfull = 0.7;

// ---- Hairpin removal ------------------------------------------------------------------------------------------------

/// This share of the runs between opposite hairpins is drawn in, the shortest. An eighth or three tenths of the runs:
/// within noise (docs/decisions.md, "Rough hairpin removal").
inline constexpr double kHairpinRemovalShare = 0.2;

/// The length weight that draws them in, and the share of its last step with which a node goes on meanwhile: of a rough
/// removal, and of a gentle one. A short one has to be rough; roughness that lasts leaves a curve too dense. Measured:
/// docs/decisions.md, "Rough hairpin removal".
inline constexpr double kRoughPull = 12, kGentlePull = 3;
inline constexpr double kRoughMomentum = 0.76, kGentleMomentum = 0.7;

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

/// Hairpins are kept round: where the curvature, as a mean over the first in r to both sides, exceeds the second
/// over r, bending weighs more, and from the third over r on 1 + kHairpinStiffening times as much. A hairpin
/// between strands at their spacing has a curvature of 1 / r. Elsewhere there is less bending, so strands yield
/// into the voids before hairpins. Measured: docs/decisions.md, "Round hairpins".
inline constexpr double kCurvatureSmoothing = 1.2, kRoundHairpin = 0.9, kTightHairpin = 1.2;
inline constexpr double kHairpinStiffening = 2.5;

/// After a gentle removal of hairpins, bending weighs kBoundaryBending times as much beside the boundary, where a
/// ball is left less than kBesideBoundary r. After a rough one some tips would come too near to the boundary with
/// less of it. Measured: docs/decisions.md, "Voids at the boundary".
inline constexpr double kBesideBoundary = 2, kBoundaryBending = 0.3;

/// Length weight in a strip along the boundary that is to stay empty, and the highest power q of the polish where such
/// a strip is wider than a spacing: higher ones hardly feel balls smaller than r, which are what pushes strands out of
/// it. "flow: Keep strips along the boundary empty also with the polish's higher power": distances from round holes of
/// 1.92 spacings where 2 are asked for, .85 before.
inline constexpr double kOutOfStrip = 3;
inline constexpr double kMostPowerAtStrips = 4;

// ---- The step -------------------------------------------------------------------------------------------------------

/// A node goes on by this share of its last step in the polish while segments are long. In growth momentum makes more
/// hairpins; from 0.7 on in the polish a curve does not come to rest. Measured: docs/decisions.md, "Momentum"; 0.4
/// instead of 0.3 is within noise.
inline constexpr double kPolishMomentum = 0.3;

/// A node moves no more than this share of its medial radius on the side to which it moves, so that it cannot leap over
/// the strand beside it. Not measured: anything below 1 keeps that promise.
inline constexpr double kMostOfRadius = 0.9;

/// But this many r where it is the boundary that ends the ball: in a corner of the surface there may be none at all on
/// either side, and no node could leave it. "boundary_reach: Keep strands from corners, and let them leave one".
inline constexpr double kMostAtBoundary = 0.25;

/// No step leads a node nearer to the boundary than the first of these, in r, unless it is shorter than the second, so
/// that strands of a narrow strip can move. Measured: docs/decisions.md, "Necks".
inline constexpr double kKeptFromBoundary = 0.6, kLeastTowardsBoundary = 0.04;

/// A node moves no more than this many r while the flow cools, so the last two curves differ by no more
/// (docs/quality.md).
inline constexpr double kMostWhileCooling = 0.04;

/// While hairpins are removed, and in the polish with long segments, a node where a strand doubles back by more than
/// this, in radians, is taken out: else a spike may stay for ever, since its tip has an empty ball ahead and none
/// behind. With a gentle removal of hairpins it is the second. Measured: docs/decisions.md, "Spikes".
inline constexpr double kMostTurn = 2 * std::numbers::pi / 3, kMostGentleTurn = 5 * std::numbers::pi / 9;

// ---- When a phase ends ----------------------------------------------------------------------------------------------

/// The paper's rule: |d|_2 / n in r (Table 2), in as many iterations in a row. With few nodes one quiet step is no end:
/// "native: Let the paper's rule hold for ten iterations before it ends a run".
inline constexpr double kPaperLimit = 3e-4;
inline constexpr size_t kPaperIterations = 10;

/// Growth ends when the length changes by less than kGrownLength, as a share, in kGrowthWindow iterations and a
/// share of less than kGrownClamped of the nodes still see nothing beside them, or when the length changes by less
/// than kGrownForSure. A window of five iterations leaves two hairpins more of fifty, and what is to lie along a
/// field has not turned yet (docs/decisions.md, "Settled").
inline constexpr size_t kGrowthWindow = 10;
inline constexpr double kGrownLength = 0.02, kGrownClamped = 0.01;
inline constexpr double kGrownForSure = 0.005;

/// Iterations of the polish with long segments, after a rough removal of hairpins and after a gentle one. With five
/// iterations for growth 30 instead of 22 leave .004 more near_target and a hairpin less, for 8 % more work (the same
/// place); 60 instead of 22 make `finest` .005 more even, and packing .02 less different from one surface to another;
/// 140 let it cover what is left at the same packing (docs/decisions.md, "Long polish").
inline constexpr uint32_t kPolishIterations = 22, kLongPolishIterations = 140;

/// The same of a curve that fills the surface from its start. Coverage p99 of bunny, hand_closed and stuffedtoy is
/// 1.03, 1.02 and 1.03 after 22, .02 less after 57, and .04 less after 140 (these two with the preset `finest`).
inline constexpr uint32_t kFullPolishIterations = 30, kLongFullPolishIterations = 60;

/// Iterations that fit a finished curve to another spacing. More of them hardly make it more even: near_target of
/// bunny after 10, 15, 20 and 30 is .932, .937, .939 and .943 for a spacing a tenth wider, .950, .953, .952 and
/// .956 for one a tenth closer, and .951 and .955 from scratch (docs/live.md).
inline constexpr uint32_t kFittingIterations = 18;

/// Where the spacing has changed by more than this since the curve grew, as the logarithm of r, it grows again: fitted
/// in steps of a twentieth to a spacing 5, 10, 15, 20 and 25 % wider, bunny has a near_target of .946, .943, .932, .922
/// and .908; fitted to half the spacing of .90, of .955 once it has grown again, and of .964 from scratch.
inline constexpr double kMostFitted = 0.22;

/// A curve has settled when its length changes by less than kSettledLength, as a share, in kSettledWindow
/// iterations, and its nodes are in the mean within kSettledDistance r of what it was: .05 instead of .04 takes a
/// tenth of the work, and 5 iterations instead of 10 another sixth (docs/decisions.md, "Settled").
inline constexpr size_t kSettledWindow = 5;
inline constexpr double kSettledLength = 0.0025, kSettledDistance = 0.05;

/// Iterations with short steps at the end. Four of them: within noise, for a hundredth of the work
/// (docs/decisions.md, "Tried for the shape, and left out").
inline constexpr uint32_t kCoolingIterations = 6;

/// Nodes that move less than this, in r, do not move; when none of those that are to move does in as many iterations
/// in a row, the flow is stuck. With the same weights and curve the next iteration would be the same, so the number
/// only leaves refinement the time to end. The limit is far above rounding and far below any step that counts.
inline constexpr double kIdle = 1e-9;
inline constexpr size_t kIdleIterations = 5;

// ---- Progressive spacing (Fig. 25) ----------------------------------------------------------------------------------

/// The wide curve is complete when its length changes by less than kWideGrown, as a share, in kWideWindow
/// iterations, or after kWideIterations. Not measured.
inline constexpr double kWideGrown = 0.02;
inline constexpr size_t kWideWindow = 10;
inline constexpr size_t kWideIterations = 150;

/// What the spacing is multiplied by in each iteration from then on. "flow: Let the spacing shrink more slowly from a
/// wide start": 0.98 leaves a quarter more hairpins.
inline constexpr double kShrinking = 0.99;

/// The wide curve is one only if (2 r)^2 fits into the surface this many times. Not measured.
inline constexpr double kWideTurns = 50;

// ---- Progress, which changes no curve -------------------------------------------------------------------------------

/// The length at which growth ends, over that of a curve that fills the surface. Measured on bunny, hand_closed, spot
/// and cube at the radius of docs/performance.md and 1.5 times as much: .83 to .86 in even, as are the next two.
inline constexpr double kLengthWhenGrown = 0.85;

/// The work of growth in iterations with long segments on a curve that fills the surface: 28 to 39.
inline constexpr double kGrowthWork = 35;

/// Iterations until the curve has settled: 6 or 11, in one of eight runs 16.
inline constexpr double kFinishingIterations = 8;

/// Where there is no polish: the share of the time until the curve is as long as at the end of growth, the length at
/// which it becomes quiet, and the share of the quiet iterations that end the run.
inline constexpr double kUnpolishedGrowth = 0.4, kUnpolishedLength = 0.98, kUnpolishedEnd = 0.35;

}  // namespace meander::tuning
