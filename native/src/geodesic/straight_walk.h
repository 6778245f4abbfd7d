// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a straight line ends: the straightest geodesic of geodesic_trace.h for those who only want to
// look. It keeps no path and rounds nothing to the grid, so it costs a fraction of a trace.
#pragma once

#include <algorithm>
#include <vector>

#include "mesh/surface.h"

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

/// The faces along a line that leaves a point, one after the other, unfolded into the plane of the first
/// with the point as the origin.
struct UnfoldedLine {
  uint32_t face = 0;
  Vec2 origin;       ///< of the plane of the face
  Vec2 turn{1, 0};   ///< carries a vector of the plane of the face to that of the first
  Vec2 right, left;  ///< the line leaves the face between them, the ends of half-edge `exit`
  HalfEdge exit = kNone;

  UnfoldedLine() = default;
  UnfoldedLine(const Surface& s, const FlatPoint& start, Vec2 way) : face(start.face), origin(-start.place) {
    for (uint32_t k = 0; k < 3; ++k) {
      right = s.corner(face, k) + origin;
      left = s.corner(face, next_corner(k)) + origin;
      exit = 3 * face + k;
      if (cross(right, way) >= 0 && cross(way, left) > 0) break;
    }
  }

  /// On into the next face; false at the boundary.
  bool step(const Surface& s, Vec2 way) {
    const HalfEdge entry = s.twin(exit);
    if (entry == kNone) return false;
    turn = turn * conj(s.transition(exit));
    face = face_of(entry);
    const uint32_t k = corner_of(entry), opposite = prev_corner(k);
    origin = left - turn * s.corner(face, k);
    const Vec2 tip = origin + turn * s.corner(face, opposite);
    if (cross(way, tip) > 0) {
      left = tip;
      exit = 3 * face + next_corner(k);
    } else {
      right = tip;
      exit = 3 * face + opposite;
    }
    return true;
  }
};

/// Walks from `start` by `way`, both in the plane of the start's face, unfolding face after face; stops
/// at the boundary.
inline Landing walk_straight(const Surface& s, const FlatPoint& start, Vec2 way) {
  constexpr int kMostFaces = 100000;  // see trace_geodesic
  UnfoldedLine line(s, start, way);
  Landing landing;
  for (int steps = 0; steps < kMostFaces; ++steps) {
    if (cross(line.left - line.right, way - line.right) >= 0) break;
    if (!line.step(s, way)) {
      const Vec2 edge = line.left - line.right;
      way = (cross(line.right, edge) / cross(way, edge)) * way;
      landing.hit_boundary = true;
      break;
    }
  }
  landing.turn = line.turn;
  landing.end = {line.face, conj(line.turn) * (way - line.origin)};
  return landing;
}

/// The straight line that leaves a point, for those who ask for many of its points: walk_straight() that
/// remembers the faces it has come through.
class StraightRay {
 public:
  /// `way` is a unit vector in the plane of the start's face. The surface must outlive the ray.
  void reset(const Surface& s, const FlatPoint& start, Vec2 way) {
    surface_ = &s;
    way_ = way;
    line_ = UnfoldedLine(s, start, way);
    pieces_.assign(1, {0, line_.face, line_.origin, line_.turn});
    until_ = reach_of_exit();
  }

  /// The point at a distance from the start, or where the line meets the boundary.
  Landing at(double distance) {
    while (distance > until_ && pieces_.size() < kMostFaces) {
      if (!line_.step(*surface_, way_)) break;
      pieces_.push_back({until_, line_.face, line_.origin, line_.turn});
      until_ = std::max(until_, reach_of_exit());
    }
    const bool beyond = distance > until_;
    size_t p = pieces_.size() - 1;
    while (p > 0 && pieces_[p].from > distance) --p;
    const Piece& piece = pieces_[p];
    const double length = beyond ? until_ : distance;
    return {{piece.face, conj(piece.turn) * (length * way_ - piece.origin)}, piece.turn, beyond};
  }

 private:
  static constexpr size_t kMostFaces = 100000;
  struct Piece {
    double from;    // distance at which the line enters the face
    uint32_t face;  // whose plane's origin is unfolded to `origin`, and turned by `turn`
    Vec2 origin, turn;
  };

  double reach_of_exit() const {
    const Vec2 edge = line_.left - line_.right;
    const double across = cross(way_, edge);
    return across != 0 ? cross(line_.right, edge) / across : pieces_.back().from;
  }

  const Surface* surface_ = nullptr;
  Vec2 way_;
  UnfoldedLine line_;  // at the last of the pieces
  double until_ = 0;   // where the line leaves it
  std::vector<Piece> pieces_;
};

}  // namespace meander
