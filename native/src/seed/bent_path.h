// SPDX-License-Identifier: GPL-3.0-or-later
//
// A short path between two nodes round what lies straight between them.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "geodesic/geodesic_path.h"
#include "seed/line_network.h"

namespace meander {

/// The shortest locally shortest path found between two nodes that are near each other, but do not see each other, as
/// round a hole or the inner side of a corner: by way of places beside the middle of the straight line between them,
/// in steps of a 32nd of its length to both sides. Nothing where none of these sees both. Whether it touches
/// anything is for the caller to ask. `path` is the result's, else anything.
std::optional<PathShape> bent_path(const LineNetwork& network, uint32_t from, uint32_t to, PathShortener& shortener,
                                   Path& path);

/// A path from one node to another in straight legs: one more than the places between.
struct Bend {
  struct Leg {
    Path path;
    PathShape shape;
  };
  std::vector<SurfacePoint> places;  ///< one or two
  std::vector<Leg> legs;
};

/// The same by way of places that are as far to one side, where all legs are to be short and clear of boundaries and
/// guides, so that there is room on both sides of them: a taut path would lie on the corner. Nothing where there is no
/// such path. `may_be` is asked with the directions in which one leaves the one node and arrives at the other.
std::optional<Bend> bend_between(const LineNetwork& network, uint32_t from, uint32_t to, PathShortener& shortener,
                                 const std::function<bool(Vec2 leaving, Vec2 arriving)>& may_be);

}  // namespace meander
