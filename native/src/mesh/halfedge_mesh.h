// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface's faces as a half-edge mesh whose edges can be halved.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/surface.h"

namespace meander {

/// A copy of a surface's faces, for work off the hot path that a Surface, which never changes, does not allow.
/// Vertices and faces keep their numbers; vertices that no face uses are isolated ones.
///
/// Half-edges 2 e and 2 e + 1 are the two directions of edge e, and numbers stay when edges are split. One half-edge of
/// an edge on the boundary has no face. Set up from the neighbours that the surface knows, in linear time.
///
/// Belongs to one thread while edges are split; any thread may read it otherwise. Keeps nothing of the surface.
class HalfedgeMesh {
 public:
  /// Throws Failure(FailureKind::kOutOfMemory) where the numbers, which have 31 bits, run out.
  explicit HalfedgeMesh(const Surface& surface);

  size_t vertex_count() const { return position_.size(); }
  size_t edge_count() const { return half_.size() / 2; }
  size_t face_count() const { return first_.size(); }

  static HalfEdge opposite(HalfEdge h) { return h ^ 1; }
  uint32_t to(HalfEdge h) const { return half_[h].to; }
  uint32_t from(HalfEdge h) const { return half_[opposite(h)].to; }
  /// kNone beyond the boundary.
  uint32_t face(HalfEdge h) const { return half_[h].face; }
  /// Those of the same face; h has one.
  HalfEdge next(HalfEdge h) const { return half_[h].next; }
  HalfEdge prev(HalfEdge h) const { return next(next(h)); }
  /// One of the three of a face.
  HalfEdge first(uint32_t face) const { return first_[face]; }

  /// Calls `visit` with every half-edge of a face that leaves v, counter-clockwise.
  template <class Visit>
  void each_leaving(uint32_t v, Visit visit) const {
    const HalfEdge begin = leaving_[v];
    if (begin == kNone) return;
    HalfEdge h = begin;
    do {
      visit(h);
      h = opposite(prev(h));
    } while (face(h) != kNone && h != begin);
  }

  /// In the surface's own unit, and in the caller's space.
  const Vec3& position(uint32_t v) const { return position_[v]; }
  const Vec3& caller_position(uint32_t v) const { return caller_[v]; }
  double length(HalfEdge h) const { return (position(to(h)) - position(from(h))).norm(); }
  Vec3 middle(HalfEdge h) const { return 0.5 * (position(from(h)) + position(to(h))); }

  /// Halves the edge of h and the faces beside it, and returns the new vertex. Edge and faces keep their numbers for
  /// one half each; the new vertex, edges and faces have the next ones. Linear interpolation, so the surface stays
  /// where it is. Throws as the constructor does.
  uint32_t split(HalfEdge h);

 private:
  struct Half {
    uint32_t to, next, face;
  };
  HalfEdge add_edge(uint32_t from, uint32_t to);
  uint32_t add_face();
  void set_face(uint32_t face, HalfEdge a, HalfEdge b, HalfEdge c);

  std::vector<Half> half_;
  std::vector<HalfEdge> first_;          // per face
  std::vector<HalfEdge> leaving_;        // per vertex: of a face; on the boundary the clockwise-most; or kNone
  std::vector<Vec3> position_, caller_;  // per vertex
};

}  // namespace meander
