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

}  // namespace meander
