// SPDX-License-Identifier: GPL-3.0-or-later
//
// The free ends of open strands: how far the surface is empty ahead of them.
//
// Medial balls lie beside a strand; ahead of an end there is none, so that nothing kept an end from
// running into the next strand, or drew it on into an empty place. Its ball here touches the end from
// ahead, and pulls or pushes it until its radius is r, as the others do with their nodes.
#pragma once

#include <vector>

#include "medial/boundary_reach.h"
#include "medial/frames.h"

namespace meander {

struct FreeEnd {
  uint32_t node = 0;
  Vec2 ahead;         ///< unit, in the plane of the node's face: on from the end
  double radius = 0;  ///< of the largest empty ball that touches the strand there, from ahead
};

/// The free ends, in the order of the nodes.
std::vector<FreeEnd> find_free_ends(const Surface& surface, const Curve& curve, const Frames& frames,
                                    const BoundaryObstacle& boundary, BoundaryRule rule,
                                    const LocalMetric& metric, ThreadPool& pool);

}  // namespace meander
