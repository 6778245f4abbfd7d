// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lays faces beside one another in one plane: what traces, rays, strips of paths and windows of exact distances
// have in common.
#pragma once

#include "mesh/surface.h"

namespace meander {

/// The third corner of a face one of whose half-edges, that of corner k, lies between `start` and `end`: one
/// complex product, whatever the face's own plane.
inline Vec2 third_corner(const Surface::Hinges& hinges, uint32_t k, Vec2 start, Vec2 end) {
  return start + (end - start) * hinges.apex[k];
}

/// Where the plane of a face lies in the common one: a rotation and a translation.
struct FaceFrame {
  Vec2 origin;     ///< of the face's plane
  Vec2 turn{1, 0}; ///< carries a vector of the face's plane to the common one

  Vec2 place(Vec2 p) const { return origin + turn * p; }
  /// A point of the common plane in the face's own.
  Vec2 local(Vec2 p) const { return conj(turn) * (p - origin); }
};

/// The rotation of the face across `exit`, from that of the face that it leaves.
inline Vec2 turn_across(const Surface& s, Vec2 turn, HalfEdge exit) { return turn * conj(s.transition(exit)); }

/// The frame of the face of `entry`, a half-edge that starts at `left`.
inline FaceFrame frame_beside(const Surface& s, HalfEdge entry, Vec2 left, Vec2 turn) {
  return {left - turn * s.corner(face_of(entry), corner_of(entry)), turn};
}

/// A face laid in a plane, with the edge by which it is left; the next face is laid across that edge. A small value,
/// for one thread.
struct Unfolding {
  static constexpr uint32_t kRight = 0, kLeft = 1;

  HalfEdge exit = kNone;  ///< by which the face is left; runs from its right end to its left one
  Vec2 ends[2];           ///< of the exit, kRight and kLeft of someone who crosses it
  Vec2 behind;            ///< the third corner

  Vec2 right() const { return ends[kRight]; }
  Vec2 left() const { return ends[kLeft]; }

  /// The third corner of the face across the exit, whose half-edge there is `entry`. It is laid by the shape of its
  /// triangle on the edge that is there, which fetches a single cache line; of the face's own plane nothing is known.
  Vec2 lay_next(const Surface& s, HalfEdge entry) const {
    return third_corner(s.hinges(face_of(entry)), corner_of(entry), ends[kLeft], ends[kRight]);
  }
  /// Makes that face the present one. `apex` is on `side` of the edge by which it will be left; the end on the
  /// other side stays. Without a branch, since walks turn left and right at random.
  void enter(HalfEdge entry, Vec2 apex, uint32_t side) {
    behind = ends[side];
    ends[side] = apex;
    const uint32_t corner = corner_of(entry) + 2 - side;
    exit = 3 * face_of(entry) + (corner >= 3 ? corner - 3 : corner);
  }
};

}  // namespace meander
