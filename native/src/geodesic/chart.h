// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface around a point, unrolled along straight lines from it.
#pragma once

#include "geodesic/constants.h"
#include "geodesic/geodesic_trace.h"

namespace meander {

/// A point of the surface as another one sees it along a path: the faces of the path, laid side by side, make one
/// plane, that of the face in which the path begins. A small value, for one thread.
struct Chart {
  SurfacePoint point;
  Vec2 place;       ///< where it lies in that plane, from where the path begins
  Vec2 turn{1, 0};  ///< carries a vector of the plane of the point's face to that plane
  Vec3 position;    ///< in space
  bool at_boundary = false;

  static Chart at(const SurfacePoint& p, const Vec3& position) { return {p, {0, 0}, {1, 0}, position, false}; }

  /// Goes straight on along a vector of the plane of the point's face; stops at the boundary.
  void advance(const Surface& s, Vec2 displacement) {
    GeodesicWalk walk(s, point, displacement);
    while (walk.step()) continue;
    const Vec2 direction = unit(displacement);
    place = place + walk.length() * (turn * direction);
    turn = turn * direction * conj(walk.direction());
    point = walk.end();
    position = meander::position(s, point);
    at_boundary = walk.hit_boundary();
  }

  /// Goes on to a point that is near, by straight lines that aim at it through space, until it is in the same face or
  /// in one beside it. False where that does not lead there, as where it is on another sheet; the chart is then
  /// somewhere on the way.
  ///
  /// `most`  lines longer than this are not led
  bool advance_to(const Surface& s, const SurfacePoint& aim, const Vec3& goal, double most);
};

/// The place of a point of the face across half-edge `exit` in the plane of the face of `exit`.
inline Vec2 place_across(const Surface& s, HalfEdge exit, HalfEdge entry, Vec2 p) {
  const Vec2 left = s.corner(face_of(exit), next_corner(corner_of(exit)));
  return frame_beside(s, entry, left, turn_across(s, {1, 0}, exit)).place(p);
}

inline bool Chart::advance_to(const Surface& s, const SurfacePoint& aim, const Vec3& goal, double most) {
  for (int line = 0; line <= kMostLinesOfChart; ++line) {
    if (point.face == aim.face) {
      place = place + turn * (flat(s, aim) - flat(s, point));
      point = aim;
      position = goal;
      return true;
    }
    for (uint32_t k = 0; k < 3; ++k) {
      const HalfEdge exit = 3 * point.face + k, entry = s.twin(exit);
      if (entry == kNone || face_of(entry) != aim.face) continue;
      place = place + turn * (place_across(s, exit, entry, flat(s, aim)) - flat(s, point));
      turn = turn * turn_across(s, {1, 0}, exit);
      point = aim;
      position = goal;
      return true;
    }
    if (line == kMostLinesOfChart) break;
    const Vec3 chord = goal - position;
    const Vec2 ahead = s.to_plane(point.face, chord);
    const double length = chord.norm(), seen = norm(ahead);
    if (!(seen > 0) || length > most) break;
    advance(s, (length / seen) * ahead);
    if (at_boundary) break;
  }
  return false;
}

}  // namespace meander
