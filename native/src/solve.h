// SPDX-License-Identifier: GPL-3.0-or-later
//
// The banded solve of one step (eq. 10), O(n) for open and closed strands.
#pragma once

#include <vector>

#include "energy.h"

namespace meander {

/// Solves system H z = -g; returns z, one a node, in the parallel frames.
///
/// Open: L D L^T of the real pentadiagonal matrix. Closed: the same for all but the last two nodes,
/// which are eliminated through their Schur complement, where the holonomy enters. Where the two
/// components of a node are coupled, see coupled_solve.h.
std::vector<Vec2> solve(const StrandSystem& system);

}  // namespace meander
