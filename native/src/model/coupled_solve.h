// SPDX-License-Identifier: GPL-3.0-or-later
//
// The banded solve of one step where the two components of a node are coupled: field alignment
// (eq. 11) and powers other than 2 (eq. 13). Still O(n), with 2 x 2 blocks in place of numbers.
#pragma once

#include <vector>

#include "model/energy.h"

namespace meander {

/// Solves system H z = -g, its blocks included; returns z, one a node, in the parallel frames.
///
/// Open: L L^T by blocks. Closed: the same for all but the last two nodes, which are eliminated
/// through their 4 x 4 Schur complement; the holonomy is a rotation of the couplings past the join.
Table<Vec2> solve_coupled(const StrandSystem& system);

}  // namespace meander
