// SPDX-License-Identifier: GPL-3.0-or-later
//
// The closed curves that walk round trees of lines.
#pragma once

#include <span>
#include <vector>

#include "base/thread_pool.h"
#include "seed/line_network.h"

namespace meander {

/// A trunk: nodes of the network in the order of a strand, each joined to the next by an edge.
struct Trunk {
  std::vector<uint32_t> nodes;
  std::vector<uint8_t> fixed;  ///< per node: the curve keeps it
  bool closed = false;
};

/// Curves that walk round trees of a network, on both sides of every edge, at `offset` local radii from them or, where
/// they would touch themselves or each other there, as much nearer as they must. A tree with a trunk is walked round
/// from the trunk: the curve runs along that, and round what leaves it on either side.
///
/// Every node of a curve is placed by a straight walk from a node of the tree into the sector between two edges, and
/// two neighbours are joined along the edges between them. The closer the nodes are to the tree, the less is there for
/// a path to meet but the edges themselves, in whose order it runs: since no two edges touch, halving the distances
/// where segments touch comes to an end.
///
/// `roots`   a node of every tree without a trunk
/// `kept`    strands that stay, and touch neither each other nor an edge
/// `walked`  receives, for every strand of the curve, the index of its trunk or, after them, of its root: a tree whose
///           curve touches after all, as where the tree is in a corner too small for numbers, has none
Curve walk_round(const LineNetwork& network, std::span<const Trunk> trunks, std::span<const uint32_t> roots,
                 double offset, const Curve& kept, ThreadPool& pool, std::vector<uint32_t>& walked);

}  // namespace meander
