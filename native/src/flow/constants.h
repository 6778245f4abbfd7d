// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants of the flow, in the order in which an iteration meets them; curve/constants.h says how to read a line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>

namespace meander {

// ---- The domain -----------------------------------------------------------------------------------------------------

/// The mean distance of nodes, which are kept between 1 and 2 h apart. Measured on spheres, tori, a plane and a rough
/// ball with curves of 3,000 to 300,000 nodes.
inline constexpr double kMeanSegment = 1.39;                // h; 1 to 2; above
/// More nodes than this are refused, for want of memory.
inline constexpr double kMostNodes = 5e8;                   // nodes; > 0; free

/// A curve of so many times as many nodes has become finer, and takes other memory.
inline constexpr double kMuchFiner = 1.5;                   // times; 1 to 2; free

/// Samples of the boundary are at most this far apart.
inline constexpr double kBoundarySampling = 0.5;            // h; > 0; free

/// On narrow strips r is less than was asked for, but no less than kLeastOfRadius: there segments are so short that a
/// strip takes hundreds of times as many as a square of its area. A line along the middle fills a strip up to the width
/// kAlongMiddle, and two strands do it better from there on: what one is farther from both sides than r, over r, is
/// what r is over the distance of the two.
inline constexpr double kLeastOfRadius = 0.1;               // share of r; 0 to 1; "Narrow strips"
inline constexpr double kAlongMiddle = 2 * std::numbers::sqrt2;  // r; > 2; geometry

// ---- The plan: hairpin removal --------------------------------------------------------------------------------------

/// Of the runs between opposite hairpins this share is drawn in, the shortest ones.
inline constexpr double kHairpinRemovalShare = 0.2;         // share of the runs; 0 to 1; "Rough hairpin removal"

/// The length weight that draws them in, and the share of its last step with which a node goes on meanwhile: of a rough
/// removal, and of a gentle one. A short one has to be rough; roughness that lasts leaves a curve too dense.
inline constexpr double kRoughPull = 12;                    // length weight; > 0; "Rough hairpin removal"
inline constexpr double kGentlePull = 3;                    // length weight; > 0; "Rough hairpin removal"
inline constexpr double kRoughMomentum = 0.76;              // share of a step; 0 to 1; "Rough hairpin removal"
inline constexpr double kGentleMomentum = 0.7;              // share of a step; 0 to 1; "Rough hairpin removal"

/// While hairpins are removed, and in the polish with long segments, a node is taken out where its strand doubles back
/// by more than kMostTurn, or by more than kMostGentleTurn after a gentle removal. Otherwise a spike may stay for ever,
/// since its tip has an empty ball ahead and none behind.
inline constexpr double kMostTurn = 2 * std::numbers::pi / 3;  // radians; 0 to pi; "Spikes"
inline constexpr double kMostGentleTurn = 5 * std::numbers::pi / 9;  // radians; 0 to pi; "Spikes"

// ---- The plan: the polish, and the end ------------------------------------------------------------------------------

/// Iterations of the polish with long segments, after a rough removal of hairpins and after a gentle one. With five
/// iterations for growth 30 instead of 22 leave .004 more near_target and a hairpin less, for 8 % more work; 60 instead
/// of 22 make `finest` .005 more even, and packing .02 less different from one surface to another.
inline constexpr uint32_t kPolishIterations = 22;           // iterations; >= 0; "Long polish"
inline constexpr uint32_t kLongPolishIterations = 140;      // iterations; >= 0; "Long polish"

/// The same of a curve that fills the surface from its start.
inline constexpr uint32_t kFullPolishIterations = 26;       // iterations; >= 0; "Round hairpins"
inline constexpr uint32_t kLongFullPolishIterations = 60;   // iterations; >= 0; "Full start of finest"

/// And of one on strips that are all narrower than two spacings: nothing can turn there, and segments are as long as
/// they will be.
inline constexpr uint32_t kNarrowPolishIterations = 8;      // iterations; >= 0; "Narrow strips"

/// The polish measures balls after this many iterations. 10 instead of 16 is within noise.
inline constexpr uint32_t kUnmeasuredPolish = 16;           // iterations; >= 0; "What growth sees"

/// A node goes on by this share of its last step in the polish while segments are long; .4 is within noise. In growth
/// momentum makes more hairpins; from .7 on in the polish a curve does not come to rest.
inline constexpr double kPolishMomentum = 0.3;              // share of a step; 0 to 1; "Momentum"

/// A node moves no farther than this in an iteration while the flow cools, so the last two curves differ by no more
/// (docs/quality.md).
inline constexpr double kMostWhileCooling = 0.04;           // r; > 0; free

/// Nearer to the boundary than this it pushes much harder where the flow follows the paper, whose curves stay what they
/// were; kVeryNear elsewhere.
inline constexpr double kVeryNearOfPaper = 0.7;             // share of the distance; 0 to 1; "Push of the boundary"

// ---- Weights: strands that see nothing ------------------------------------------------------------------------------

/// Length weight where both sides of a strand are empty.
inline constexpr double kIntoEmpty = -1;                    // length weight; < 0; free

/// There one side and the other are favoured in turn, by this share of the radius and with this wavelength, which has
/// room for two fingers. Without it a wide smooth loop stands still for up to 60 iterations ("Wide loops").
inline constexpr double kPerturbation = 0.3;                // share of r; 0 to 1; free
inline constexpr double kPerturbationWavelength = 8;        // r; > 0; free

/// Closed strands shorter than a circle of this radius are not bent or shortened yet.
inline constexpr double kYoung = 1.5;                       // r; >= 0; free

// ---- Weights: a field (eq. 11) --------------------------------------------------------------------------------------

/// The length weight that pushes strands along the field, as a multiple of beta, and its largest value, before the
/// polish and in it. A push that rises with beta beyond 2 fills overfull; a beta of 6 with a push of 2 leaves zigzags,
/// since nothing can turn any more and tilted strands are all that still fills. With a beta of 4 and a push of 2 the
/// share of the length within 15 degrees of the field is the same wherever the seed lies; with a beta of 2 it is not.
inline constexpr double kAlignedGrowth = 1;                 // times beta; >= 0; "Fields"
inline constexpr double kMostAlignedGrowth = 2;             // length weight; >= 0; "Fields"
inline constexpr double kAlignedPolish = 0.25;              // times beta; >= 0; "Fields"
inline constexpr double kMostAlignedPolish = 1.1;           // length weight; >= 0; "Fields"

/// Where strands are nearer than kOverfull nothing pushes them along the field; from kHardlyOverfull on all of it does.
/// Without, hand_closed had a packing of 1.31: "flow: Lay strands along a field from any seed, and not overfull".
inline constexpr double kOverfull = 0.4;                    // spacings; 0 to kHardlyOverfull; above
inline constexpr double kHardlyOverfull = 0.7;              // spacings; 0 to 1; above

/// Where a field's lines are equally far apart, rows of a full start are held straight in the polish: the scale of
/// squared sines is 1, as elsewhere, up to kTurnEnds along the strand from a turn, and kStraightRow from kRowBegins on.
/// A turn is what lies across by more than 25 degrees.
inline constexpr double kStraightRow = 0.017;               // squared sine; > 0; "Straight rows"
inline constexpr double kTurnEnds = 2;                      // r; 0 to kRowBegins; "Straight rows"
inline constexpr double kRowBegins = 8;                     // r; > 0; "Straight rows"
inline constexpr double kSquareOfTurn = 0.18;               // squared sine; 0 to 1; geometry

/// There they are also drawn to their places; and r is kRowsFill times as large as their distance asks for, since turns
/// of rows that are too far apart grow in between, and kRowsRoundFill times where they end at tips of other rows. Few
/// rows may be far from the spacing: r follows by no more than kMostOfRows.
inline constexpr double kHoldOfRow = 100;                   // weight; >= 0; "Straight rows"
inline constexpr double kRowsFill = 1.02;                   // times; >= 1; "Straight rows"
inline constexpr double kRowsRoundFill = 1.05;              // times; >= kRowsFill; "Straight rows"
inline constexpr double kMostOfRows = 0.15;                 // share of r; 0 to 1; free

// ---- Weights: the polish --------------------------------------------------------------------------------------------

/// Strands that follow a field come to rest farther apart: by at most the first, and by half of it at the second value
/// of the alignment weight. Less so those that have grown, since the field keeps them from giving way where they are
/// overfull.
inline constexpr double kLooserWhereGrown = 0.05;           // share of r; 0 to 1; "The spacing that is asked for"
inline constexpr double kHalfLooserWhereGrown = 6;          // alignment; > 0; "The spacing that is asked for"
inline constexpr double kLooserWhereLaid = 0.075;           // share of r; 0 to 1; "The spacing that is asked for"
inline constexpr double kHalfLooserWhereLaid = 3.3;         // alignment; > 0; "The spacing that is asked for"

/// Stiff strands do so too: by the polish's bending weight over kUsualBending, which is the presets' own, to the power
/// of kLooserWhereStiff. A strand that bends less is pushed by wider balls, whose force is the ninth power of their
/// radius with the polish's medial power of 8. The ratio is kept between 1 / kMostStiffness and kMostStiffness.
inline constexpr double kUsualBending = 1.2;                // bending weight; > 0; "Round hairpins"
inline constexpr double kLooserWhereStiff = 1.0 / 9;        // power; 0 to 1; geometry
inline constexpr double kMostStiffness = 10;                // ratio; > 1; "The spacing that is asked for"

/// From kUnmeasuredPolish on r follows what strands come to. Where they are off the spacing by more than kCloseEnough
/// in the median, r makes up for kCorrecting of the rest in each iteration, and for no more than kMostCorrection in
/// all. With long segments the median is kCoarseSpacing of what it is with short ones: 1.018 to 1.031 on five models.
/// Where tips are to get round it is to be kBeforeRoundTips of that, as they push strands apart, and less where these
/// have grown by themselves, with more tips and larger voids beside them.
inline constexpr double kCorrecting = 0.2;                  // share of it; 0 to 1; "The spacing that is asked for"
inline constexpr double kCloseEnough = 0.008;               // share of it; > 0; "The spacing that is asked for"
inline constexpr double kMostCorrection = 0.05;             // share of r; 0 to 1; "The spacing that is asked for"
inline constexpr double kCoarseSpacing = 1.02;              // ratio; > 0; above
inline constexpr double kBeforeRoundTips = 0.99;            // ratio; > 0; "The spacing that is asked for"
inline constexpr double kBeforeRoundTipsWhereGrown = 0.975;  // ratio; > 0; "The spacing that is asked for"

/// A median of more nodes says no more.
inline constexpr uint32_t kEnoughForMedian = 65536;         // nodes; >= 1; free

/// polish_rest where strands of the presets' stiffness come to rest on a usual surface.
inline constexpr double kUsualRest = 0.968;                 // share of r; 0 to 1; "The spacing that is asked for"

/// Length weights of the polish stay between these; their offset and gain are tunings.
inline constexpr double kLeastPolishLength = -1;            // length weight; < 0; free
inline constexpr double kMostPolishLength = 3;              // length weight; > 0; free

/// Hairpins are kept round: where the curvature, as a mean over kCurvatureSmoothing to both sides, exceeds
/// kRoundHairpin bending weighs more, and from kTightHairpin on 1 + kHairpinStiffening times as much. A hairpin between
/// strands at their spacing has a curvature of 1 / r. Elsewhere there is less bending, so strands yield into the voids
/// before hairpins.
inline constexpr double kCurvatureSmoothing = 1.2;          // r; > 0; "Round hairpins"
inline constexpr double kRoundHairpin = 0.9;                // 1 / r; > 0; "Round hairpins"
inline constexpr double kTightHairpin = 1.2;                // 1 / r; > kRoundHairpin; "Round hairpins"
inline constexpr double kHairpinStiffening = 2.5;           // times; >= 0; "Round hairpins"

/// The same for tips once segments are short, as a mean over kTipSmoothing to both sides. In a full start bending
/// weighs up to 1 + kTipStiffening times as much there.
inline constexpr double kTipSmoothing = 1.5;                // segments; > 1; "Round hairpins"
inline constexpr double kRoundTip = 1.05;                   // 1 / r; > 1; "Round hairpins"
inline constexpr double kTightTip = 1.25;                   // 1 / r; > kRoundTip; "Round hairpins"
inline constexpr double kTipStiffening = 3;                 // times; >= 0; "Round hairpins"

/// After a gentle removal of hairpins, bending weighs kBoundaryBending times as much beside the boundary, where a ball
/// is left less than kBesideBoundary. After a rough one some tips would come too near to the boundary with less of it.
inline constexpr double kBesideBoundary = 2;                // r; > 1; "Voids at the boundary"
inline constexpr double kBoundaryBending = 0.3;             // times; 0 to 1; "Voids at the boundary"

// ---- Weights: the boundary ------------------------------------------------------------------------------------------

/// Length weight in a strip along the boundary that is to stay empty, and the highest power q of the polish where such
/// a strip is wider than a spacing: higher ones hardly feel balls smaller than r, which are what pushes strands out of
/// it. "flow: Keep strips along the boundary empty also with the polish's higher power": distances from round holes of
/// 1.92 spacings where 2 are asked for, .85 before.
inline constexpr double kOutOfStrip = 3;                    // length weight; > 0; above
inline constexpr double kMostPowerAtStrips = 4;             // power; >= 2; above

/// Factor of the Hessian of the medial term where the boundary pushes harder than an empty ball. The force itself falls
/// eight times as fast, and with a factor of 8 voids at the boundary are filled too late.
inline constexpr double kPushStiffness = 3;                 // times; 1 to 8; "Necks"

/// Two strands between boundaries 3 r apart, which leave a ball less than kSqueezedRoom: the push of the boundary falls
/// twice as fast as that of the ball between them grows, so steps half as long again as Newton's lead 2.25 times as far
/// as they should, and back. With twice the stiffness both come to rest.
inline constexpr double kSqueezedRoom = 0.9;                // r; 0 to 1; free
inline constexpr double kSqueezedStiffness = 2;             // times; 1 to 8; geometry

// ---- The step -------------------------------------------------------------------------------------------------------

/// A node moves no farther than this share of its medial radius on the side to which it moves, so that it cannot leap
/// over the strand beside it: anything below 1 keeps that promise.
inline constexpr double kMostOfRadius = 0.9;                // medial radii; 0 to 1; free

/// But this far where it is the boundary that ends the ball: in a corner of the surface there may be none at all on
/// either side, and no node could leave it. "boundary_reach: Keep strands from corners, and let them leave one".
inline constexpr double kMostAtBoundary = 0.25;             // r; > 0; above

/// No step leads a node nearer to the boundary than kKeptFromBoundary unless it is shorter than kLeastTowardsBoundary,
/// so that strands of a narrow strip can move.
inline constexpr double kKeptFromBoundary = 0.6;            // r; 0 to 1; "Necks"
inline constexpr double kLeastTowardsBoundary = 0.04;       // r; > 0; "Necks"

/// Where r varies, parts of a cut guide may be long for the r at their own ends, and are cut again: at most so often.
inline constexpr int kMostGuideCuts = 10;                   // times; >= 1; free

/// An iteration looks at the path of one in this many segments, and each has its turn.
inline constexpr size_t kPathTurns = 8;                     // iterations; >= 1; free

// ---- When a phase ends ----------------------------------------------------------------------------------------------

/// The paper's rule: |d|_2 / n (Table 2) is below kPaperLimit in kPaperIterations in a row. With few nodes one quiet
/// step is no end: "native: Let the paper's rule hold for ten iterations before it ends a run".
inline constexpr double kPaperLimit = 3e-4;                 // r; > 0; above
inline constexpr size_t kPaperIterations = 10;              // iterations; >= 1; above

/// Growth ends when the length changes by less than kGrownLength in kGrowthWindow and less than kGrownClamped of the
/// nodes still see nothing beside them, or when the length changes by less than kGrownForSure. A window of five leaves
/// two hairpins more of fifty, and what is to lie along a field has not turned yet.
inline constexpr size_t kGrowthWindow = 10;                 // iterations; >= 1; "Settled"
inline constexpr double kGrownLength = 0.02;                // share of the length; > 0; "Settled"
inline constexpr double kGrownClamped = 0.01;               // share of the nodes; 0 to 1; free
inline constexpr double kGrownForSure = 0.005;              // share of the length; 0 to kGrownLength; free

/// A medial radius that is this near to its clamp is one that found nothing.
inline constexpr double kClamped = 0.999999999;             // share of it; 0 to 1; free

/// It also ends when the curve has been no longer, by kGrownForSure, in kSwingWindow than before.
inline constexpr size_t kSwingWindow = 60;                  // iterations; >= 1; "Growth that swings"

/// What is farther than kFarFromNodes from every node has no strand that will fill it soon. Where that is more than
/// kMostFar, growth is not at its end: the rest is laid, and what is left then is left to strands for as long as it
/// becomes less by kLessFar in kGrowthWindow. On all compact surfaces of scripts/fingerprints.py nothing is far when
/// growth ends. Parts of faces are divided until they reach no farther than kFarGrain from their middle.
inline constexpr double kFarFromNodes = 3.2;                // r; > 2; "The rest is laid"
inline constexpr double kMostFar = 0.001;                   // share of the area; 0 to 1; free
inline constexpr double kLessFar = 0.0005;                  // share of the area; > 0; free
inline constexpr double kFarGrain = 0.7;                    // r; > 0; free

/// A rest that is laid and makes the curve this many times as long is what the curve is: it is finished as one that has
/// filled the surface from its start.
inline constexpr double kMostlyLaid = 2;                    // times; > 1; "The rest is laid"

/// Straight strands side by side lie in balance, and none bends, where each is as far from what is beside it, but
/// farther than kSlack, for a kPerturbationWavelength or more. Where any do when growth would end, or strands too short
/// for that have more than kMostSlack of the nodes there, they are pushed to one and the other side in turn.
inline constexpr double kSlack = 1.5;                       // r; > 1; "Strands in balance"
inline constexpr double kMostSlack = 0.03;                  // share of the nodes; 0 to 1; "Strands in balance"

/// A way back is laid where more than kMostAlone of the nodes lie alone in strips with room for one, which are wider
/// than kWidestAlone: an open strand may lie in the middle of one for ever.
inline constexpr double kMostAlone = 0.01;                  // share of the nodes; 0 to 1; free
inline constexpr double kWidestAlone = 3.2;                 // r; > 2; free

/// What is far is also asked where growth has not ended after kLeastPatience and kPatience for each r of the side of a
/// square as large as the surface, which is twice as long as from a corner of that: on a long strip only two tips
/// advance.
inline constexpr double kPatience = 1.6;                    // iterations / r; > 0; geometry
inline constexpr size_t kLeastPatience = 60;                // iterations; >= 0; free

/// This much of a long strip is grown along in an iteration: two tips advance by half of it each.
inline constexpr double kAdvance = 3;                       // r; > 0; "Too long to grow"

/// Iterations that fit a finished curve to another spacing, up to kPolishIterations. More of them hardly make it more
/// even: near_target of bunny after 10, 15, 20 and 30 is .932, .937, .939 and .943 for a spacing a tenth wider, .950,
/// .953, .952 and .956 for one a tenth closer, and .951 and .955 from scratch (docs/live.md).
inline constexpr uint32_t kFittingIterations = 18;          // iterations; >= 1; above

/// Where the spacing has changed by more than this since the curve grew, it grows again: fitted in steps of a twentieth
/// to a spacing 5, 10, 15, 20 and 25 % wider, bunny has a near_target of .946, .943, .932, .922 and .908; fitted to
/// half the spacing of .90, of .955 once it has grown again, and of .964 from scratch.
inline constexpr double kMostFitted = 0.22;                 // logarithm of r; > 0; above

/// A curve has settled when its length changes by less than kSettledLength in kSettledWindow and its nodes are in the
/// mean within kSettledDistance of what it was: .05 instead of .04 takes a tenth of the work, and 5 iterations instead
/// of 10 another sixth.
inline constexpr size_t kSettledWindow = 5;                 // iterations; >= 1; "Settled"
inline constexpr double kSettledLength = 0.0025;            // share of the length; > 0; "Settled"
inline constexpr double kSettledDistance = 0.05;            // r; > 0; "Settled"

/// Tips between a strand and the boundary may swing for ever, and by no less. From iteration kSwinging of the wait for
/// rest on nodes move no farther than r over its number: a swing ends, and what goes on one way may go any distance.
inline constexpr uint32_t kSwinging = 25;                   // iterations; >= 1; "Swings"

/// Iterations with short steps at the end. Four of them are within noise, for a hundredth of the work.
inline constexpr uint32_t kCoolingIterations = 6;           // iterations; >= 1; "Tried for the shape, and left out"

/// Nodes that move less than kIdle do not move; when none of those that are to move does in kIdleIterations in a row,
/// the flow is stuck. With the same weights and curve the next iteration would be the same, so the number only leaves
/// refinement the time to end. The limit is far above rounding and far below any step that counts.
inline constexpr double kIdle = 1e-9;                       // r; > 0; free
inline constexpr size_t kIdleIterations = 5;                // iterations; >= 1; free

// ---- Progressive spacing (Fig. 25) ----------------------------------------------------------------------------------

/// The wide curve is complete when its length changes by less than kWideGrown in kWideWindow, or after kWideIterations.
inline constexpr double kWideGrown = 0.02;                  // share of the length; > 0; free
inline constexpr size_t kWideWindow = 10;                   // iterations; >= 1; free
inline constexpr size_t kWideIterations = 150;              // iterations; >= 1; free

/// What the spacing is multiplied by in each iteration from then on. "flow: Let the spacing shrink more slowly from a
/// wide start": .98 leaves a quarter more hairpins.
inline constexpr double kShrinking = 0.99;                  // times; 0 to 1; above

/// The wide curve is one only if (2 r)^2 fits into the surface this many times.
inline constexpr double kWideTurns = 50;                    // times; > 0; free

// ---- Progress, which changes no curve -------------------------------------------------------------------------------

/// The length at which growth ends, over that of a curve that fills the surface; the work of growth, in iterations with
/// long segments on such a curve; and iterations until the curve has settled. Measured in `even` on bunny, hand_closed,
/// spot and cube at the radius of docs/performance.md and 1.5 times as much: .83 to .86; 28 to 39; 16 to 31, 11
/// to 24 from a full start.
inline constexpr double kLengthWhenGrown = 0.85;            // share of the length; 0 to 1; above
inline constexpr double kGrowthWork = 35;                   // iterations; > 0; above
inline constexpr double kFinishingIterations = 16;          // iterations; > 0; above

/// Of a curve that begins full, the work of laying it, in such iterations, those until it is seen that it grows no
/// more, those with short segments until it settles, and what one of these takes: of six curves of 15,000 to 1,200,000
/// nodes, on two threads, growth ends at .31 to .48 of the time.
inline constexpr double kLayingWork = 40;                   // iterations; > 0; above
inline constexpr double kFullGrowthIterations = 10;         // iterations; > 0; above
inline constexpr double kFullFinishingIterations = 6;       // iterations; > 0; above
inline constexpr double kFineWhereLaid = 4;                 // iterations; > 0; above

/// An iteration of so many nodes takes seconds, and tells how far it has come when its steps end: at these shares of
/// its time, of 1,000,000 nodes on stuffedtoy in `even`.
inline constexpr size_t kNodesOfLongIteration = 1000000;    // nodes; >= 1; free
inline constexpr double kIterationMeasured = 0.55;          // share of the time; 0 to 1; above
inline constexpr double kIterationSolved = 0.7;             // share of the time; kIterationMeasured to 1; above
inline constexpr double kIterationMoved = 0.9;              // share of the time; kIterationSolved to 1; above

/// From here on progress follows ever more slowly, so that it stays below 1 however long a run takes.
inline constexpr double kSlowedFrom = 0.7;                  // share of the time; 0 to 1; free

/// While a flow begins: what it takes for each face to see whether the surface is rough, and to smooth it where it is,
/// and when the domain is known, of all of the time. Balls of 1,000,000 and 2,000,000 faces, two threads.
inline constexpr double kLookingFace = 0.25;                // us of a processor; > 0; above
inline constexpr double kSmoothingFace = 1.6;               // us of a processor; > 0; above
inline constexpr double kDomainKnown = 0.98;                // share of the time; 0 to 1; free

/// Where there is no polish: the share of the time until the curve is as long as at the end of growth, the length at
/// which it becomes quiet, and the share of the quiet iterations that end the run. "progress: Follow the time to the
/// end of a run".
inline constexpr double kUnpolishedGrowth = 0.4;            // share of the time; 0 to 1; above
inline constexpr double kUnpolishedLength = 0.98;           // share of the length; kLengthWhenGrown to 1; above
inline constexpr double kUnpolishedEnd = 0.35;              // share of these; 0 to 1; above

}  // namespace meander
