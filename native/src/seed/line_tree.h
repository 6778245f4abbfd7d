// SPDX-License-Identifier: GPL-3.0-or-later
//
// Joins lines by short links to trees.
#pragma once

#include <vector>

#include "base/thread_pool.h"
#include "seed/streamlines.h"

namespace meander {

/// Adds links between lines to the network, each an edge between nodes of two lines, so that lines and links are trees.
///
/// A curve that walks round a tree turns back at every tip, and twice at every link that leaves a line sideways; where
/// a link goes on straight from a tip, that one is gone. So links at tips come first, then those near to tips, then
/// short ones. None passes over a third line, and links on one side of a line keep a spacing from one another.
///
/// Trees that no such link joins, as on either side of a fold, are joined by what straight walks from them meet first,
/// and those that have no such walk, as on either side of a hole, by lines that go on to a bend.
///
/// Trunks are lines that belong to different trees; links leave them sideways only, no nearer to a fixed node than 1.5
/// r, and only one from a place. What cannot be joined to the trunk of its component stays a tree of its own.
///
/// `holds`  per node of the network, or shorter: 1 where a node of a trunk must stay
/// `variation`  which of many trees of the same lines
///
/// Returns for every line the number of its tree, that of one of its lines. Source of the search: Kruskal's minimum
/// spanning tree.
///
/// Links that there are already stay, and where one was taken out none comes again.
std::vector<uint32_t> join_lines(std::vector<Streamline>& lines, const std::vector<uint8_t>& holds,
                                 uint32_t variation, LineNetwork& network, ThreadPool& pool, CancelToken poll);

}  // namespace meander
