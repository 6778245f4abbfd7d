// SPDX-License-Identifier: GPL-3.0-or-later
//
// Offsets: how the points of strands, one strand after the other, are told apart.
#pragma once

#include <cstdint>
#include <vector>

#include "api/guard.h"

namespace meander {

/// Offsets of the caller's, checked: `count` strands (`what`, in the plural) of `point_count` points.
/// Inside, points have 32-bit indices.
inline std::vector<uint32_t> checked_offsets(const uint64_t* offsets, size_t count, size_t point_count,
                                             const std::string& what) {
  if (offsets[0] != 0) refuse("The offsets of the " + what + " must start at 0.");
  if (point_count > (size_t{1} << 30)) refuse("The " + what + " have more than 2^30 points; thin them out.");
  for (size_t s = 0; s < count; ++s) {
    if (offsets[s] > offsets[s + 1]) refuse("The offsets of the " + what + " must not fall.");
  }
  if (offsets[count] != point_count) {
    refuse("The offsets of the " + what + " end at " + std::to_string(offsets[count]) + "; they must end at " +
           std::to_string(point_count) + ", the number of points.");
  }
  return {offsets, offsets + count + 1};
}

}  // namespace meander
