// SPDX-License-Identifier: GPL-3.0-or-later
//
// A way from a tree of lines that stands alone to another one, wherever the surface leads there.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/cancel_token.h"
#include "geodesic/geodesic_path.h"
#include "seed/line_network.h"

namespace meander {

/// A way from one node to another in straight legs: one more than the places between.
struct WayOut {
  struct Leg {
    Path path;
    PathShape shape;
  };
  std::vector<SurfacePoint> places;
  std::vector<Leg> legs;
};

/// A node from which a way may lead.
struct WayEnd {
  uint32_t node;
  Vec2 along;  ///< unit direction of its line there, in the plane of its face; of a tip, that in which it goes on
  bool tip;    ///< a way goes on there about straight ahead, and elsewhere leaves sideways
};

/// Which lines a way may lead to; it keeps away from all others.
using IsGoal = std::function<bool(uint32_t line)>;
/// Whether a way from one node to another is taken.
using Takes = std::function<bool(uint32_t from, uint32_t to, WayOut& way)>;

/// Searches the surface from all of these nodes at once (Dijkstra, 1959), by places in short straight steps, of which
/// those near a boundary count for more: so the way to take is in the middle of a neck. Each time that a place is
/// beside nodes of a goal, ways to these are offered, in legs as long as they are clear, until one is taken; whether
/// one was.
///
/// `places`  no more are looked at; what is left of them afterwards
bool find_way_out(const LineNetwork& network, std::span<const WayEnd> ends, const IsGoal& is_goal, const Takes& takes,
                  PathShortener& shortener, size_t& places, CancelToken& poll);

}  // namespace meander
