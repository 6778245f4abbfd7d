// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic/windows.h"

#include <array>

#include "geodesic/constants.h"
#include "geodesic/unfolding.h"

namespace meander {

uint32_t PointsOfFaces::across(const Surface& surface, uint32_t face) {
  const auto opposite = [&](uint32_t k) {
    const Vec2 edge = surface.corner(face, prev_corner(k)) - surface.corner(face, next_corner(k));
    return dot(edge, edge);
  };
  uint32_t farthest = 1;
  for (const uint32_t k : {2u, 0u}) {
    if (opposite(k) < opposite(farthest)) farthest = k;
  }
  return farthest;
}

void PointsOfFaces::sort_within_faces(const Surface& surface, ThreadPool& pool) {
  constexpr size_t kBlock = 1024;
  pool.for_each(first_.size() - 2, kBlock, [&](uint32_t f) {
    const std::span<Item> items = std::span(items_).subspan(first_[f], first_[f + 1] - first_[f]);
    if (items.size() <= kFewPointsOfFace) return;
    const uint32_t corner = across(surface, f);
    std::sort(items.begin(), items.end(), [&](const Item& a, const Item& b) {
      const double of_a = weight(a.b, corner), of_b = weight(b.b, corner);
      return of_a != of_b ? of_a < of_b : a.index < b.index;
    });
  });
}

/// Whether the disc of the present ball holds any of a segment.
bool WindowSearch::meets(Vec2 a, Vec2 b) const {
  const Vec2 centre{least_, 0}, u = a - centre, v = b - centre, d = b - a;
  const double squared = least_ * least_;
  if (dot(u, u) < squared || dot(v, v) < squared) return true;
  const double along = -dot(u, d), length = dot(d, d), beside = cross(u, d);
  return along > 0 && along < length && beside * beside < squared * length;
}

/// Makes the ball no larger than the points of a face allow that sees(place) holds for; its corners are given.
template <class Sees>
inline void WindowSearch::look_at(uint32_t face, Vec2 c0, Vec2 c1, Vec2 c2, const Sees& sees) {
  const std::span<const PointsOfFaces::Item> points = points_.of(face);
  if (points.empty()) return;
  const Vec2 e1 = c1 - c0, e2 = c2 - c0;
  auto first = points.begin(), last = points.end();
  if (points.size() > kFewPointsOfFace) {
    // They are in an order across the face, from an edge on: only a strip of it is as near as the disc.
    const uint32_t corner = PointsOfFaces::across(surface_, face);
    const Vec2 corners[3] = {c0, c1, c2}, edge_start = corners[next_corner(corner)];
    const Vec2 edge = corners[prev_corner(corner)] - edge_start;
    const double across = cross(e1, e2), middle = cross(edge, Vec2{least_, 0} - edge_start) / across;
    const double half = least_ * norm(edge) / across;
    const auto before = [&](const PointsOfFaces::Item& p, double x) { return PointsOfFaces::weight(p.b, corner) < x; };
    first = std::lower_bound(first, last, middle - half, before);
    last = std::lower_bound(first, last, middle + half, before);
  }
  for (; first != last; ++first) {
    const Vec2 q = c0 + first->b.x * e1 + first->b.y * e2;
    const double squared = dot(q, q);
    if (!(squared < 2 * least_ * q.x) || !sees(q) || first->index == self_) continue;
    least_ = squared / (2 * q.x);
    touched_ = first->index;
  }
}

std::optional<double> WindowSearch::largest(const SurfacePoint& from, uint32_t self, Vec2 ahead, double most) {
  least_ = most;
  self_ = self;
  touched_ = kNone;
  stack_.clear();
  const Vec2 turn = conj(ahead), place = flat(surface_, from);
  std::array<Vec2, 3> c;
  for (uint32_t k = 0; k < 3; ++k) c[k] = turn * (surface_.corner(from.face, k) - place);
  look_at(from.face, c[0], c[1], c[2], [](Vec2) { return true; });
  const Surface::Hinges& hinges = surface_.hinges(from.face);
  for (uint32_t k = 0; k < 3; ++k) {
    const Vec2 right = c[k], left = c[next_corner(k)];
    if (hinges.twin[k] != kNone && meets(right, left)) {
      stack_.push_back({hinges.twin[k], left, right, left, right, least_});
    }
  }
  for (size_t opened = 0; !stack_.empty();) {
    const Window w = stack_.back();
    stack_.pop_back();
    if (w.met != least_ && !meets(w.right, w.left)) continue;
    if (++opened > kMostWindowsOfBall) return std::nullopt;
    open(w);
  }
  return least_;
}

/// Looks at the face behind a window, and takes note of those behind its other edges.
void WindowSearch::open(const Window& w) {
  const uint32_t f = face_of(w.entry), k = corner_of(w.entry);
  const Surface::Hinges& hinges = surface_.hinges(f);
  std::array<Vec2, 3> c;
  c[k] = w.left;
  c[next_corner(k)] = w.right;
  const Vec2 apex = c[prev_corner(k)] = third_corner(hinges, k, w.left, w.right);
  look_at(f, c[0], c[1], c[2], [&](Vec2 q) { return cross(w.low, q) >= 0 && cross(q, w.high) >= 0; });
  const double from_low = cross(w.low, apex), to_high = cross(apex, w.high);
  const HalfEdge to_right = hinges.twin[next_corner(k)], to_left = hinges.twin[prev_corner(k)];
  if (from_low > 0 && to_right != kNone && meets(w.right, apex)) {
    stack_.push_back({to_right, apex, w.right, to_high > 0 ? apex : w.high, w.low, least_});
  }
  if (to_high > 0 && to_left != kNone && meets(apex, w.left)) {
    stack_.push_back({to_left, w.left, apex, w.high, from_low > 0 ? apex : w.low, least_});
  }
}

}  // namespace meander
