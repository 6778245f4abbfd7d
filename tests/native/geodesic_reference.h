// SPDX-License-Identifier: GPL-3.0-or-later
//
// The implicit medial axis by distances along the surface (section 3.2.2, Figs. 11 to 13): on each side
// of a node, the largest geodesic ball that is tangent to the curve there and holds no other node.
#pragma once

#include "medial/medial_axis.h"

namespace meander {

/// As compute_medial_axis, with geodesic balls: their centres lie on the surface, at the end of the
/// geodesic that leaves the node along +-B, and what another sheet of the surface carries does not
/// count, however near it is in space.
///
/// Geodesic balls that are tangent at a node are nested too, by the triangle inequality alone, so
/// here too the largest empty ball is the least of those through any other node. Distances along the
/// surface are never less than those through space. So a ball is known to be empty once the nodes in
/// the ball of its radius in space, of which the tree finds few, are measured along the surface.
///
/// Balls larger than 3 r, which only growing curves have, are limited by what a straight path leads to, not
/// by what only a path bent at a vertex reaches.
///
/// A centre that may pass the boundary is taken to be in the plane that continues the surface there.
///
/// `radii`  in: radii of an earlier state (0: unknown), which only save time; out: the result
void compute_geodesic_reference(const Surface& surface, const Curve& curve, const Frames& frames,
                                  const BoundaryObstacle& boundary, BoundaryRule rule,
                                  const LocalMetric& metric, const NodeData<Reach>& reach,
                                  ThreadPool& pool, NodeData<Radii>& radii);

}  // namespace meander
