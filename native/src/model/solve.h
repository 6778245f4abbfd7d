// SPDX-License-Identifier: GPL-3.0-or-later
//
// The banded solve of one step (eq. 10), O(n) for open and closed strands.
#pragma once

#include <vector>

#include "base/thread_pool.h"
#include "model/constants.h"
#include "model/energy.h"

namespace meander {

/// Solves system H z = -g; returns z, one a node, in the parallel frames.
///
/// L D L^T of the real pentadiagonal matrix. Pairs of nodes part the strand into chunks of at least
/// `least_chunk` nodes (a few at least), which threads solve side by side; then the pairs follow through
/// their Schur complement. One pair always stands at the join of a closed strand, where the holonomy
/// enters. The chunks depend on the number of nodes only. Where the two components of a node are coupled
/// one thread solves the whole strand, see coupled_solve.h.
Table<Vec2> solve(const StrandSystem& system, ThreadPool& pool, size_t least_chunk = kLeastChunk);

}  // namespace meander
