// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants of the medial balls, along the surface beside creases too, and of what the boundary leaves of them;
// curve/constants.h says how to read a line.
#pragma once

#include <cstddef>
#include <cstdint>

namespace meander {

// ---- Balls ----------------------------------------------------------------------------------------------------------

/// Balls grow along the chord to where a geodesic arrives after this much: most of the distance to the centre of a ball
/// of the wanted size. Farther, and strands on thin limbs come to lie too far apart; nearer, and those at creases come
/// too close. Spot at twice the radius: near_target .81 in the mean, .80 with a whole r.
inline constexpr double kChord = 0.75;                // r; 0 to 1; "Chords"

/// A node keeps its directions while it is no farther than kFrameRest from where it found them, and its strand has
/// turned by less than kFrameTurn since.
inline constexpr double kFrameRest = 0.05;            // r; >= 0; "What stands still"
inline constexpr double kFrameTurn = 0.1;             // sine; 0 to 1; "What stands still"

/// A node keeps a ball that was measured along the surface while it is no farther than kBallRest from where that was,
/// and the straight ball differs from what it was by less than kBallChange. It is measured again after kBallIterations
/// at the latest, what had to be searched for after kSearchedIterations.
inline constexpr double kBallRest = 0.1;              // r; >= 0; "Kept balls"
inline constexpr double kBallChange = 0.1;            // share of it; 0 to 1; "Kept balls"
inline constexpr uint32_t kBallIterations = 6;        // iterations; >= 1; "Kept balls"
inline constexpr uint32_t kSearchedIterations = 4;    // iterations; >= 1; "Kept balls"

/// Along a ball's diameter r counts as growing by no less and no more than this: where the density jumps, the slope at
/// its start says nothing. The diameter itself was measured, "flow: Measure a ball's whole diameter in the local r".
inline constexpr double kLeastRadiusGrowth = -0.75;   // share of r; -1 to 0; free
inline constexpr double kMostRadiusGrowth = 3;        // share of r; > 0; free

/// A ball is first looked for among those up to this much larger than the node's last one.
inline constexpr double kWarmth = 1.2;                // times; > 1; free

/// Points limit a ball alike if it is so up to this, which is rounding.
inline constexpr double kAlikeRounded = 1.00000000000001;  // times; > 1; free

/// Rounding changes the radius of a ball ahead of an end by less than this share of the surface's diagonal and of its
/// own.
inline constexpr double kBallRounding = 1e-9;         // share of both; 0 to 1; free

/// For kFewFreeEnds ends it costs less to visit every node for each of them than to build a tree, which takes about as
/// long as that many visits of a node. A tree of kRunsOfOneThread runs is built before another thread is awake.
inline constexpr size_t kFewFreeEnds = 32;            // ends; >= 0; free
inline constexpr uint32_t kRunsOfOneThread = 128;     // runs; >= 1; free

/// Larger radii are not meant: rounding in single precision is allowed for up to here.
inline constexpr double kMostRadius = 4;              // unit of the surface; > 0; free
/// Coordinates below 8 and three subtractions, squares and sums in single precision err by less than kBoxRounding in a
/// distance, so a box that a ball of this much more misses is missed by the ball. Its square is rounded up by more than
/// half a unit in the last place.
inline constexpr double kBoxRounding = 4e-6;          // unit of the surface; > 0; geometry
inline constexpr double kRoundedUp = 1.0000001;       // times; > 1; geometry

// ---- The boundary ---------------------------------------------------------------------------------------------------

/// Weight of the radius that a ball lacks at the boundary, and that in gentle runs; 0 is the push of an empty ball. The
/// twofold push came with "flow: Let the boundary push twice as hard ...".
inline constexpr double kPush = 2;                    // times; >= 0; "Push of the boundary"
inline constexpr double kEasedPush = 1;               // times; >= 0; "Push of the boundary"
/// Where the distance is below a share kVeryNear of the one that is wanted, kVeryNearPush is added to it:
/// "boundary_reach: Keep strands from corners, and let them leave one".
inline constexpr double kVeryNear = 0.8;              // share of it; 0 to 1; "Push of the boundary"
inline constexpr double kVeryNearPush = 6;            // times; >= 0; "Push of the boundary"

/// What of the boundary is turned to a side of a node by less than this does not limit its ball.
inline constexpr double kFacing = 0.5;                // cosine; 0 to 1; free

/// Whether the boundary is near is looked for kLookedFarther times as far as asked: farther costs more, but answers for
/// more places. Where it may be near, it is not looked for again from places within kBelievedNear of where it was.
inline constexpr double kLookedFarther = 2;           // times; >= 1; free
inline constexpr double kBelievedNear = 0.5;          // share of what was asked; 0 to 1; free

// ---- Balls along the surface, beside creases ------------------------------------------------------------------------

// Each rule was left out once on seven surfaces ("Rules of measured balls"); the values were not measured one by one.

/// A straight line lies along the surface where the normals at both ends differ by less than kAlikeNormals, and it
/// leaves the plane of either end by less than kMostRise.
inline constexpr double kAlikeNormals = 0.7;          // cosine; 0 to 1; free
inline constexpr double kMostRise = 0.36;             // sine; 0 to 1; free

/// A straight ball is believed where no limb about r thick is nearer than kFlatAroundBall of its radii; and where a
/// crease is in it only if it grows in the direction of the surface, up to kBelievedAhead (11 degrees), and is as large
/// in the plane of the node's face, up to kBelievedWithin. On a limb about r thick it is off by up to 1/8.
inline constexpr double kFlatAroundBall = 1.5;        // radii; > 0; free
inline constexpr double kBelievedAhead = 0.98;        // cosine; 0 to 1; free
inline constexpr double kBelievedWithin = 0.04;       // share of it; > 0; free
/// A straight ball counts as reaching a crease that this much larger a ball would: on a surface that bends a little the
/// centre is not quite known.
inline constexpr double kCreaseMargin = 1.05;         // times; >= 1; free

/// What limits the straight ball helps to find what limits the one along the surface where both grow in much the same
/// direction, and where the straight one is no larger than kWideAtEdge beside a sharp edge: else that is not ahead.
inline constexpr double kMuchTheSame = 0.7;           // cosine; 0 to 1; free
inline constexpr double kWideAtEdge = 1.4;            // r; > 0; free

/// Strands that are measured for one ball. With 1 in place of 3, .983 of the balls on fish_control_mesh are good, not
/// .987.
inline constexpr uint32_t kMostStrandsOfBall = 3;     // strands; >= 1; "Rules of measured balls"
/// With what limits a ball so many nodes to both sides of it are measured.
inline constexpr uint32_t kMeasuredNeighbours = 7;    // nodes; >= 1; free
/// Measured no farther than kSameBall of the straight ball, it is what limits the ball. Else the next straight ball is
/// looked at, of those up to kNextBall times the least that was measured.
inline constexpr double kSameBall = 1.04;             // times; >= 1; free
inline constexpr double kNextBall = 1.12;             // times; >= 1; free
/// Lines are no longer than this, and rays no longer than what balls of this radius need, so that balls take bounded
/// time.
inline constexpr double kLongestLine = 8;             // r; > 0; free

/// The centre of a ball makes it smaller where it sees points that lie this far inside of it. Balls larger than
/// kSeenFromCentre are not looked at, and others at most kMostCentreRounds times.
inline constexpr double kInsideOfBall = 0.02;         // share of the radius; 0 to 1; free
inline constexpr double kSeenFromCentre = 2;          // r; > 0; free
inline constexpr int kMostCentreRounds = 3;           // rounds; >= 1; free

/// Along rays looks are kRayStep apart, and reach kLookedAround.
inline constexpr double kRayStep = 0.6;               // r; > 0; free
inline constexpr double kLookedAround = 0.6;          // r; > 0; free
/// What rays come across is believed by nodes no farther away than kBelievedBeside, whose balls are no larger than
/// kBelievedAsLarge times that one.
inline constexpr double kBelievedBeside = 0.6;        // r; > 0; free
inline constexpr double kBelievedAsLarge = 1.1;       // times; >= 1; free
/// Faces whose normals differ by less count as one plane.
inline constexpr double kNearlyFlat = 0.95;           // cosine; 0 to 1; free

}  // namespace meander
