// SPDX-License-Identifier: GPL-3.0-or-later
//
// The implicit medial axis: on each side of a node, the largest ball that is tangent to the curve
// there and holds no other node (section 3.2.2, eq. 6).
#pragma once

#include "medial/boundary_reach.h"
#include "medial/curve_bvh.h"
#include "medial/frames.h"
#include "medial/radii.h"

namespace meander {

/// Computes both radii of every node, exactly: tangent balls at a node are nested, so the largest one
/// that is empty is the smallest of those through any other node (after Ma, Bae, Choi, "3D medial axis
/// point approximation using nearest neighbors and the normal field", 2012; see medial/empty_balls.h).
///
/// `reach`  what the boundary and the clamp leave of the balls, see compute_reach
/// `tree`   is built anew, and not to be asked afterwards; kept from call to call it saves memory from being
///          found again
/// `radii`  in: radii of an earlier state (0: unknown), which only save time; out: the result
void compute_medial_axis(const Frames& frames, const BoundaryObstacle& boundary, BoundaryRule rule,
                         const NodeData<Reach>& reach, ThreadPool& pool, CurveBvh& tree,
                         NodeData<Radii>& radii);

}  // namespace meander
