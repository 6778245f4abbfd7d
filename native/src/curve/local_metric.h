// SPDX-License-Identifier: GPL-3.0-or-later
//
// What lengths mean at every node: r, r_max, and how near strands come to the boundary.
#pragma once

#include "base/thread_pool.h"
#include "curve/curve.h"
#include "curve/node_data.h"
#include "mesh/radius_field.h"

namespace meander {

/// The lengths that the flow measures with, one of each for every node, in the surface's own unit. They belong to
/// the nodes that they were found for: found anew whenever those move, are split or removed.
struct LocalMetric {
  NodeData<double> radius;      ///< the local r
  NodeData<double> max_radius;  ///< r_max: no medial radius is larger
  /// How far the centre of a medial ball may pass the boundary, or, where negative, must stay away from it.
  NodeData<double> overhang;
  /// A medial ball that the boundary leaves smaller than this is pushed away from there harder than by what it
  /// falls short of; 0: as by anything else.
  NodeData<double> least_rest;

  /// Hands its memory on; what it says is lost.
  void hand_on() noexcept { meander::hand_on(radius, max_radius, overhang, least_rest); }
};

/// How the metric follows from r.
struct MetricRules {
  double clamp = 3;              ///< r_max in r
  double largest = 0;            ///< no r_max beyond this, in the surface's own unit
  double boundary_distance = 0.5;  ///< of the last strand from the boundary, in local spacings
};

/// Finds the metric of all nodes, in the memory that it has.
void find_local_metric(const Surface& surface, const Curve& curve, const RadiusField& radius, const MetricRules& rules,
                       ThreadPool& pool, LocalMetric& metric);

}  // namespace meander
