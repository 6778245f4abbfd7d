// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vectors of the plane, read as complex numbers, and the exact orientation predicate.
//
// Every face has a plane of its own (see Surface), and carrying a vector from one to the next, or
// along the curve, is a multiplication by a unit complex number. std::complex is not used because
// its product has to look for NaN unless the compiler is told otherwise.
#pragma once

#include <cfloat>
#include <cmath>

#include "base/constants.h"

namespace meander {

struct Vec2 {
  double x = 0;
  double y = 0;
};

inline Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
inline Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
inline Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
inline Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
/// Complex product: turns and scales `a` by `b`.
inline Vec2 operator*(Vec2 a, Vec2 b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }

inline Vec2 conj(Vec2 a) { return {a.x, -a.y}; }
inline double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
inline double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double norm(Vec2 a) { return std::sqrt(dot(a, a)); }
/// `a` scaled to length 1; the zero vector stays zero.
inline Vec2 unit(Vec2 a) {
  const double n = norm(a);
  return n > 0 ? Vec2{a.x / n, a.y / n} : Vec2{};
}

static_assert(FLT_EVAL_METHOD == 0, "snap() and orientation() need every result to be rounded to a double");

/// The multiple of kGrain nearest to t in [-2, 2), the even one of two: what a sum between 4 and 8 is rounded
/// to. std::nearbyint would be a call of a library.
inline double snap(double t) { return (t + 6) - 6; }

/// Sign (-1, 0, 1) of the area of the triangle a b c, exact for snapped coordinates in [0, 1].
///
/// The four differences are exact; rounding is monotonic, so two different rounded products are in
/// the order of the true ones; if they are equal, their rounding errors, which fma gives exactly,
/// decide.
inline int orientation(Vec2 a, Vec2 b, Vec2 c) {
  const double ux = b.x - a.x, uy = b.y - a.y;
  const double vx = c.x - a.x, vy = c.y - a.y;
  const double p = ux * vy;
  const double q = uy * vx;
  if (p != q) return p > q ? 1 : -1;
  const double pe = std::fma(ux, vy, -p);
  const double qe = std::fma(uy, vx, -q);
  return pe > qe ? 1 : (pe < qe ? -1 : 0);
}

}  // namespace meander
