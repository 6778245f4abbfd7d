// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a straight line ends: the straightest geodesic of geodesic_trace.h for those who only want to
// look. It keeps no path and rounds nothing to the grid, so it costs a fraction of a trace.
#pragma once

#include "surface.h"

namespace meander {

/// A point in the plane of a face.
struct FlatPoint {
  uint32_t face = 0;
  Vec2 place;
};

struct Landing {
  FlatPoint end;
  Vec2 turn{1, 0};  ///< carries a vector of the plane of the end's face back to that of the start's
  bool hit_boundary = false;
};

inline Vec3 position(const Surface& s, const FlatPoint& p) {
  return s.position(s.face(p.face)[0]) + s.to_space(p.face, p.place);
}

/// Walks from `start` by `way`, both in the plane of the start's face, unfolding face after face; stops
/// at the boundary.
inline Landing walk_straight(const Surface& s, const FlatPoint& start, Vec2 way) {
  constexpr int kMostFaces = 100000;  // see trace_geodesic
  Landing landing{start, {1, 0}, false};
  uint32_t f = start.face;
  // Everything is unfolded about the start, the origin. The line leaves the face between `right` and
  // `left`, the ends of half-edge `exit`.
  Vec2 origin = -start.place, right, left;
  HalfEdge exit = kNone;
  for (uint32_t k = 0; k < 3; ++k) {
    right = s.corner(f, k) + origin;
    left = s.corner(f, next_corner(k)) + origin;
    exit = 3 * f + k;
    if (cross(right, way) >= 0 && cross(way, left) > 0) break;
  }
  for (int steps = 0; steps < kMostFaces; ++steps) {
    if (cross(left - right, way - right) >= 0) break;
    const HalfEdge entry = s.twin(exit);
    if (entry == kNone) {
      const Vec2 edge = left - right;
      way = (cross(right, edge) / cross(way, edge)) * way;
      landing.hit_boundary = true;
      break;
    }
    landing.turn = landing.turn * conj(s.transition(exit));
    f = face_of(entry);
    const uint32_t k = corner_of(entry), opposite = prev_corner(k);
    origin = left - landing.turn * s.corner(f, k);
    const Vec2 tip = origin + landing.turn * s.corner(f, opposite);
    if (cross(way, tip) > 0) {
      left = tip;
      exit = 3 * f + next_corner(k);
    } else {
      right = tip;
      exit = 3 * f + opposite;
    }
  }
  landing.end = {f, conj(landing.turn) * (way - origin)};
  return landing;
}

}  // namespace meander
