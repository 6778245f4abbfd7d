// SPDX-License-Identifier: GPL-3.0-or-later
//
// The implicit medial axis by distances along the surface (section 3.2.2, Figs. 11 to 13), at about the price of
// straight ones.
#pragma once

#include "geodesic/surface_patches.h"
#include "medial/medial_axis.h"

namespace meander {

/// What measuring said of the ball on one side of a node, to be used again while the node is at rest.
struct MeasuredBall {
  Eigen::Vector3f from{0, 0, 0};  ///< where the node was
  float straight = 0;             ///< the radius through space, among what the node saw; 0: nothing is known
  float measured = 0;             ///< the radius along the surface
  uint16_t age = 0;               ///< how many iterations ago that was
  bool searched = false;          ///< what limits the ball is nothing that limits the straight one
};

/// Of both sides.
using MeasuredBalls = std::array<MeasuredBall, 2>;

/// What nodes know of their measured balls before and after an iteration.
struct KeptBalls {
  const NodeData<MeasuredBalls>* before = nullptr;  ///< of the same nodes; null or empty: all are measured
  NodeData<MeasuredBalls>* after = nullptr;         ///< receives what nodes know then; null: nobody will ask
};

/// As compute_medial_axis, with balls along the surface: what another sheet carries does not count, however near it is
/// in space, and what is round a crease or a limb is as far as the path there is long.
///
/// A point p of the surface that a node sees along a straight path of length d, at an angle a from the direction of
/// the ball, limits the ball to d / (2 cos a), as in the plane. Nearly everywhere that is also what the straight line
/// to it says (see Frames::outward): there, and `patches` know where, this is compute_medial_axis. Elsewhere what is
/// hidden is passed over, and what limits the ball then is measured along the surface.
///
/// What faces away from where another sheet is near is passed over as well (GeodesicScene::one_sided).
///
/// Most of the cost on creased surfaces is measuring, and from one iteration to the next little changes. So a node that
/// is within kBallRest of where its ball was measured, less than kBallIterations ago, keeps it: in the
/// same ratio to the straight ball, if that is about what it was, or as it is, if it had to be searched for.
///
/// `measure`  if false, nothing is measured: near creases, too, what faces away is passed over, and all the rest is
///            straight
void compute_geodesic_medial_axis(const Surface& surface, const SurfacePatches& patches, const Curve& curve,
                                  const Frames& frames, const BoundaryObstacle& boundary, BoundaryRule rule,
                                  bool measure, const LocalMetric& metric, const NodeData<Reach>& reach,
                                  ThreadPool& pool, CurveBvh& tree, NodeData<Radii>& radii, KeptBalls kept = {});

}  // namespace meander
