// SPDX-License-Identifier: GPL-3.0-or-later
//
// The largest empty balls along the surface that touch a curve, by windows: all that straight lines from a node lead
// to, laid face after face into the plane of its face.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/thread_pool.h"
#include "mesh/surface_point.h"

namespace meander {

/// Points of a surface by the faces that they lie in. Any thread may ask.
class PointsOfFaces {
 public:
  struct Item {
    Vec2 b;  ///< as of a SurfacePoint
    uint32_t index;
  };

  /// Becomes the points of the indices below `count`; `point` gives the SurfacePoint of each.
  template <class PointOf>
  void sort(const Surface& surface, uint32_t count, const PointOf& point, ThreadPool& pool) {
    first_.assign(surface.face_count() + 2, 0);
    items_.resize(count);
    for (uint32_t i = 0; i < count; ++i) ++first_[point(i).face + 2];
    for (size_t f = 2; f < first_.size(); ++f) first_[f] += first_[f - 1];
    for (uint32_t i = 0; i < count; ++i) items_[first_[point(i).face + 1]++] = {point(i).b, i};
    sort_within_faces(surface, pool);
  }

  /// Those of a face: from the edge opposite to across(surface, face) on if there are more than kFewPointsOfFace, else
  /// in the order of their indices.
  std::span<const Item> of(uint32_t face) const {
    return std::span(items_).subspan(first_[face], first_[face + 1] - first_[face]);
  }

  /// The corner of a face that is farthest from the opposite edge: points far from one another along a thin face are so
  /// in their order then.
  static uint32_t across(const Surface& surface, uint32_t face);
  /// How much a corner weighs at a place of its face.
  static double weight(Vec2 b, uint32_t corner) { return corner == 0 ? 1 - b.x - b.y : corner == 1 ? b.x : b.y; }

 private:
  void sort_within_faces(const Surface& surface, ThreadPool& pool);

  std::vector<uint32_t> first_;  // of each face, and the end of the last
  std::vector<Item> items_;
};

/// One ball after the other, and the scratch memory of one thread.
///
/// A window is an edge that lines from the node enter a face by, its ends laid into the plane of the node's face, and
/// the wedge of those lines (as in Mitchell, Mount and Papadimitriou, "The Discrete Geodesic Problem", 1987). A point q
/// in the wedge limits a ball that grows in the direction B to |q|^2 / (2 q . B), as in the plane; the two other edges
/// of the face get their parts of the wedge as long as they meet the disc of the present radius. What is near through
/// space only is never looked at. Ways that bend at a vertex are not followed: they change less than .001 of the balls.
class WindowSearch {
 public:
  WindowSearch(const Surface& surface, const PointsOfFaces& points) : surface_(surface), points_(points) {}

  /// The radius of the largest empty ball on one side of a point, at most `most`; nullopt if that takes more than
  /// kMostWindowsOfBall.
  ///
  /// `self`   the index of the point, which does not count
  /// `ahead`  unit, in the plane of the point's face
  std::optional<double> largest(const SurfacePoint& from, uint32_t self, Vec2 ahead, double most);
  /// The index of what limits the last ball; kNone if nothing does.
  uint32_t touched() const { return touched_; }

 private:
  /// Places are from the node, which looks along the x axis.
  struct Window {
    HalfEdge entry;    // the edge, of the face behind it
    Vec2 left, right;  // its ends
    Vec2 high, low;    // the lines that bound the wedge, on the left and on the right
    double met;        // the radius with which the ball was found to meet it
  };

  bool meets(Vec2 a, Vec2 b) const;
  template <class Sees>
  void look_at(uint32_t face, Vec2 c0, Vec2 c1, Vec2 c2, const Sees& sees);
  void open(const Window& w);

  const Surface& surface_;
  const PointsOfFaces& points_;
  double least_ = 0;
  uint32_t self_ = kNone, touched_ = kNone;
  std::vector<Window> stack_;
};

}  // namespace meander
