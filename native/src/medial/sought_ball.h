// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ball along the surface that is sought on one side of a node, and what any of its finders asks.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "geodesic/chart.h"
#include "medial/ball_limit.h"
#include "medial/constants.h"
#include "medial/geodesic_scene.h"

namespace meander {

struct SoughtBall {
  const GeodesicScene& scene;
  uint32_t node;
  double r;        ///< the local one
  double most;     ///< no larger ball is sought
  double likely;   ///< it is probably less than this, which only saves time; at most `most`
  BallLimit straight;  ///< the ball through space among what the node sees
  Vec3 outward;        ///< unit, how it grows in space
  Vec2 ahead;          ///< unit, how it grows in the plane of the node's face
  uint32_t patch = scene.obstacles.patch(node);
  double along = outward.dot(scene.surface.to_space(face(), ahead));  ///< cosine of the angle between the two

  SoughtBall(const GeodesicScene& of, uint32_t i, size_t side, double local_r, double largest, double likely_less,
             BallLimit straight_limit)
      : scene(of),
        node(i),
        r(local_r),
        most(largest),
        likely(likely_less),
        straight(straight_limit),
        outward(of.frames.outward[i][side]),
        ahead((side == 0 ? 1.0 : -1.0) * of.frames.bitangent2[i]) {}

  uint32_t face() const { return scene.curve.nodes[node].face; }
  uint32_t part() const { return scene.obstacles.part(node); }
  const Vec3& position() const { return scene.obstacles.positions()[node]; }
  BallStart start() const { return {scene.frames.position[node], outward}; }
  Chart here() const { return Chart::at(scene.curve.nodes[node], position()); }
  /// Whether the two directions are much the same: round the edge of a blade, where they are not, what limits the
  /// straight ball is no help in finding what limits the ball along the surface.
  bool straight_on() const { return along >= kMuchTheSame; }
  /// Whether what limits the straight ball is met along the surface as well, straight or round a bend.
  bool meets_straight() const {
    return straight.touched != kNone && straight_on() &&
           (straight.radius <= kWideAtEdge * r || !scene.patches.sharp(patch));
  }

  /// The radius that something in a place of the plane leaves of a ball.
  double limited(double radius, Vec2 place) const {
    const double before = dot(place, ahead);
    return before > 0 ? std::min(radius, dot(place, place) / (2 * before)) : radius;
  }
  /// Whether the straight line to a point lies along the surface.
  bool alike(uint32_t p) const;
  /// Whether a straight ball of this radius reaches a crease: a little more than it, as on a surface that bends a
  /// little its centre is not quite known.
  bool holds_crease(double radius) const {
    return scene.patches.crease_within(scene.frames.position[node] + radius * outward, kCreaseMargin * radius);
  }
};

/// The neighbours of a node on its strand, each led to by a line of its own: they lie almost to the side, where a small
/// error of a place, or of a direction, makes another ball of them.
struct StrandNeighbours {
  std::array<uint32_t, 2> nodes;  ///< kNone where no line has led to one
  double radius;                  ///< what they leave of the ball

  explicit StrandNeighbours(const SoughtBall& ball);
  bool has(uint32_t i) const { return std::ranges::find(nodes, i) != nodes.end(); }
};

}  // namespace meander
