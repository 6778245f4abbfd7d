// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far the nodes of a curve may go to either side without coming near to other strands.
#pragma once

#include <array>

#include "base/thread_pool.h"
#include "curve/curve.h"
#include "curve/node_data.h"
#include "flow/domain.h"

namespace meander {

/// For each node that is `movable`, how far it may go to the left and to the right: at most `most` local spacings, and
/// half of what other strands, or the same strand farther along, are farther away than `clearance` local spacings. If
/// all nodes stay within their rooms, no two of them get nearer to each other than that, or than they were. Lengths
/// are in the surface's own unit; of other nodes nothing is said.
NodeData<std::array<double, 2>> find_room(const Domain& domain, const Curve& curve, const NodeData<uint8_t>& movable,
                                          const NodeData<double>& radius, double most, double clearance,
                                          ThreadPool& pool);

}  // namespace meander
