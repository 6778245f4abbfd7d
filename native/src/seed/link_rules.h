// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which links join lines to trees, and what they cost.
#pragma once

#include <cstddef>

namespace meander {

/// What links may be like. Lengths are in r, angles cosines with the line.
struct LinkRules {
  double longest;     ///< a link
  double ahead;       ///< at a tip, a link deviates from straight ahead by no more than this,
  double sideways;    ///< and elsewhere from a right angle
  size_t from_tip;    ///< nodes between a link that leaves sideways and a tip, at least
};

/// Links that leave by about 50 degrees from straight ahead or sideways, and, for trees that none of them joins,
/// others.
inline constexpr LinkRules kUsual{6.5, 0.5, 0.6, 2}, kLast{12, 0, 0.92, 1};

/// The first ones keep this distance from third lines, in r.
inline constexpr double kClear = 0.9;

/// And all of them this one from ends and fixed nodes of trunks.
inline constexpr double kFromHeld = 1.5;

/// What a search counts for, in pieces of work.
inline constexpr size_t kSearched = 64;

/// A tip that is joined saves a hairpin, which is worth this length, in r.
inline constexpr double kTipWorth = 1.5;

/// A link far from tips parts long stretches: this share of its distance from the nearest tip, of kFarFromTip r at
/// most, counts as length.
inline constexpr double kFromTip = 0.15, kFarFromTip = 20;

/// Variations of a curve join lines otherwise: what a link costs is less by up to this, in r. Tips of rows are
/// joined on either side then, and few links are longer.
inline constexpr double kVaried = 2;

/// Two links on one side of a line keep this distance, in r.
inline constexpr double kApart = 2;

}  // namespace meander
