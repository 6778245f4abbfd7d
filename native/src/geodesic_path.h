// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shortens a path across faces to a locally shortest geodesic of the same homotopy class.
//
// Nodes move less than a spacing in a step, so the old path between two neighbours plus the two
// traces is already a path between their new places. It is pulled straight inside its strip of
// faces (the funnel of Lee and Preparata 1984); where it then bends round a vertex that has less
// than pi on its other side, the strip is flipped over to that side, and so on until nothing bends
// that could be straight (Xin and Wang 2007; Sharp and Crane 2020). It costs the faces it crosses,
// whatever the size of the mesh, and never jumps to another sheet.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "surface_point.h"

namespace meander {

/// Length and end directions of a path.
struct PathShape {
  double length = 0;
  Vec2 leaving;   ///< unit direction at the start, in the plane of the start's face
  Vec2 arriving;  ///< unit direction at the end, in the plane of the end's face
};

/// Lays face after face of a strip in the plane of the first one.
class Unfolding {
 public:
  Unfolding(const Surface& surface, uint32_t face);

  /// Lays the next face beside the present one, across half-edge e of the present one.
  void cross(HalfEdge e);

  /// Where things of the present face lie.
  Vec2 corner(uint32_t k) const { return corners_[k]; }
  Vec2 place(const SurfacePoint& p) const;
  /// Whether e shares its left or its right end with the edge crossed last; left and right as seen by
  /// who leaves the face across it.
  bool keeps_left(HalfEdge e) const { return next_corner(corner_of(e)) == entry_; }
  bool keeps_right(HalfEdge e) const { return prev_corner(corner_of(e)) == entry_; }
  /// A direction of the first face's plane in that of the present face.
  Vec2 carried(Vec2 direction) const;

 private:
  const Surface& surface_;
  uint32_t face_;
  uint32_t entry_ = kNone;  // the corner at which the half-edge starts by which the face was entered
  Vec2 corners_[3];
};

/// Scratch memory of one thread, reused from call to call.
class PathShortener {
 public:
  explicit PathShortener(const Surface& surface) : surface_(surface) {}

  /// Replaces `crossings`, any list of edges that leads from the face of `start` to the face of
  /// `end` (each crossing's twin lies in the face that the next one leaves), by that of a locally
  /// shortest path. Backtracking in the input is removed. Returns the path's shape.
  PathShape shorten(const SurfacePoint& start, const SurfacePoint& end, std::vector<Crossing>& crossings);

 private:
  struct Portal {
    Vec2 left, right;               // ends of the crossed edge in the unfolded strip
    uint32_t left_id, right_id;     // alike where portals in a row share an end
  };
  struct Bend {
    size_t portal;  // index of the portal at whose end the path bends
    bool left;
  };
  void unfold(const SurfacePoint& start, const SurfacePoint& end, const std::vector<Crossing>& crossings);
  bool is_straight(std::vector<Crossing>& crossings) const;
  void pull();
  std::pair<size_t, size_t> run_of(const Bend& bend) const;
  bool flip(std::vector<Crossing>& crossings);
  bool flip_at(const Bend& bend, size_t index, std::vector<Crossing>& crossings);
  void cross_portals(std::vector<Crossing>& crossings) const;

  const Surface& surface_;
  std::vector<Portal> portals_;
  std::vector<Bend> bends_;
  std::vector<Vec2> corners_;  // of the pulled path: start, bends, end
  std::vector<Crossing> spliced_;
  Vec2 start_, end_;
  Vec2 carried_;  // what (1, 0) of the start's plane is in the end's
};

/// The shape of a path as it is.
PathShape measure_path(const Surface& surface, const SurfacePoint& start, const SurfacePoint& end,
                       std::span<const Crossing> crossings);

/// Removes every crossing that is taken back at once.
void cancel_backtracks(const Surface& surface, std::vector<Crossing>& crossings);

}  // namespace meander
