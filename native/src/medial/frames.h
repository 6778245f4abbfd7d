// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tangent, surface normal and bitangent of every node (section 3.2).
#pragma once

#include <array>
#include <vector>

#include "base/thread_pool.h"
#include "curve/curve.h"
#include "curve/local_metric.h"

namespace meander {

/// Of all nodes of a curve.
struct Frames {
  NodeData<Vec3> position;
  NodeData<Vec2> tangent;     ///< unit, in the plane of the node's face: bisects its two segments
  NodeData<Vec2> bitangent2;  ///< unit, B = T x N in the plane of the face, on the right of the strand
  /// Unit directions in space to which the medial balls of both sides grow, normal to the curve: +B
  /// and -B on a plane.
  ///
  /// The paper takes +-B in the tangent plane of a blended normal. Where the surface bends within r,
  /// that plane leaves it: on limbs a few r thick radii come out too large, and at a crease they jump.
  /// Here each side takes the chord to the point that a geodesic along +-B reaches after
  /// kChord local r (the centre of a ball of the wanted size is at 1), less the part of it that lies
  /// along the strand. That needs no normals, so noise in them does not matter.
  NodeData<std::array<Vec3, 2>> outward;
  /// How far the geodesic along +-B came before the boundary stopped it, at most kChord local r;
  /// negative where it was not stopped.
  NodeData<std::array<double, 2>> to_boundary;
  /// How fast the local r grows along that geodesic: its change per length. 0 without density.
  NodeData<std::array<double, 2>> radius_slope;
  /// 1 where geodesics were led, 0 where cached directions were good enough.
  NodeData<uint8_t> walked;

  /// Hands the memory of its lists on; what they say is lost.
  void hand_on() noexcept;
};

/// The directions that geodesics gave a node, to be used again while it hardly moves: see compute_frames.
struct CachedDirections {
  Eigen::Vector3f from{0, 0, 0};  ///< where the node was
  float radius = 0;               ///< the local r there; 0: nothing is known
  std::array<float, 2> radius_slope{};
  std::array<Eigen::Vector3f, 2> outward;
};

/// Fills `frames`; `metric` is that of the nodes, `radius` is r.
///
/// `cached`  directions per node, or null: a node within kFrameRest of where its directions were found, and whose
///           strand has not turned by more than kFrameTurn since, leads no geodesics but turns them with its
///           strand. They are then off by an angle of the order of kFrameRest, less where the surface is smooth.
///           Nodes whose geodesics met the boundary always lead them again.
void compute_frames(const Surface& surface, const Curve& curve, const LocalMetric& metric, const RadiusField& radius,
                    ThreadPool& pool, Frames& frames, const NodeData<CachedDirections>* cached = nullptr);

/// Writes down the directions of the nodes that have `walked`.
void remember_directions(const Frames& frames, const LocalMetric& metric, ThreadPool& pool,
                         NodeData<CachedDirections>& cached);

}  // namespace meander
