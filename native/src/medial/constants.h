// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants of the medial balls, and of what the boundary leaves of them. Each line has the unit, the range, and
// what chose the value: a heading of docs/decisions.md or the subject of a commit in quotes, or "free", where the first
// value that was tried has stayed. tests/core/test_constants.py reads these lines.
#pragma once

#include <cstdint>

namespace meander {

// ---- Balls ----------------------------------------------------------------------------------------------------------

/// Balls grow along the chord to where a geodesic arrives after this much: most of the distance to the centre of a ball
/// of the wanted size. Farther, and strands on thin limbs come to lie too far apart; nearer, and those at creases come
/// too close. Spot at twice the radius: near_target .81 in the mean, .80 with a whole r.
inline constexpr double kChord = 0.75;                // r; 0 to 1; "Chords"

/// A node keeps its directions while it is no farther than kRest from where it found them, and its strand has turned by
/// less than kTurn since.
inline constexpr double kRest = 0.05;                 // r; >= 0; "What stands still"
inline constexpr double kTurn = 0.1;                  // sine; 0 to 1; "What stands still"

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

}  // namespace meander
