// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far strands are apart, smoothed along them: what the polish follows.
#pragma once

#include "model/strand_solver.h"

namespace meander {

/// The mean medial radius of both sides in units of r, no side more than 2 r, smoothed along the curve over
/// kSpacingSmoothing r. All arguments are of the same curve.
NodeData<double> smoothed_spacing(const Curve& curve, const LocalMetric& metric, const NodeData<Radii>& radii,
                                  StrandSolver& strands, ThreadPool& pool);

}  // namespace meander
