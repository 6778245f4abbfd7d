// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants of the medial balls, and of what the boundary leaves of them; curve/constants.h has what is said of
// each.
#pragma once

#include <cstdint>

namespace meander {

/// Balls grow along the chord to where a geodesic arrives after this much of r, above 0 and at most 1: most of the
/// distance to the centre of a ball of the wanted size. Farther, and strands on thin limbs come to lie too far apart;
/// nearer, and those at creases come too close. Spot at twice the radius: near_target .81 in the mean, .80 with a whole
/// r (docs/decisions.md, "Chords").
inline constexpr double kChord = 0.75;

/// A node keeps its directions while it is no farther than this from where it found them, in r, >= 0, and its strand
/// has turned by less than this since, as a sine, from 0 to 1. docs/decisions.md, "What stands still".
inline constexpr double kRest = 0.05, kTurn = 0.1;

/// A node keeps a ball that was measured along the surface while it is no farther than the first of these from where
/// that was, in r, >= 0, and the straight ball differs from what it was by less than the second, as a share, from 0 to
/// 1. It is measured again after kBallIterations at the latest, what had to be searched for after kSearchedIterations;
/// both >= 1. docs/decisions.md, "Kept balls".
inline constexpr double kBallRest = 0.1, kBallChange = 0.1;
inline constexpr uint32_t kBallIterations = 6, kSearchedIterations = 4;

/// Along a ball's diameter r counts as growing by no less and no more than this, as a share; above -1 and below
/// infinity. Where the density jumps, the slope at its start says nothing. Not measured; the diameter itself was
/// ("flow: Measure a ball's whole diameter in the local r").
inline constexpr double kLeastRadiusGrowth = -0.75, kMostRadiusGrowth = 3;

/// Weight of the radius that a ball lacks at the boundary: 2, or 1 in gentle runs; 0 is the push of an empty ball.
/// Below a share kVeryNear, from 0 to 1, of the distance wanted kVeryNearPush is added to it. "flow: Let the boundary
/// push twice as hard ..." and "boundary_reach: Keep strands from corners ..."; docs/decisions.md, "Push of the
/// boundary".
inline constexpr double kPush = 2, kEasedPush = 1;
inline constexpr double kVeryNear = 0.8, kVeryNearPush = 6;

/// What of the boundary is turned to a side of a node by less than this, as a cosine, from 0 to 1, does not limit its
/// ball. Not measured.
inline constexpr double kFacing = 0.5;

}  // namespace meander
