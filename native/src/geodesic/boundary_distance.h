// SPDX-License-Identifier: GPL-3.0-or-later
//
// The distance from the boundary along the surface, close to the boundary.
#pragma once

#include "base/cancel_token.h"
#include "base/front_search.h"
#include "mesh/refined_surface.h"

namespace meander {

class PointTree;

/// The surface cut up near its boundary, with the distance from the boundary at every vertex.
///
/// Fast marching on triangles (Kimmel and Sethian, "Computing geodesic paths on manifolds", 1998): exact where
/// the boundary is straight. Lengths are in the surface's own unit.
class BoundaryDistance {
 public:
  /// Every edge that comes nearer to the boundary than `reach` is split until it is no longer than `edge`, and
  /// distances are known up to `reach` and a few edges more. Time and memory grow with (reach / edge^2) times
  /// the length of the boundary. `cancel` is asked every few hundred microseconds; throws
  /// Failure(FailureKind::kCancelled) where it stops this.
  BoundaryDistance(const Surface& surface, double reach, double edge, const CancelToken& cancel);

  const RefinedSurface& mesh() const { return mesh_; }
  /// A vertex of the mesh in the caller's space.
  const Vec3& caller_position(uint32_t v) const { return caller_[v]; }
  /// Infinite where the front has not been.
  double at(uint32_t v) const { return front_.cost(v); }

 private:
  void refine(const PointTree& boundary, double reach, double edge, const CancelToken& cancel);
  void march(double last, const CancelToken& cancel);
  void halve(HalfEdge h);
  double across(uint32_t a, uint32_t b, uint32_t c) const;

  RefinedSurface mesh_;
  std::vector<Vec3> caller_;  // per vertex
  FrontSearch<AllNodes> front_{AllNodes(0)};
};

}  // namespace meander
