// SPDX-License-Identifier: GPL-3.0-or-later
//
// The curves that walk round trees of lines.
#pragma once

#include <optional>
#include <vector>

#include "base/thread_pool.h"
#include "seed/tree_walk.h"

namespace meander {

/// A tree of lines that a curve walks round, in the place of a strand of the first curve.
struct LineTree {
  uint32_t strand;             ///< of the first curve
  uint32_t root;               ///< a node of the tree: without a trunk
  std::optional<Trunk> trunk;  ///< that strand, where it was drawn
};

/// What has come of it: where nothing is in the way the curve is the first one, with the strands of trees replaced.
struct TreeTour {
  Curve curve;
  std::vector<uint32_t> edges_in_the_way;    ///< of the network: what touches does so beside one of them
  std::vector<uint32_t> strands_in_the_way;  ///< of the first curve: where there is no such edge

  bool is_laid() const { return edges_in_the_way.empty() && strands_in_the_way.empty(); }
};

/// Curves that walk round trees of a network, on both sides of every edge, at `offset` local radii from them or, where
/// they would touch themselves or each other there, as much nearer as they must. A tree with a trunk is walked round
/// from the trunk: the curve runs along that, and round what leaves it on either side.
///
/// Every node of a curve is placed by a straight walk from a node of the tree into the sector between two edges, and
/// two neighbours are joined along the edges between them. The closer the nodes are to the tree, the less is there for
/// a path to meet but the edges themselves, in whose order it runs: no two edges touch, so halving the distances where
/// segments touch comes to an end nearly everywhere. Where it does not, as where a link bends round a corner of the
/// surface that its sides cannot pass side by side, an edge is in the way.
///
/// `first`  no two of its segments touch; a strand that no tree replaces stays as it is
TreeTour walk_round(const LineNetwork& network, const std::vector<LineTree>& trees, double offset, const Curve& first,
                    ThreadPool& pool);

}  // namespace meander
