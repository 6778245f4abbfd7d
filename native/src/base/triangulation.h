// SPDX-License-Identifier: GPL-3.0-or-later
//
// Constrained Delaunay triangulation of one triangle with points and lines in it.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "base/plane.h"

namespace meander {

/// Points are given as a face has them: the weights of its corners 1 and 2, multiples of kGrain in [0, 1]. In which
/// triangle a point lies, and whether edges cross, is decided by those, exactly; which of two diagonals is the better
/// one, by where the points lie in the plane, with rounding that cannot make the triangulation wrong.
///
/// One point after another by splits and flips (Lawson, "Software for C1 surface interpolation", 1977), lines by flips
/// (Sloan, "A fast algorithm for generating constrained Delaunay triangulations", 1993). Points that come in the order
/// of a line are found in a few steps. Keeps its memory from triangle to triangle; for one thread.
class Triangulation {
 public:
  using Corners = std::array<uint32_t, 3>;
  static constexpr uint32_t kNothing = UINT32_MAX;

  /// Begins with a triangle whose corners lie at 0, `c1` and `c2` in the plane; they are the points 0, 1 and 2.
  void start(Vec2 c1, Vec2 c2);

  /// Adds a point and returns its number, that of an earlier point in the same place if there is one.
  uint32_t insert(Vec2 weights);

  /// Adds a point unless it comes nearer than `clearance` to the points, lines and sides that are next to it. Returns
  /// its number, or kNothing.
  uint32_t insert_clear(Vec2 weights, double clearance);

  /// Makes the straight line between two points an edge that stays. False where it runs into another point or
  /// crosses another line: then all is a triangulation still, without that edge.
  bool constrain(uint32_t a, uint32_t b);

  size_t point_count() const { return weights_.size(); }
  Vec2 weights(uint32_t point) const { return weights_[point]; }
  /// All triangles, counter-clockwise.
  const std::vector<Corners>& triangles() const { return corners_; }

 private:
  // Edge 3 t + k of triangle t runs from its corner k to corner k + 1.
  static uint32_t next(uint32_t edge) { return edge % 3 == 2 ? edge - 2 : edge + 1; }
  static uint32_t before(uint32_t edge) { return edge % 3 == 0 ? edge + 2 : edge - 1; }
  uint32_t from(uint32_t edge) const { return corners_[edge / 3][edge % 3]; }
  uint32_t to(uint32_t edge) const { return from(next(edge)); }
  uint32_t apex(uint32_t edge) const { return from(before(edge)); }
  int turn(uint32_t a, uint32_t b, uint32_t c) const { return orientation(weights_[a], weights_[b], weights_[c]); }

  struct Side {
    uint32_t twin = kNothing;
    bool fixed = false;
  };
  uint32_t locate(Vec2 p);
  bool holds(uint32_t triangle, Vec2 p) const;
  uint32_t add_point(Vec2 weights);
  uint32_t add_triangle();
  void set(uint32_t triangle, Corners corners, const std::array<Side, 3>& sides);
  uint32_t insert_into(uint32_t triangle, Vec2 weights);
  uint32_t split_triangle(uint32_t triangle, uint32_t p);
  uint32_t split_edge(uint32_t edge, uint32_t p);
  void flip(uint32_t edge);
  bool convex(uint32_t edge) const;
  bool improves(uint32_t edge) const;
  void improve();
  template <class Visit>
  void around(uint32_t point, const Visit& visit) const;
  uint32_t edge_between(uint32_t a, uint32_t b) const;
  std::optional<std::vector<uint32_t>> crossed(uint32_t a, uint32_t b) const;
  void fix(uint32_t edge);
  double distance(Vec2 p, uint32_t a, uint32_t b) const;

  Vec2 c1_, c2_;
  std::vector<Vec2> weights_, places_;  // per point
  std::vector<uint32_t> leaving_;       // per point: an edge that begins there
  std::vector<Corners> corners_;        // per triangle
  std::vector<Side> sides_;             // per edge
  std::vector<uint32_t> doubtful_;      // edges to look at
  uint32_t last_ = 0;                   // the triangle where the last point was found
};

}  // namespace meander
