// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a straight line ends: the straightest geodesic of geodesic_trace.h for callers who only ask where it
// leads. It keeps no path and rounds nothing to the grid, so it costs a fraction of a trace.
#pragma once

#include <algorithm>
#include <vector>

#include "geodesic/unfolding.h"

namespace meander {

/// A point in the plane of a face.
struct FlatPoint {
  uint32_t face = 0;
  Vec2 place;
};

/// Where a straight line has led.
struct Landing {
  FlatPoint end;
  Vec2 turn{1, 0};  ///< carries a vector of the plane of the end's face back to that of the start's
  bool hit_boundary = false;
};

inline Vec3 position(const Surface& s, const FlatPoint& p) {
  return s.position(s.face(p.face)[0]) + s.to_space(p.face, p.place);
}

/// The faces along a line that leaves a point, one after the other, in the plane of the first with the point as
/// the origin.
struct LineUnfolding : Unfolding {
  FaceFrame frame;  ///< of the present face

  LineUnfolding() = default;
  LineUnfolding(const Surface& s, const FlatPoint& start, Vec2 direction) {
    frame.origin = -start.place;
    for (uint32_t k = 0; k < 3; ++k) {
      ends[kRight] = s.corner(start.face, k) + frame.origin;
      ends[kLeft] = s.corner(start.face, next_corner(k)) + frame.origin;
      exit = 3 * start.face + k;
      if (cross(right(), direction) >= 0 && cross(direction, left()) > 0) break;
    }
  }

  uint32_t face() const { return face_of(exit); }

  /// On into the next face; false at the boundary.
  bool step(const Surface& s, Vec2 direction) {
    const HalfEdge entry = s.twin(exit);
    if (entry == kNone) return false;
    frame = frame_beside(s, entry, left(), turn_across(s, frame.turn, exit));
    const Vec2 apex = frame.place(s.corner(face_of(entry), prev_corner(corner_of(entry))));
    enter(entry, apex, cross(direction, apex) > 0 ? kLeft : kRight);
    return true;
  }
};

/// Walks from `start` along `displacement`, both in the plane of the start's face; stops at the boundary.
inline Landing walk_straight(const Surface& s, const FlatPoint& start, Vec2 displacement) {
  constexpr int kMostFaces = 100000;  // see trace_geodesic
  LineUnfolding line(s, start, displacement);
  Landing landing;
  for (int steps = 0; steps < kMostFaces; ++steps) {
    const Vec2 edge = line.left() - line.right();
    if (cross(edge, displacement - line.right()) >= 0) break;
    if (!line.step(s, displacement)) {
      displacement = (cross(line.right(), edge) / cross(displacement, edge)) * displacement;
      landing.hit_boundary = true;
      break;
    }
  }
  landing.turn = line.frame.turn;
  landing.end = {line.face(), line.frame.local(displacement)};
  return landing;
}

/// The straight line that leaves a point, for callers who ask for many of its points: walk_straight() that
/// remembers the faces it has come through.
class StraightRay {
 public:
  /// `direction` is a unit vector in the plane of the start's face. The surface must outlive the ray.
  void reset(const Surface& s, const FlatPoint& start, Vec2 direction) {
    surface_ = &s;
    direction_ = direction;
    line_ = LineUnfolding(s, start, direction);
    pieces_.assign(1, {0, line_.face(), line_.frame});
    until_ = reach_of_exit();
  }

  /// The point at a distance from the start, or where the line meets the boundary.
  Landing at(double distance) {
    while (distance > until_ && pieces_.size() < kMostFaces) {
      if (!line_.step(*surface_, direction_)) break;
      pieces_.push_back({until_, line_.face(), line_.frame});
      until_ = std::max(until_, reach_of_exit());
    }
    const bool beyond = distance > until_;
    size_t p = pieces_.size() - 1;
    while (p > 0 && pieces_[p].from > distance) --p;
    const Piece& piece = pieces_[p];
    const double length = beyond ? until_ : distance;
    return {{piece.face, piece.frame.local(length * direction_)}, piece.frame.turn, beyond};
  }

 private:
  static constexpr size_t kMostFaces = 100000;
  struct Piece {
    double from;  // distance at which the line enters the face
    uint32_t face;
    FaceFrame frame;
  };

  double reach_of_exit() const {
    const Vec2 edge = line_.left() - line_.right();
    const double across = cross(direction_, edge);
    return across != 0 ? cross(line_.right(), edge) / across : pieces_.back().from;
  }

  const Surface* surface_ = nullptr;
  Vec2 direction_;
  LineUnfolding line_;  // at the last of the pieces
  double until_ = 0;    // where the line leaves it
  std::vector<Piece> pieces_;
};

}  // namespace meander
