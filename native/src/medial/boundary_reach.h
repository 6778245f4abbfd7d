// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the boundary of an open surface ends the medial balls, so that the last strand rests at its
// distance from it.
#pragma once

#include <array>
#include <vector>

#include "base/point_tree.h"
#include "geodesic/surface_patches.h"
#include "medial/frames.h"

namespace meander {

/// How a ball ends at the boundary of the surface; see MEANDER_BOUNDARY_...
enum class BoundaryRule { kCentre, kObstacle };

/// The boundary of an open surface, as the medial axis needs it. Immutable; empty if closed.
class BoundaryObstacle {
 public:
  /// Samples boundary *edges* at most `step` apart, so that a coarse boundary does not leak.
  BoundaryObstacle(const Surface& surface, double step);

  const std::vector<Vec3>& samples() const { return tree_.points(); }
  /// The boundary edges that the samples lie on.
  const std::vector<HalfEdge>& edges() const { return edges_; }
  /// Unit directions into the surface at the samples; in the middle between those of two edges at a vertex.
  const std::vector<Vec3>& inward() const { return inward_; }
  const PointTree& tree() const { return tree_; }
  /// Samples of one edge are no farther apart.
  double step() const { return step_; }
  bool empty() const { return tree_.points().empty(); }

 private:
  std::vector<HalfEdge> edges_;
  std::vector<Vec3> inward_;
  double step_;
  PointTree tree_;
};

/// What the boundary leaves of a ball on one side of a node.
struct ReachOfSide {
  double radius = 0;  ///< the largest
  double centre = 0;  ///< how far its centre may go on the surface: less where it may pass the boundary
  /// As what the boundary counts for the forces: less than `radius` where the node is nearer than it
  /// should be, negative where it is to be pushed harder than an empty ball pushes.
  double driving = 0;

  bool operator==(const ReachOfSide&) const = default;
};

/// On the side of the bitangent, and on the other.
using Reach = std::array<ReachOfSide, 2>;

/// The reach of all nodes. The distance to the boundary is that along the surface in the direction of the
/// bitangent; where the boundary is nearer than `least_rest`, corners of it that jut out beside that geodesic count as
/// well.
///
/// `patches`  null where balls are straight; else what of the boundary they hide from a node does not count
/// `metric`  clamps of at most CurveBvh::kMostRadius. In `driving`, what a ball that ends at the boundary falls
///           short of its least_rest counts twice, and more where it is far short. Under
///           BoundaryRule::kObstacle overhang and least_rest are taken to be 0.
void compute_reach(const Surface& surface, const Curve& curve, const Frames& frames,
                   const BoundaryObstacle& boundary, BoundaryRule rule, const SurfacePatches* patches,
                   const LocalMetric& metric, ThreadPool& pool, NodeData<Reach>& reach);

}  // namespace meander
