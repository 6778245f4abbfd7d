// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tangent, surface normal and bitangent of every node (section 3.2).
#pragma once

#include <array>
#include <mutex>
#include <vector>

#include "curve.h"
#include "parallel.h"

namespace meander {

/// Surface normals for whoever renders or follows the curve; the flow itself needs none.
///
/// Vertex normals, weighted by angle and, where faces are much smaller than r, averaged over about
/// r / 2 so that noise in them does not show, blended over each face.
class NormalField {
 public:
  /// Finds them when they are first asked for, which may be on any thread.
  NormalField(const Surface& surface, double radius) : surface_(surface), radius_(radius) {}

  /// The unit normal at the point of face f with these weights of its corners.
  Vec3 blended(uint32_t f, double w0, double w1, double w2) const;

 private:
  void find() const;

  const Surface& surface_;
  double radius_;
  mutable std::once_flag found_;
  mutable std::vector<Vec3> normals_;  // per vertex, unit
};

/// Per node.
struct Frames {
  std::vector<Vec3> position;
  std::vector<Vec2> tangent;     ///< unit, in the plane of the node's face: bisects its two segments
  std::vector<Vec2> bitangent2;  ///< unit, B = T x N in the plane of the face, on the right of the way
  /// Unit directions in space to which the medial balls of both sides grow, normal to the curve: +B
  /// and -B on a plane.
  ///
  /// The paper takes +-B in the tangent plane of a blended normal. Where the surface bends within r,
  /// that plane leaves it: on limbs a few r thick radii come out too large, and at a crease they jump.
  /// Here each side looks along the chord to the point that a geodesic along +-B reaches after r,
  /// which is where the centre of a ball of the wanted size lies. It needs no normals, so noise in
  /// them does not matter.
  std::vector<std::array<Vec3, 2>> outward;
  /// How far the geodesic along +-B came before the boundary stopped it, at most r; negative where
  /// it was not stopped.
  std::vector<std::array<double, 2>> to_boundary;
  /// How fast the local r grows along that geodesic: its change per length. 0 without density.
  std::vector<std::array<double, 2>> radius_slope;
};

/// r at a point, from its values at the vertices.
inline double radius_at(const Surface& surface, const std::vector<double>& vertex_radius, const SurfacePoint& p) {
  const Triangle& t = surface.face(p.face);
  return p.weight(0) * vertex_radius[t[0]] + p.b.x * vertex_radius[t[1]] + p.b.y * vertex_radius[t[2]];
}

/// Fills `frames`; `local_radius` is r at every node, `vertex_radius` at every vertex.
void compute_frames(const Surface& surface, const Curve& curve, const std::vector<double>& local_radius,
                    const std::vector<double>& vertex_radius, Team& team, Frames& frames);

}  // namespace meander
