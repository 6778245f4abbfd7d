// SPDX-License-Identifier: GPL-3.0-or-later
//
// How rough a surface is at the scale of the spacing.
#pragma once

#include "base/cancel_token.h"
#include "mesh/radius_field.h"
#include "mesh/surface.h"
#include "mesh/vertex_data.h"

namespace meander {

/// The curvature of every vertex, 2 pi less the sum of the angles around it; 0 on the boundary and where no face is.
VertexData<double> angle_defects(const Surface& surface, CancelToken poll = {});

/// The roughness of a surface around every vertex, in radians for the area of a disc of radius r: of the curvature, in
/// absolute value, what cancels out over the few r around. `radius` is r.
///
/// The curvature of a vertex is its angle defect. A smooth surface, a corner, a limb and a saddle curve one way there,
/// and their roughness is about 0, however sharp they are; on a crumpled one defects of both signs lie side by side
/// and bend every straight line that passes between them. Empty where it is nowhere more than `least`.
VertexData<double> roughness(const Surface& surface, const RadiusField& radius, double least, CancelToken poll = {});

}  // namespace meander
