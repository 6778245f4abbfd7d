// SPDX-License-Identifier: GPL-3.0-or-later
//
// How good the curve is, measured from outside: a change that is faster because the curve is worse
// must show here. All figures are ratios, with lengths in r.
#pragma once

#include "result.h"

namespace meander::bench {

struct Quality {
  double packing = 0;      ///< 2 r L / A: 1 where strands lie 2 r apart everywhere
  double near_target = 0;  ///< share of the medial radii, both sides of all nodes, within 20 % of r
  double p05 = 0;          ///< their fifth percentile
  double coverage_p99 = 0;  ///< distance from random points of the surface to the curve
  double coverage_max = 0;
};

/// `nodes.radii` must be those of the present curve.
Quality judge(const Mesh& mesh, const Polylines& curve, const Nodes& nodes, double radius);

}  // namespace meander::bench
