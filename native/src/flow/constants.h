// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants of the flow, in the order in which an iteration meets them; curve/constants.h has what is said of each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>

namespace meander {

// ---- The domain -----------------------------------------------------------------------------------------------------

/// The mean distance of nodes, in h, from 1 to 2, between which they are kept. Measured on spheres, tori, a plane and a
/// rough ball with curves of 3,000 to 300,000 nodes.
inline constexpr double kMeanSegment = 1.39;

/// Samples of the boundary are at most this far apart, in h, > 0. Not measured.
inline constexpr double kBoundarySampling = 0.5;

// ---- The plan: hairpin removal --------------------------------------------------------------------------------------

/// This share of the runs between opposite hairpins is drawn in, the shortest; from 0 to 1. An eighth or three tenths
/// of the runs: within noise (docs/decisions.md, "Rough hairpin removal").
inline constexpr double kHairpinRemovalShare = 0.2;

/// The length weight that draws them in, > 0, and the share of its last step with which a node goes on meanwhile, from
/// 0 to 1: of a rough removal, and of a gentle one. A short one has to be rough; roughness that lasts leaves a curve
/// too dense. docs/decisions.md, "Rough hairpin removal".
inline constexpr double kRoughPull = 12, kGentlePull = 3;
inline constexpr double kRoughMomentum = 0.76, kGentleMomentum = 0.7;

/// While hairpins are removed, and in the polish with long segments, a node where a strand doubles back by more than
/// this, in radians, from 0 to pi, is taken out: else a spike may stay for ever, since its tip has an empty ball ahead
/// and none behind. With a gentle removal of hairpins it is the second. docs/decisions.md, "Spikes".
inline constexpr double kMostTurn = 2 * std::numbers::pi / 3, kMostGentleTurn = 5 * std::numbers::pi / 9;

// ---- The plan: the polish, and the end ------------------------------------------------------------------------------

/// Iterations of the polish with long segments, after a rough removal of hairpins and after a gentle one; >= 0. With
/// five iterations for growth 30 instead of 22 leave .004 more near_target and a hairpin less, for 8 % more work (the
/// same place); 60 instead of 22 make `finest` .005 more even, and packing .02 less different from one surface to
/// another; 140 let it cover what is left at the same packing (docs/decisions.md, "Long polish").
inline constexpr uint32_t kPolishIterations = 22, kLongPolishIterations = 140;

/// The same of a curve that fills the surface from its start. Coverage p99 of bunny, hand_closed and stuffedtoy is
/// 1.03, 1.02 and 1.03 after 22, .02 less after 57, and .04 less after 140 (these two with the preset `finest`;
/// docs/decisions.md, "Full start of finest").
inline constexpr uint32_t kFullPolishIterations = 26, kLongFullPolishIterations = 60;

/// The polish measures balls after this many iterations, >= 0. 16 instead of 10 is within noise. docs/decisions.md,
/// "What growth sees".
inline constexpr uint32_t kUnmeasuredPolish = 16;

/// A node goes on by this share of its last step, from 0 to 1, in the polish while segments are long. In growth
/// momentum makes more hairpins; from 0.7 on in the polish a curve does not come to rest. docs/decisions.md,
/// "Momentum"; 0.4 instead of 0.3 is within noise.
inline constexpr double kPolishMomentum = 0.3;

/// A node moves no more than this many r, > 0, while the flow cools, so the last two curves differ by no more
/// (docs/quality.md).
inline constexpr double kMostWhileCooling = 0.04;

/// Below this share of the distance wanted, from 0 to 1, the boundary pushes much harder (see kVeryNear) where the flow
/// follows the paper, whose curves stay what they were.
inline constexpr double kVeryNearOfPaper = 0.7;

// ---- Weights: strands that see nothing ------------------------------------------------------------------------------

/// Length weight where both sides of a strand are empty, < 0. Not measured.
inline constexpr double kIntoEmpty = -1;

/// There one side and the other are favoured in turn by this share of the radius, from 0 to 1, with this wavelength in
/// r, > 0, which has room for two fingers. A wide smooth loop stands still for up to 60 iterations without
/// (docs/decisions.md, "Wide loops"); the two numbers are not measured.
inline constexpr double kPerturbation = 0.3, kPerturbationWavelength = 8;

/// Closed strands shorter than a circle of this radius, in r, >= 0, are not bent or shortened yet. Not measured.
inline constexpr double kYoung = 1.5;

// ---- Weights: a field (eq. 11) --------------------------------------------------------------------------------------

/// The length weight that pushes strands along the field, as a multiple of beta, and its largest value, before a polish
/// and in it; all >= 0. "flow: Lie along fields ..." and "flow: Lay strands along a field from any seed, and not
/// overfull" (docs/decisions.md, "Fields"): a push that rises with beta beyond 2 fills overfull; a beta of 6 with a
/// push of 2 leaves zigzags, since nothing can turn any more and tilted strands are all that still fills. With beta = 4
/// and a push of 2 the share of the length within 15 degrees of the field is the same wherever the seed lies, which
/// with beta = 2 it is not.
inline constexpr double kAlignedGrowth = 1, kMostAlignedGrowth = 2;
inline constexpr double kAlignedPolish = 0.25, kMostAlignedPolish = 1.1;

/// Where strands are nearer than the smaller of these, in local spacings, from 0 to 1, nothing pushes them along the
/// field; from the larger on all of it does. Measured in the second of these commits: hand_closed had a packing of 1.31
/// without.
inline constexpr double kOverfull = 0.4, kHardlyOverfull = 0.7;

/// Where a field's lines are equally far apart, rows of a full start are held straight in the polish: the scale of
/// squared sines there, > 0, from the third of these on, in r along the strand from a turn; up to the second it is 1,
/// as elsewhere. A turn is what lies across by more than 25 degrees, given as a squared sine. docs/decisions.md,
/// "Straight rows".
inline constexpr double kStraightRow = 0.017, kTurnEnds = 2, kRowBegins = 8, kSquareOfTurn = 0.18;

// ---- Weights: the polish --------------------------------------------------------------------------------------------

/// Strands that follow a field come to rest farther apart: by at most the first, in r, and by half of it at the second
/// value of the alignment weight. Less so those that have grown, since the field keeps them from giving way where they
/// are overfull. docs/decisions.md, "The spacing that is asked for".
inline constexpr double kLooserWhereGrown = 0.05, kHalfLooserWhereGrown = 6;
inline constexpr double kLooserWhereLaid = 0.075, kHalfLooserWhereLaid = 3.3;

/// Stiff strands too: as this power of the polish's bending weight over the first, which is the presets' own, between
/// one over the third and the third. A strand that bends less is pushed by wider balls, whose force is the ninth power
/// of their radius with the polish's medial power of 8. Measured from a tenth to ten times: docs/decisions.md, "The
/// spacing that is asked for".
inline constexpr double kUsualBending = 1.2, kLooserWhereStiff = 1.0 / 9, kMostStiffness = 10;

/// From kUnmeasuredPolish on r follows what strands come to. Where they are off the spacing by more than kCloseEnough
/// in the median, > 0, r makes up for kCorrecting of the rest in each iteration, from 0 to 1, and for no more than
/// kMostCorrection in all, from 0 to below 1. With long segments the median is kCoarseSpacing of what it is with short
/// ones, > 0: 1.018 to 1.031 on five models. Where tips are to get round it is to be kBeforeRoundTips of that, > 0, as
/// they push strands apart. docs/decisions.md, "The spacing that is asked for".
inline constexpr double kCorrecting = 0.2, kCloseEnough = 0.008, kMostCorrection = 0.05;
inline constexpr double kCoarseSpacing = 1.02, kBeforeRoundTips = 0.99;

/// Its length weights stay between these, the first of them < 0 and the second > 0. Not measured; the offset and the
/// gain are tunings.
inline constexpr double kLeastPolishLength = -1, kMostPolishLength = 3;

/// Hairpins are kept round: where the curvature, as a mean over the first in r, > 0, to both sides, exceeds the second
/// over r, bending weighs more, and from the third over r on, which is larger, 1 + kHairpinStiffening times as much,
/// >= 0. A hairpin between strands at their spacing has a curvature of 1 / r. Elsewhere there is less bending, so
/// strands yield into the voids before hairpins. docs/decisions.md, "Round hairpins".
inline constexpr double kCurvatureSmoothing = 1.2, kRoundHairpin = 0.9, kTightHairpin = 1.2;
inline constexpr double kHairpinStiffening = 2.5;

/// Once segments are short, the same as a mean over the first in segments, > 1, to both sides: from the second over r
/// on, which is above 1, up to the third, which is larger. docs/decisions.md, "Round hairpins".
inline constexpr double kTipSmoothing = 1.5, kRoundTip = 1.05, kTightTip = 1.25;

/// After a gentle removal of hairpins, bending weighs kBoundaryBending times as much, from 0 to 1, beside the boundary,
/// where a ball is left less than kBesideBoundary r, > 1. After a rough one some tips would come too near to the
/// boundary with less of it. docs/decisions.md, "Voids at the boundary".
inline constexpr double kBesideBoundary = 2, kBoundaryBending = 0.3;

// ---- Weights: the boundary ------------------------------------------------------------------------------------------

/// Length weight, > 0, in a strip along the boundary that is to stay empty, and the highest power q of the polish,
/// >= 2, where such a strip is wider than a spacing: higher ones hardly feel balls smaller than r, which are what
/// pushes strands out of it. "flow: Keep strips along the boundary empty also with the polish's higher power":
/// distances from round holes of 1.92 spacings where 2 are asked for, .85 before.
inline constexpr double kOutOfStrip = 3;
inline constexpr double kMostPowerAtStrips = 4;

/// Factor of the Hessian of the medial term where the boundary pushes harder than an empty ball, from 1 to 8. The force
/// itself falls eight times as fast, and with a factor of 8 voids at the boundary are filled too late.
/// docs/decisions.md, "Necks".
inline constexpr double kPushStiffness = 3;

// ---- The step -------------------------------------------------------------------------------------------------------

/// A node moves no more than this share of its medial radius on the side to which it moves, so that it cannot leap over
/// the strand beside it. Not measured: anything from 0 to below 1 keeps that promise.
inline constexpr double kMostOfRadius = 0.9;

/// But this many r, > 0, where it is the boundary that ends the ball: in a corner of the surface there may be none at
/// all on either side, and no node could leave it. "boundary_reach: Keep strands from corners, and let them leave one".
inline constexpr double kMostAtBoundary = 0.25;

/// No step leads a node nearer to the boundary than the first of these, in r, from 0 to 1, unless it is shorter than
/// the second, so that strands of a narrow strip can move. docs/decisions.md, "Necks".
inline constexpr double kKeptFromBoundary = 0.6, kLeastTowardsBoundary = 0.04;

// ---- When a phase ends ----------------------------------------------------------------------------------------------

/// The paper's rule: |d|_2 / n in r (Table 2), > 0, in as many iterations in a row, >= 1. With few nodes one quiet step
/// is no end: "native: Let the paper's rule hold for ten iterations before it ends a run".
inline constexpr double kPaperLimit = 3e-4;
inline constexpr size_t kPaperIterations = 10;

/// Growth ends when the length changes by less than kGrownLength, as a share, > 0, in kGrowthWindow iterations, >= 1,
/// and a share of less than kGrownClamped of the nodes, from 0 to 1, still see nothing beside them, or when the length
/// changes by less than kGrownForSure, which is smaller. A window of five iterations leaves two hairpins more of fifty,
/// and what is to lie along a field has not turned yet (docs/decisions.md, "Settled").
inline constexpr size_t kGrowthWindow = 10;
inline constexpr double kGrownLength = 0.02, kGrownClamped = 0.01;
inline constexpr double kGrownForSure = 0.005;

/// What is farther than kFarFromNodes from every node, in r, > 2, has no strand that will fill it soon. Where that is
/// more than kMostFar of the area, from 0 to 1, growth is not at its end: the rest is laid, and what is left then
/// is left to strands for as long as it becomes less by kLessFar of the area, > 0, in kGrowthWindow iterations. On all
/// compact surfaces of scripts/fingerprints.py nothing is far when growth ends.
inline constexpr double kFarFromNodes = 3.2, kMostFar = 0.001, kLessFar = 0.0005;

/// A rest that is laid and makes the curve this many times as long, > 1, is what the curve is: it is finished as one
/// that has filled the surface from its start.
inline constexpr double kMostlyLaid = 2;

/// Straight strands side by side lie in balance, and none bends, where each is as far from what is beside it, but
/// farther than kSlack, in r, > 1. Where those are more than kMostSlack of the nodes, from 0 to 1, when growth would
/// end, they are pushed to one and the other side in turn. docs/decisions.md, "Strands in balance".
inline constexpr double kSlack = 1.5, kMostSlack = 0.03;

/// The same where more than this share of the nodes, from 0 to 1, lie alone in strips with room for their way back,
/// which are wider than kWidestAlone, in r: an open strand may lie in the middle of one for ever.
inline constexpr double kMostAlone = 0.01, kWidestAlone = 3.2;

/// And where it has not come to an end after so many iterations for each r of the side of a square as large as the
/// surface, > 0, which is twice as long as from a corner of that: on a long strip only two tips advance.
inline constexpr double kPatience = 1.6;
inline constexpr size_t kLeastPatience = 60;

/// On a long strip that many r are grown along in an iteration, > 0: two tips advance by half of it each.
inline constexpr double kAdvance = 3;

/// Iterations that fit a finished curve to another spacing, up to kPolishIterations. More of them hardly make it more
/// even: near_target of bunny after 10, 15, 20 and 30 is .932, .937, .939 and .943 for a spacing a tenth wider, .950,
/// .953, .952 and .956 for one a tenth closer, and .951 and .955 from scratch (docs/live.md).
inline constexpr uint32_t kFittingIterations = 18;

/// Where the spacing has changed by more than this since the curve grew, as the logarithm of r, > 0, it grows again:
/// fitted in steps of a twentieth to a spacing 5, 10, 15, 20 and 25 % wider, bunny has a near_target of .946, .943,
/// .932, .922 and .908; fitted to half the spacing of .90, of .955 once it has grown again, and of .964 from scratch.
inline constexpr double kMostFitted = 0.22;

/// A curve has settled when its length changes by less than kSettledLength, as a share, > 0, in kSettledWindow
/// iterations, >= 1, and its nodes are in the mean within kSettledDistance r, > 0, of what it was: .05 instead of .04
/// takes a tenth of the work, and 5 iterations instead of 10 another sixth (docs/decisions.md, "Settled").
inline constexpr size_t kSettledWindow = 5;
inline constexpr double kSettledLength = 0.0025, kSettledDistance = 0.05;

/// Tips between a strand and the boundary may swing for ever, and by no less. While the flow waits for rest nodes move
/// no more, in r, than one over the iterations since as many of them have passed, >= 1: a swing ends, and what goes on
/// one way may go any distance. docs/decisions.md, "Swings".
inline constexpr uint32_t kSwinging = 25;

/// Iterations with short steps at the end, >= 1. Four of them: within noise, for a hundredth of the work
/// (docs/decisions.md, "Tried for the shape, and left out").
inline constexpr uint32_t kCoolingIterations = 6;

/// Nodes that move less than this, in r, > 0, do not move; when none of those that are to move does in as many
/// iterations in a row, >= 1, the flow is stuck. With the same weights and curve the next iteration would be the same,
/// so the number only leaves refinement the time to end. The limit is far above rounding and far below any step that
/// counts.
inline constexpr double kIdle = 1e-9;
inline constexpr size_t kIdleIterations = 5;

// ---- Progressive spacing (Fig. 25) ----------------------------------------------------------------------------------

/// The wide curve is complete when its length changes by less than kWideGrown, as a share, > 0, in kWideWindow
/// iterations, or after kWideIterations; both >= 1. Not measured.
inline constexpr double kWideGrown = 0.02;
inline constexpr size_t kWideWindow = 10;
inline constexpr size_t kWideIterations = 150;

/// What the spacing is multiplied by in each iteration from then on, from 0 to below 1. "flow: Let the spacing shrink
/// more slowly from a wide start": 0.98 leaves a quarter more hairpins.
inline constexpr double kShrinking = 0.99;

/// The wide curve is one only if (2 r)^2 fits into the surface this many times, > 0. Not measured.
inline constexpr double kWideTurns = 50;

// ---- Progress, which changes no curve -------------------------------------------------------------------------------

/// The length at which growth ends, over that of a curve that fills the surface; from 0 to 1. Measured on bunny,
/// hand_closed, spot and cube at the radius of docs/performance.md and 1.5 times as much: .83 to .86 in even, as are
/// the next two.
inline constexpr double kLengthWhenGrown = 0.85;

/// The work of growth in iterations with long segments on a curve that fills the surface, > 0: 28 to 39.
inline constexpr double kGrowthWork = 35;

/// Iterations until the curve has settled, > 0: 6 or 11, in one of eight runs 16.
inline constexpr double kFinishingIterations = 8;

/// Where there is no polish: the share of the time until the curve is as long as at the end of growth, the length at
/// which it becomes quiet, above kLengthWhenGrown, and the share of the quiet iterations that end the run; all from 0
/// to 1. "progress: Follow the time to the end of a run".
inline constexpr double kUnpolishedGrowth = 0.4, kUnpolishedLength = 0.98, kUnpolishedEnd = 0.35;

}  // namespace meander
