// SPDX-License-Identifier: GPL-3.0-or-later
//
// Delaunay's question: where a point lies seen from a circle through three others.
#pragma once

#include <cmath>

#include "base/plane.h"
#include "mesh/constants.h"

namespace meander {

/// Where is d, 1 inside of the circle through a, b and c, counter-clockwise, -1 outside, 0 near enough to be on it?
///
/// A point counts as inside of a circle, or outside, only where rounding cannot be the reason (Shewchuk, "Adaptive
/// precision floating-point arithmetic and fast robust geometric predicates", 1997, its first bound): every flip then
/// brings the triangulation nearer to Delaunay's, and flips come to an end.
inline int in_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const Vec2 p = a - d, q = b - d, r = c - d;
  const double pp = dot(p, p), qq = dot(q, q), rr = dot(r, r);
  const double qr[] = {q.x * r.y, q.y * r.x}, rp[] = {r.x * p.y, r.y * p.x}, pq[] = {p.x * q.y, p.y * q.x};
  const double determinant = pp * (qr[0] - qr[1]) + qq * (rp[0] - rp[1]) + rr * (pq[0] - pq[1]);
  const double size = pp * (std::abs(qr[0]) + std::abs(qr[1])) + qq * (std::abs(rp[0]) + std::abs(rp[1])) +
                      rr * (std::abs(pq[0]) + std::abs(pq[1]));
  if (std::abs(determinant) > kCircleError * size) return determinant > 0 ? 1 : -1;
  return 0;
}

}  // namespace meander
