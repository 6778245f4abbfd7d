// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/line_field.h"

#include <cmath>

#include "mesh/constants.h"

namespace meander {

Vec2 square_root(Vec2 square) {
  const double length = norm(square);
  if (!(length > 0)) return {};
  // The larger part first, so that there is no cancellation.
  if (square.x >= 0) {
    const double x = std::sqrt(0.5 * (length + square.x));
    return {x, 0.5 * square.y / x};
  }
  const double y = std::sqrt(0.5 * (length - square.x));
  return {0.5 * square.y / y, y};
}

LineField::LineField(const Surface& surface, const VertexData<Vec3>& directions, bool across) {
  std::vector<Vec2> square(3 * surface.face_count());
  bool any = false;
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    const Vec3 x = surface.to_space(f, {1, 0}), y = surface.to_space(f, {0, 1});
    for (uint32_t k = 0; k < 3; ++k) {
      Vec3 v = directions[surface.face(f)[k]];
      // Divided first: squares of lengths must not overflow or underflow.
      const double largest = v.cwiseAbs().maxCoeff();
      if (!v.allFinite() || !(largest > 0)) continue;
      v = (v / largest).normalized();
      const Vec2 flat{v.dot(x), v.dot(y)};
      if (!(norm(flat) > kLeastTangential)) continue;
      const Vec2 line = unit(across ? Vec2{0, 1} * flat : flat);
      square[3 * f + k] = norm(flat) * (line * line);
      any = true;
    }
  }
  if (any) square_ = std::move(square);
}

void LineField::ride(const Surface& from, const Surface& to) {
  for (uint32_t f = 0; 3 * size_t{f} < square_.size(); ++f) {
    const Vec2 c1 = from.corner(f, 1), c2 = from.corner(f, 2), d1 = to.corner(f, 1), d2 = to.corner(f, 2);
    for (uint32_t k = 0; k < 3; ++k) {
      Vec2& square = square_[3 * size_t{f} + k];
      const Vec2 line = square_root(square);
      const double b = line.y / c2.y, a = (line.x - b * c2.x) / c1.x;
      const Vec2 moved = unit(a * d1 + b * d2);
      square = norm(line) > 0 ? norm(square) * (moved * moved) : Vec2{};
    }
  }
}

Vec2 LineField::at(const SurfacePoint& p) const {
  const Vec2* square = &square_[3 * size_t{p.face}];
  return square_root(p.weight(0) * square[0] + p.b.x * square[1] + p.b.y * square[2]);
}

}  // namespace meander
