// SPDX-License-Identifier: GPL-3.0-or-later
//
// What nodes carry from one iteration to the next.
#pragma once

#include "base/thread_pool.h"
#include "curve/node_data.h"
#include "medial/frames.h"
#include "medial/geodesic_medial_axis.h"
#include "medial/medial_axis.h"

namespace meander {

/// Each may be empty: nothing is known then, and it is found anew.
struct NodeHistory {
  NodeData<Radii> radii;                  ///< of the last medial axis, in the surface's own unit
  NodeData<CachedDirections> directions;  ///< of medial balls, for nodes at rest
  NodeData<MeasuredBalls> balls;          ///< along the surface, likewise
  NodeData<Vec2> steps;                   ///< the last displacements, along tangent and bitangent

  /// Gives the nodes after a refinement what those had that they come from; `origin` as Refinement::refine says.
  /// Where this throws, it is that of neither.
  void follow(const NodeData<uint32_t>& origin, ThreadPool& pool);

  /// Hands its memory on; what it says is lost.
  void hand_on() noexcept { meander::hand_on(radii, directions, balls, steps); }
};

}  // namespace meander
