// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a straight line ends: the straightest geodesic of geodesic_trace.h for those who only want to
// look. It keeps no path and rounds nothing to the grid, so it costs a fraction of a trace.
#pragma once

#include <algorithm>
#include <vector>

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

/// The straight line that leaves a point, for those who ask for many of its points: walk_straight() that
/// remembers the faces it has come through.
class StraightRay {
 public:
  /// `way` is a unit vector in the plane of the start's face. The surface must outlive the ray.
  void reset(const Surface& s, const FlatPoint& start, Vec2 way) {
    surface_ = &s;
    way_ = way;
    const Vec2 origin = -start.place;
    for (uint32_t k = 0; k < 3; ++k) {
      right_ = s.corner(start.face, k) + origin;
      left_ = s.corner(start.face, next_corner(k)) + origin;
      exit_ = 3 * start.face + k;
      if (cross(right_, way) >= 0 && cross(way, left_) > 0) break;
    }
    pieces_.assign(1, {0, start.face, origin, {1, 0}});
    until_ = reach_of_exit();
  }

  /// The point at a distance from the start, or where the line meets the boundary.
  Landing at(double distance) {
    while (distance > until_ && pieces_.size() < kMostFaces) {
      const HalfEdge entry = surface_->twin(exit_);
      if (entry == kNone) break;
      const Vec2 turn = pieces_.back().turn * conj(surface_->transition(exit_));
      const uint32_t f = face_of(entry), k = corner_of(entry), opposite = prev_corner(k);
      const Vec2 origin = left_ - turn * surface_->corner(f, k);
      pieces_.push_back({until_, f, origin, turn});
      const Vec2 tip = origin + turn * surface_->corner(f, opposite);
      if (cross(way_, tip) > 0) {
        left_ = tip;
        exit_ = 3 * f + next_corner(k);
      } else {
        right_ = tip;
        exit_ = 3 * f + opposite;
      }
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
    const Vec2 edge = left_ - right_;
    const double across = cross(way_, edge);
    return across != 0 ? cross(right_, edge) / across : pieces_.back().from;
  }

  const Surface* surface_ = nullptr;
  Vec2 way_, left_, right_;
  HalfEdge exit_ = kNone;
  double until_ = 0;  // the line leaves the last of the pieces here, through `exit_`
  std::vector<Piece> pieces_;
};

}  // namespace meander
