// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where strands come to rest too near to one another, or too far apart, r is made up for it while they are polished.
#pragma once

#include "curve/local_metric.h"
#include "medial/radii.h"

namespace meander {

/// The median of the medial radii on both sides of the nodes that are not of guides, in the local r; 0 where there are
/// none. Of very many nodes evenly many are looked at. All arguments are of the same curve.
double median_spacing(const Curve& curve, const NodeData<Radii>& radii, const LocalMetric& metric);

/// What r is to be multiplied by in the next iteration of the polish where it is multiplied by `correction` in this one
/// and strands are then `spacing` of what they are to be apart, in the median. At most kMostCorrection from 1.
///
/// `coarse`  whether segments are still long, so that balls between strands are measured too large
double corrected(double correction, double spacing, bool coarse);

}  // namespace meander
