// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tangent, surface normal and bitangent of every node (section 3.2).
#pragma once

#include <array>
#include <vector>

#include "curve.h"
#include "parallel.h"

namespace meander {

/// Surface normals as a curve of radius r sees them.
///
/// The paper blends vertex normals over each face. That is right where faces are about as large as r
/// or smaller; in a face much larger than r it would tilt the tangent plane of a flat region, so the
/// blend is confined to within r of the face's edges. Where faces are much smaller than r, vertex
/// normals are averaged over about r / 2 first, so that noise in them does not turn the medial balls.
class NormalField {
 public:
  NormalField(const Surface& surface, double radius);

  /// Unit normal at a point; `radius` is the local r. Never against the face's own normal.
  Vec3 at(const SurfacePoint& point, double radius) const;
  /// The blended normal of a point given by weights of the corners of face f, for output.
  Vec3 blended(uint32_t f, double w0, double w1, double w2) const;

 private:
  const Surface& surface_;
  std::vector<Vec3> normals_;  // per vertex, unit
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
};

/// Fills `frames`; `local_radius` is r at every node.
void compute_frames(const Surface& surface, const Curve& curve, const std::vector<double>& local_radius,
                    Team& team, Frames& frames);

}  // namespace meander
