// SPDX-License-Identifier: GPL-3.0-or-later
//
// The implicit medial axis: on each side of a node, the largest ball that is tangent to the curve
// there and holds no other node (section 3.2.2, eq. 6).
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "frames.h"
#include "point_tree.h"

namespace meander {

/// How a ball ends at the boundary of the surface; see MEANDER_BOUNDARY_...
enum class BoundaryRule { kCentre, kObstacle };

/// Whether balls are straight through space or along the surface; see MEANDER_MEDIAL_AXIS_...
enum class MedialAxis { kEuclidean, kGeodesic };

/// r+ (on the side of the bitangent) and r- of a node.
using Radii = std::array<double, 2>;

/// The boundary of an open surface, as the medial axis needs it. Immutable; empty if closed.
class BoundaryObstacle {
 public:
  /// Samples boundary *edges* at most `step` apart, so that a coarse boundary does not leak.
  BoundaryObstacle(const Surface& surface, double step);

  const std::vector<Vec3>& samples() const { return tree_.points(); }
  /// The boundary edges that the samples lie on.
  const std::vector<HalfEdge>& edges() const { return edges_; }
  const PointTree& tree() const { return tree_; }
  bool empty() const { return tree_.points().empty(); }

 private:
  std::vector<HalfEdge> edges_;
  PointTree tree_;
};

/// What the boundary leaves of a node's ball on one side: its largest radius, and how far its centre may
/// go on the surface, which is less where the centre may pass the boundary.
struct Reach {
  double radius = 0, centre = 0;
};

/// Both sides of a node under BoundaryRule::kCentre; see compute_medial_axis.
std::array<Reach, 2> reach_of_balls(const Surface& surface, const Curve& curve, const Frames& frames,
                                    const BoundaryObstacle& boundary, uint32_t node, double max_radius,
                                    double overhang, double least_rest, std::vector<Crossing>& scratch);

/// Computes both radii of every node, exactly: tangent balls at a node are nested, so the largest one
/// that is empty is the smallest of those through any other node (after Ma, Bae, Choi, "3D medial axis
/// point approximation using nearest neighbors and the normal field", 2012; see RunTree).
///
/// `max_radius`  clamp of every node, at most RunTree::kMostRadius
/// `overhang`    BoundaryRule::kCentre: how far the centre of a node's ball may pass the boundary, or,
///               where negative, must stay away from it
/// `least_rest`  BoundaryRule::kCentre: what a ball that ends so falls short of this counts twice
/// `radii`       in: radii of an earlier state (0: unknown), which only save time; out: the result
void compute_medial_axis(const Surface& surface, const Curve& curve, const Frames& frames,
                         const BoundaryObstacle& boundary, BoundaryRule rule,
                         const std::vector<double>& max_radius, const std::vector<double>& overhang,
                         const std::vector<double>& least_rest, Team& team, std::vector<Radii>& radii);

}  // namespace meander
