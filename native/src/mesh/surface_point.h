// SPDX-License-Identifier: GPL-3.0-or-later
//
// A point of the surface: a face and barycentric coordinates, always strictly inside the face.
#pragma once

#include <algorithm>

#include "mesh/constants.h"
#include "mesh/surface.h"

namespace meander {

/// A point strictly inside `face`, with weights (1 - b.x - b.y, b.x, b.y) of its corners; the weights
/// are multiples of kGrain, so that their sum is exact.
struct SurfacePoint {
  uint32_t face = 0;
  Vec2 b;

  double weight(uint32_t k) const { return k == 0 ? 1 - b.x - b.y : (k == 1 ? b.x : b.y); }
};

/// The point of face f with about these weights (any real numbers; they are clamped and rounded).
inline SurfacePoint make_point(uint32_t f, double w0, double w1, double w2) {
  w0 = std::max(w0, kClearance);
  w1 = std::max(w1, kClearance);
  w2 = std::max(w2, kClearance);
  const double sum = w0 + w1 + w2;
  // Weights of 2 kClearance and more stay above kClearance after division by a sum below 2.
  const double x = std::max(snap(w1 / sum), kClearance), y = std::max(snap(w2 / sum), kClearance);
  SurfacePoint p{f, {x, y}};
  if (1 - x - y < kClearance) (x > y ? p.b.x : p.b.y) = 1 - kClearance - (x > y ? y : x);
  return p;
}

/// The point in the plane of its face.
inline Vec2 flat(const Surface& s, const SurfacePoint& p) {
  return p.b.x * s.corner(p.face, 1) + p.b.y * s.corner(p.face, 2);
}

/// The point in space, in the surface's own unit; `corners` are those of its face.
inline Vec3 position(const Surface& s, const Triangle& corners, const SurfacePoint& p) {
  return p.weight(0) * s.position(corners[0]) + p.b.x * s.position(corners[1]) + p.b.y * s.position(corners[2]);
}
inline Vec3 position(const Surface& s, const SurfacePoint& p) { return position(s, s.face(p.face), p); }

/// The point of face f nearest to the point `q` of its plane, for points inside it.
inline SurfacePoint point_at(const Surface& s, uint32_t f, Vec2 q) {
  const Vec2 c1 = s.corner(f, 1), c2 = s.corner(f, 2);
  const double w2 = q.y / c2.y;
  const double w1 = (q.x - w2 * c2.x) / c1.x;
  return make_point(f, 1 - w1 - w2, w1, w2);
}

/// Where a path leaves a face: at the share t, in (0, 1), of its half-edge e. t is a multiple of
/// kGrain, so the same point seen from the twin, 1 - t, is exact. The twin is stored: on a fine mesh, following
/// a path would otherwise have to fetch every face of it for that alone.
struct Crossing {
  HalfEdge e = 0, twin = 0;
  double t = 0.5;
};

inline Crossing crossing_of(const Surface& s, HalfEdge e, double t) { return {e, s.twin(e), t}; }

inline double clear_of_ends(double t) { return snap(std::clamp(t, kClearance, 1 - kClearance)); }

inline Crossing reversed(const Crossing& c) { return {c.twin, c.e, 1 - c.t}; }

/// Barycentric (b.x, b.y) of the point at share t of half-edge e, in the face of e; exact. Without a branch: a curve
/// leaves faces by any of their edges.
inline Vec2 on_edge(HalfEdge e, double t) {
  struct Line {
    Vec2 start, along;
  };
  static constexpr Line kEdges[3] = {{{0, 0}, {1, 0}}, {{1, 0}, {-1, 1}}, {{0, 1}, {0, -1}}};
  const Line& edge = kEdges[corner_of(e)];
  return edge.start + t * edge.along;
}

/// The point at share t of half-edge e, in the plane of its face.
inline Vec2 flat_on_edge(const Surface& s, const Crossing& c) {
  const uint32_t f = face_of(c.e), k = corner_of(c.e);
  return (1 - c.t) * s.corner(f, k) + c.t * s.corner(f, next_corner(k));
}

inline Vec3 position(const Surface& s, const Crossing& c) {
  const Triangle& t = s.face(face_of(c.e));
  const uint32_t k = corner_of(c.e);
  return (1 - c.t) * s.position(t[k]) + c.t * s.position(t[next_corner(k)]);
}

}  // namespace meander
