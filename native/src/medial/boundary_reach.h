// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the boundary of an open surface ends the medial balls, so that the last strand rests at its
// distance from it.
#pragma once

#include <array>
#include <vector>

#include "base/point_tree.h"
#include "geodesic/surface_patches.h"
#include "medial/curve_bvh.h"
#include "medial/frames.h"
#include "medial/medial_plan.h"
#include "medial/radii.h"

namespace meander {

/// How a ball ends at the boundary of the surface; see MEANDER_BOUNDARY_...
enum class BoundaryRule { kCentre, kObstacle };

/// The boundary of an open surface, as the medial axis needs it. Immutable; empty if closed.
class BoundaryObstacle {
 public:
  /// Samples boundary *edges* at most `step` apart, so that a coarse boundary does not leak.
  ///
  /// `apart`  whether a component of the surface sees nothing of the boundary of another, as where distances are along
  ///          the surface
  BoundaryObstacle(const Surface& surface, double step, bool apart = false);

  const std::vector<Vec3>& samples() const { return tree_.points(); }
  /// The boundary edges that the samples lie on.
  const std::vector<HalfEdge>& edges() const { return edges_; }
  /// Unit directions into the surface at the samples; in the middle between those of two edges at a vertex.
  const std::vector<Vec3>& inward() const { return inward_; }
  const PointTree& tree() const { return tree_; }
  /// The samples again, in a part for each component of the surface if these are apart. Those of a loop come one after
  /// the other, as it needs them.
  const CurveBvh& bvh() const { return bvh_; }
  /// Samples of one edge are no farther apart.
  double step() const { return step_; }
  bool empty() const { return tree_.points().empty(); }

 private:
  std::vector<HalfEdge> edges_;
  std::vector<Vec3> inward_;
  double step_;
  PointTree tree_;
  std::vector<uint32_t> parts_;  // of the samples; empty: there is one
  CurveBvh bvh_;
};

/// What the boundary leaves of a ball on one side of a node.
struct ReachOfSide {
  double radius = 0;  ///< the largest, if that is less than `sought`
  double sought = 0;  ///< the boundary was looked for no farther than balls of this radius need
  /// As what the boundary counts for the forces: less than `radius` where the node is nearer than it
  /// should be, negative where it is to be pushed harder than an empty ball pushes.
  double driving = 0;

  bool operator==(const ReachOfSide&) const = default;
};

/// On the side of the bitangent, and on the other.
using Reach = std::array<ReachOfSide, 2>;

/// What the reach is a function of. Refers to what it is given.
struct ReachScene {
  const Surface& surface;
  const Curve& curve;
  const Frames& frames;
  const BoundaryObstacle& boundary;
  BoundaryRule rule;
  const SurfacePatches* patches;  ///< null where balls are straight; else what they hide from a node does not count
  const LocalMetric& metric;      ///< clamps of at most kMostRadius
  MedialPlan plan = {};
};

/// The reach of all nodes. The distance to the boundary is that along the surface in the direction of the
/// bitangent; where the boundary is nearer than `least_rest`, corners of it that jut out beside that geodesic count as
/// well.
///
/// In `driving`, what a ball that ends at the boundary falls short of its least_rest counts twice, less with
/// boundary_ease, and more where it is far short. Under BoundaryRule::kObstacle overhang and least_rest are taken to be
/// 0.
///
/// Most of the cost is leading geodesics, and most balls are far smaller than they may be. So the boundary may be
/// looked for no farther than balls will probably reach; where they turn out to be larger, complete_reach does the
/// rest.
///
/// `likely`  empty, or the radii that balls had, 0 where nothing is known: the boundary is looked for within kWarmth
///           times those, within least_rest and boundary_within, and where balls are measured as far as may be
void compute_reach(const ReachScene& scene, const NodeData<Radii>& likely, ThreadPool& pool, NodeData<Reach>& reach);

/// Looks on for the boundary where radii are larger than what it was sought for, and makes them no larger than it
/// allows: `reach` and `radii` are then as if it had been sought as far as balls may reach.
void complete_reach(const ReachScene& scene, ThreadPool& pool, NodeData<Reach>& reach, NodeData<Radii>& radii);

}  // namespace meander
