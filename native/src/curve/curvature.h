// SPDX-License-Identifier: GPL-3.0-or-later
//
// How sharply a curve turns along the surface.
#pragma once

#include "base/thread_pool.h"
#include "curve/curve.h"
#include "curve/local_metric.h"

namespace meander {

/// The turn at every node in radians, to the left positive and to 1e-7; 0 at open ends.
NodeData<double> turns_at_nodes(const Curve& curve, ThreadPool& pool);

/// The geodesic curvature at every node in units of 1 / r, without its sign, as a mean along the strand with weights
/// that fall linearly to 0 at `width` r on both sides: 1 in a round hairpin between strands at the spacing 2 r, 0
/// where a strand runs straight. `width`, above 0, should span some nodes; both arguments are of the same curve.
NodeData<double> smoothed_curvature(const Curve& curve, const LocalMetric& metric, double width, ThreadPool& pool);

}  // namespace meander
