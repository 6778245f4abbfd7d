// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fast marching: a front that passes a mesh, triangle after triangle.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/eigen.h"
#include "base/front_search.h"
#include "mesh/refined_surface.h"

namespace meander {

/// A front that has passed two corners of a triangle, a and b, and comes to the third one (Kimmel and Sethian,
/// "Computing geodesic paths on manifolds", 1998). In coordinates along ab, from a on, and across.
struct FrontOverEdge {
  double length;       ///< of ab
  double x, y;         ///< the third corner
  double from;         ///< the front's distance at a
  double slope, rise;  ///< its normal, if it is straight

  /// b and the third corner relative to a, and the front's distance at a and b.
  FrontOverEdge(const Vec3& u, const Vec3& w, double at_a, double at_b)
      : length(u.norm()),
        x(w.dot(u) / length),
        y(std::sqrt(std::max(0.0, w.squaredNorm() - x * x))),
        from(at_a),
        slope((at_b - at_a) / length),
        rise(std::sqrt(std::max(0.0, 1 - slope * slope))) {}

  /// False where no straight front has these distances at a and b.
  bool is_possible() const { return std::abs(slope) < 1; }
  /// Where on ab the way to the third corner crosses it; beyond an end of ab the triangle knows nothing of that way.
  double foot() const { return x - y * slope / rise; }
  /// When a straight front passes the third corner.
  double distance() const { return from + slope * x + rise * y; }
};

/// What follows for its neighbours where a front passes vertex v: calls reach(at, corner, other, passed) for the
/// corners of the faces there that it has not passed. `at` is the face's corner at v, `other` the third one, and
/// `passed` whether the front has passed that.
template <class Reach>
void reach_from(const RefinedSurface& mesh, const FrontSearch<AllNodes>& front, uint32_t v, const Reach& reach) {
  mesh.each_leaving(v, [&](HalfEdge h) {
    const HalfEdge a = mesh.next(h), b = mesh.prev(h);
    const bool passed_a = front.done(mesh.to(h)), passed_b = front.done(mesh.from(b));
    if (!passed_a) reach(h, a, b, passed_b);
    if (!passed_b) reach(h, b, a, passed_a);
  });
}

}  // namespace meander
