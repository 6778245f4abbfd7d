// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of a triangle that is in a rectangle.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "base/plane.h"

namespace meander {

/// What of a triangle is in a rectangle.
struct ClippedTriangle {
  bool empty = true;
  double area = 0;
  Vec2 middle{0, 0};  // of its area, or of its corners where it has none
};

/// By clipping against one side after the other (Sutherland and Hodgman, "Reentrant polygon clipping", 1974).
///
/// `triangle`   counter-clockwise
/// `low`, `high`  opposite corners of the rectangle, whose sides are along the axes
inline ClippedTriangle clip_triangle(const std::array<Vec2, 3>& triangle, Vec2 low, Vec2 high) {
  std::array<Vec2, 8> corners{triangle[0], triangle[1], triangle[2]}, clipped;
  size_t count = 3;
  for (const auto& [normal, least] : {std::pair{Vec2{1, 0}, low.x}, {Vec2{-1, 0}, -high.x},
                                      {Vec2{0, 1}, low.y}, {Vec2{0, -1}, -high.y}}) {
    size_t kept = 0;
    for (size_t k = 0; k < count; ++k) {
      const Vec2 here = corners[k], next = corners[(k + 1) % count];
      const double inside = dot(normal, here) - least, then = dot(normal, next) - least;
      if (inside >= 0) clipped[kept++] = here;
      if ((inside >= 0) != (then >= 0)) clipped[kept++] = here + (inside / (inside - then)) * (next - here);
    }
    std::swap(corners, clipped);
    count = kept;
  }
  ClippedTriangle part;
  if (count == 0) return part;
  part.empty = false;
  Vec2 moment{0, 0}, sum{0, 0};
  for (size_t k = 0; k < count; ++k) {
    const Vec2 a = corners[k] - corners[0], b = corners[(k + 1) % count] - corners[0];
    const double twice = cross(a, b);
    part.area += 0.5 * twice;
    moment = moment + (twice / 6) * (a + b);
    sum = sum + a;
  }
  part.middle = corners[0] + (part.area > 0 ? (1 / part.area) * moment : (1.0 / static_cast<double>(count)) * sum);
  // Of slivers the quotient is not exact.
  part.middle = {std::clamp(part.middle.x, low.x, high.x), std::clamp(part.middle.y, low.y, high.y)};
  return part;
}

}  // namespace meander
