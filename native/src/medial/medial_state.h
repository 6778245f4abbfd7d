// SPDX-License-Identifier: GPL-3.0-or-later
//
// The medial axis of the whole curve, as one iteration needs it: in which directions balls grow, what the boundary
// leaves of them, and what the energy makes of their radii.
#pragma once

#include "geodesic/surface_patches.h"
#include "medial/boundary_reach.h"
#include "medial/curve_bvh.h"
#include "medial/frames.h"
#include "medial/geodesic_medial_axis.h"
#include "medial/medial_axis.h"
#include "medial/medial_plan.h"

namespace meander {

/// How balls end at the boundary, and how they are found.
struct MedialRules {
  BoundaryRule boundary = BoundaryRule::kCentre;
  MedialPlan plan;
};

/// What the medial axis is a function of. Refers to what it is given.
struct MedialScene {
  const Surface& surface;
  const SurfacePatches* patches;  ///< of the surface; null: distances are straight through space
  const BoundaryObstacle& boundary;
  const RadiusField& radius;
  const Curve& curve;
  const LocalMetric& metric;  ///< of the curve
  MedialRules rules;
};

/// One entry for every node of the curve that it was found for.
struct MedialState {
  Frames frames;
  NodeData<Reach> reach;
  NodeData<Radii> radii;       ///< the medial radii, in the surface's unit
  NodeData<Radii> felt_radii;  ///< as the energy sees them: under a density, and near a boundary
  NodeData<MeasuredBalls> measured;  ///< what nodes know of their balls for the next iteration; empty if nobody asks
  CurveBvh tree;               ///< kept for its memory; not to be asked

  /// Hands the memory of its lists on; what they say is lost.
  void hand_on() noexcept;
};

/// What nodes at rest still know of an earlier iteration. Each may be null, or empty: then all is found anew.
struct AtRest {
  const NodeData<CachedDirections>* directions = nullptr;  ///< see compute_frames
  const NodeData<MeasuredBalls>* balls = nullptr;          ///< see compute_geodesic_medial_axis; null: nobody will ask
};

/// Finds frames, reach and radii of the curve (section 3.2.2), in the memory that `state` has. Another measure of
/// distance gets its place here.
///
/// `radii`  those of an earlier state, which only save time, or empty
void find_medial_state(const MedialScene& scene, const AtRest& known, const NodeData<Radii>& radii, ThreadPool& pool,
                       MedialState& state);

/// A radius on one side of a node in units of the r that it passes, times the node's own r.
///
/// Where the spacing is to vary, distances count in units of the local r: a side that runs into a finer region feels
/// larger than it is. The diameter 2 R along a geodesic on which r grows with the slope g is then
/// (r / g) log(1 + 2 g R / r), in units of the node's own r. Without this, strands that follow a density would be
/// pulled back to equal distances, and would never come to rest.
double in_local_radii(const Frames& frames, const LocalMetric& metric, size_t node, size_t side, double radius);

}  // namespace meander
