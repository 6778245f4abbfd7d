// SPDX-License-Identifier: GPL-3.0-or-later
//
// The curve: strands of nodes, joined by geodesic segments.
#pragma once

#include <cstdint>
#include <vector>

#include "geodesic/geodesic_path.h"
#include "mesh/surface_point.h"

namespace meander {

/// The edges that a segment crosses between its two nodes.
using Path = std::vector<Crossing>;

/// Begins to fetch the crossings of a path: each has memory of its own somewhere, so who goes through many of them asks
/// for them some segments ahead.
inline void fetch(const Path& path) { __builtin_prefetch(path.data()); }

/// Nodes first .. first + count - 1, in order. A closed strand also joins the last to the first.
/// All nodes of a guide are fixed, and those that are added to it are as well.
struct Strand {
  uint32_t first = 0;
  uint32_t count = 0;
  bool closed = true;
  bool guide = false;

  uint32_t end() const { return first + count; }
  uint32_t segment_count() const { return closed ? count : count - 1; }
};

/// A straight piece of a segment inside one face, ends in barycentric (b.x, b.y) coordinates.
struct Piece {
  uint32_t face;
  uint32_t segment;
  Vec2 from, to;
};

/// Segment i joins node i to next(i); the last node of an open strand has none (an empty path).
class Curve {
 public:
  Table<SurfacePoint> nodes;
  Table<uint8_t> fixed;    ///< per node: 1 never moves
  std::vector<Strand> strands;   ///< consecutive, covering all nodes
  Table<Path> paths;       ///< per segment: the edges it crosses, in order
  Table<PathShape> shapes; ///< per segment

  uint32_t size() const { return static_cast<uint32_t>(nodes.size()); }
  uint32_t next(uint32_t i) const { return next_[i]; }      ///< kNone at an open end
  uint32_t previous(uint32_t i) const { return previous_[i]; }
  bool has_segment(uint32_t i) const { return next_[i] != kNone; }
  bool has_guides() const { return !on_guide_.empty(); }
  /// Does node i, and the segment after it, belong to a guide?
  bool on_guide(uint32_t i) const { return !on_guide_.empty() && on_guide_[i] != 0; }

  /// Recomputes next, previous and on_guide from the strands; call after they changed.
  void link();

  /// Hands the memory of its lists on, but for the paths, each of which keeps its own. What it says is lost.
  void hand_on() noexcept;

  /// The same for all memory.
  void hand_all_on() noexcept {
    hand_on();
    meander::hand_on(paths);
  }

  /// Becomes a curve like `other` whose nodes, paths and shapes are still to be found; keeps their memory.
  void lay_out_as(const Curve& other);

  /// The straight pieces of all segments, in order.
  void pieces(std::vector<Piece>& out) const;
  /// Calls put(piece) for the straight pieces of segment i, in order.
  template <class Put>
  void pieces_of(uint32_t i, const Put& put) const {
    pieces_along(i, paths[i], put);
  }
  /// The same where the path of the segment is `path`, and not yet in `paths`.
  template <class Put>
  void pieces_along(uint32_t i, const Path& path, const Put& put) const {
    Piece piece{nodes[i].face, i, nodes[i].b, {}};
    for (const Crossing& c : path) {
      piece.to = on_edge(c.e, c.t);
      put(piece);
      const Crossing r = reversed(c);
      piece.face = face_of(r.e);
      piece.from = on_edge(r.e, r.t);
    }
    piece.to = nodes[next_[i]].b;
    put(piece);
  }

  /// Calls visit(face) for the face of each of them, in the same order.
  template <class Visit>
  void faces_along(uint32_t i, const Path& path, const Visit& visit) const {
    visit(nodes[i].face);
    for (const Crossing& c : path) visit(face_of(c.twin));
  }

  double length() const;
  /// Of the strands that may move.
  double growing_length() const;

 private:
  Table<uint32_t> next_, previous_;
  Table<uint8_t> on_guide_;  // empty where there are no guides
};

/// The length of a curve on a surface of the same faces and other vertices, in its own unit.
double length_on(const Surface& surface, const Curve& curve);

}  // namespace meander
