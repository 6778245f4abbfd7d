// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shortens a path across faces to a locally shortest geodesic of the same homotopy class.
//
// Nodes move less than a spacing in a step, so the old path between two neighbours plus the two
// traces is already a path between their new places. It is pulled straight inside its strip of
// faces (the funnel of Lee and Preparata 1984); where it then bends around a vertex that has less
// than pi on its other side, the strip is flipped over to that side, and so on until nothing bends
// that could be straight (Xin and Wang 2007; Sharp and Crane 2020). It costs the faces it crosses,
// whatever the size of the mesh, and never jumps to another sheet.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geodesic/unfolding.h"
#include "mesh/surface_point.h"

namespace meander {

/// Length and end directions of a path.
struct PathShape {
  double length = 0;
  Vec2 leaving;   ///< unit direction at the start, in the plane of the start's face
  Vec2 arriving;  ///< unit direction at the end, in the plane of the end's face
};

/// The faces along a path, laid in the plane of the first one.
class UnfoldedStrip {
 public:
  UnfoldedStrip(const Surface& surface, uint32_t face)
      : surface_(surface), first_{surface.corner(face, 0), surface.corner(face, 1), surface.corner(face, 2)} {}

  /// Lays the next face beside the present one, which is left by a half-edge of it. Inline: as a call it costs a
  /// tenth more of what unfolding costs.
  [[gnu::always_inline]] void cross(const Crossing& c) {
    constexpr uint32_t kRight = Strip::kRight, kLeft = Strip::kLeft;
    if (entry_ == kNone) {
      strip_.exit = c.e;
      strip_.ends[kRight] = first_[corner_of(c.e)];
      strip_.ends[kLeft] = first_[next_corner(corner_of(c.e))];
    } else if (corner_of(c.e) == next_corner(corner_of(entry_))) {
      strip_.enter(entry_, apex_, kLeft);  // and on the right the edge ends where the one before it does
      ++left_id_;
    } else if (corner_of(c.e) == prev_corner(corner_of(entry_))) {
      strip_.enter(entry_, apex_, kRight);
      ++right_id_;
    } else {
      strip_.exit = c.e;  // back
      std::swap(strip_.ends[kLeft], strip_.ends[kRight]);
      ++left_id_;
      ++right_id_;
    }
    entry_ = c.twin;
    apex_ = strip_.lay_next(surface_, entry_);
  }

  /// The ends of the edge crossed last, as seen by someone who crosses it.
  Vec2 left() const { return strip_.left(); }
  Vec2 right() const { return strip_.right(); }
  /// Numbers of these ends: alike for edges in a row that share one.
  uint32_t left_id() const { return left_id_; }
  uint32_t right_id() const { return right_id_; }

  /// Where a point of the present face lies.
  Vec2 place(const SurfacePoint& p) const {
    std::array<Vec2, 3> corner = first_;
    if (entry_ != kNone) {
      const uint32_t k = corner_of(entry_);
      corner[k] = left();
      corner[next_corner(k)] = right();
      corner[prev_corner(k)] = apex_;
    }
    return p.weight(0) * corner[0] + p.b.x * corner[1] + p.b.y * corner[2];
  }
  /// A direction of the first face's plane in that of the present face.
  Vec2 carried(Vec2 direction) const {
    return entry_ == kNone ? direction : direction * unit(conj(right() - left()) * surface_.along(entry_));
  }

 private:
  using Strip = Unfolding;

  const Surface& surface_;
  std::array<Vec2, 3> first_;  // corners of the first face
  Strip strip_;                // at the edge crossed last, once there is one
  HalfEdge entry_ = kNone;     // by which the present face was entered, once another one has been left
  Vec2 apex_;                  // the present face's corner that is no end of that edge
  uint32_t left_id_ = 0, right_id_ = 0;
};

/// Scratch memory of one thread, reused from call to call.
class PathShortener {
 public:
  explicit PathShortener(const Surface& surface) : surface_(surface) {}

  /// Replaces `crossings`, any list of edges that leads from the face of `start` to the face of
  /// `end` (each crossing's twin lies in the face that the next one leaves), by that of a locally
  /// shortest path. Backtracking in the input is removed. Returns the path's shape.
  PathShape shorten(const SurfacePoint& start, const SurfacePoint& end, std::vector<Crossing>& crossings);

  /// The same for a `path` whose ends have walked away from it, each along its own trace, to `start` and `end`: it
  /// leads between the faces in which the traces begin. `crossings` receives the result; `path` is no part of it.
  PathShape follow(const SurfacePoint& start, const SurfacePoint& end, std::span<const Crossing> path,
                   std::span<const Crossing> start_trace, std::span<const Crossing> end_trace,
                   std::vector<Crossing>& crossings);

  /// The same for a path that was guessed: edges that lead from the face of `start` to that of `end`, or to
  /// one within three faces of it. Nothing if they lead elsewhere, and `crossings` may be anything then.
  std::optional<PathShape> adopt(const SurfacePoint& start, const SurfacePoint& end, std::vector<Crossing>& crossings);

 private:
  bool lead_to(uint32_t goal, uint32_t from, HalfEdge entry, int faces, std::vector<Crossing>& crossings) const;
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
  std::vector<Crossing> spliced_, so_far_;
  Vec2 start_, end_;
  Vec2 carried_;  // what (1, 0) of the start's plane is in the end's
};

/// The shape of a path as it is.
PathShape measure_path(const Surface& surface, const SurfacePoint& start, const SurfacePoint& end,
                       std::span<const Crossing> crossings);

/// Removes every crossing that is taken back at once.
void cancel_backtracks(std::vector<Crossing>& crossings);

}  // namespace meander
