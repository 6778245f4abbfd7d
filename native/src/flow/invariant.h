// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an iteration must leave as it was, looked at in every build: the part of it that costs next to nothing.
#pragma once

#include <cstddef>
#include <string>

#include "base/thread_pool.h"
#include "curve/curve.h"
#include "flow/constants.h"
#include "mesh/surface.h"

namespace meander {

/// What is wrong with a curve that an iteration has made of `before`, in words; empty: nothing.
///
/// Strands are as many as before, open or closed and guides as before, and cover all nodes; fixed nodes are where they
/// were, to the last bit; every node is inside of its face; lengths are finite. Of a share of the segments, which
/// `turn` chooses: the path leads from face to face, from the node before to the node after it. That nothing crosses
/// is known from the move itself.
std::string broken_promise(const Surface& surface, const Curve& before, const Curve& after, size_t turn,
                           ThreadPool& pool);

}  // namespace meander
