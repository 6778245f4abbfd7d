// SPDX-License-Identifier: GPL-3.0-or-later
//
// How wide the components of a surface are and how long, and which are strips.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/constants.h"
#include "mesh/surface.h"

namespace meander {

/// A component as the rectangle that has its area and its boundary; infinite where there is none, as of a disc.
struct Strip {
  double width = std::numeric_limits<double>::infinity();
  double length = std::numeric_limits<double>::infinity();

  bool is_long() const { return length > kLeastStrip * width; }
};

/// Every component. Rings, spirals and the arms of a star are long ones. What has no boundary is none, nor is what only
/// has a long one, as a disc with a thousand teeth: a quarter of its area is farther from it than two such widths.
std::vector<Strip> strips_of(const Surface& surface);

/// Whether a line can run along each of these strips from end to end: not round a ring, nor into all arms of a star.
/// Two places of it are nearly as far apart along its edges as it is long; false where `strips` has none. Two searches
/// for shortest paths over all vertices.
std::vector<uint8_t> with_two_ends(const Surface& surface, const std::vector<Strip>& strips);

}  // namespace meander
