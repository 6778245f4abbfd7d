// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants of the balls that are found along the surface beside creases. Each with its unit and range; "r" is
// half the spacing. Where they come from: docs/decisions.md, "Rules of measured balls", had each rule left out once;
// the values were not measured one by one.
#pragma once

#include <array>
#include <cstdint>

#include "base/plane.h"

namespace meander {

// A straight line lies along the surface.
inline constexpr double kAlikeNormals = 0.7;  // cosine, 0 to 1: normals at both ends differ by less than this
inline constexpr double kRise = 0.36;  // sine, 0 to 1: the line leaves the plane of either end by less than this

// A straight ball is believed.
inline constexpr double kFlatAround = 1.5;  // radii, > 0: no limb about r thick is nearer than this
inline constexpr double kAhead = 0.98;      // cosine, 0 to 1: it grows in the direction of the surface, and ...
inline constexpr double kAgrees = 0.04;     // share, > 0: ... is as large in the plane of the node's face within this

// What limits the straight ball is of help.
inline constexpr double kStraightOn = 0.7;  // cosine, 0 to 1: the ball grows as much in the direction of the surface
inline constexpr double kWide = 1.4;        // r, > 0: beside a sharp edge it is no larger, or that is not ahead

// Measured balls.
inline constexpr uint32_t kMostStrands = 3;  // >= 1: strands that are measured for one ball
inline constexpr uint32_t kNeighbours = 7;   // >= 1: nodes on both sides that are measured with what limits a ball
inline constexpr double kSame = 1.04;    // ratio, >= 1: measured no farther than this, it is what limits the ball
inline constexpr double kMargin = 1.12;  // ratio, >= 1: else the next is, up to straight balls of so many of the least
inline constexpr double kLongest = 8;    // r, > 0: of lines, and half of that of rays: balls take bounded time

// Balls seen from their centre.
inline constexpr double kInside = 0.02;       // share of the radius, 0 to 1: points this far inside make a ball smaller
inline constexpr double kSeenFromCentre = 2;  // r, > 0: larger balls are not looked at
inline constexpr int kMostRounds = 3;         // >= 1

// Rays.
inline constexpr std::array<Vec2, 5> kRays{{{1, 0},  // ahead, and at .7 and 1.25 radians to either side
                                            {0.7648421872844885, 0.644217687237691},
                                            {0.7648421872844885, -0.644217687237691},
                                            {0.3153223623952687, 0.9489846193555862},
                                            {0.3153223623952687, -0.9489846193555862}}};
inline constexpr double kRayStep = 0.6, kAround = 0.6;  // r, > 0: looks are this far apart, and reach this far
inline constexpr double kBeside = 0.6;   // r, > 0: what rays come across is believed by nodes this near, ...
inline constexpr double kAsLarge = 1.1;  // ratio, >= 1: ... whose balls are no larger than this
inline constexpr double kNearlyFlat = 0.95;  // cosine, 0 to 1: normals of faces whose planes count as one

}  // namespace meander
