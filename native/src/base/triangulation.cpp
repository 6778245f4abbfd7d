// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/triangulation.h"

#include <algorithm>
#include <cmath>


namespace meander {
namespace {

/// A point counts as inside of a circle only where rounding cannot be the reason (Shewchuk, "Adaptive precision
/// floating-point arithmetic and fast robust geometric predicates", 1997, its first bound): every flip then brings the
/// triangulation nearer to Delaunay's, and flips come to an end.
constexpr double kCircleError = 1.1102230246251577e-15;

/// Is d inside of the circle through a, b and c, counter-clockwise?
bool in_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const Vec2 p = a - d, q = b - d, r = c - d;
  const double pp = dot(p, p), qq = dot(q, q), rr = dot(r, r);
  const double qr[] = {q.x * r.y, q.y * r.x}, rp[] = {r.x * p.y, r.y * p.x}, pq[] = {p.x * q.y, p.y * q.x};
  const double determinant = pp * (qr[0] - qr[1]) + qq * (rp[0] - rp[1]) + rr * (pq[0] - pq[1]);
  const double size = pp * (std::abs(qr[0]) + std::abs(qr[1])) + qq * (std::abs(rp[0]) + std::abs(rp[1])) +
                      rr * (std::abs(pq[0]) + std::abs(pq[1]));
  return determinant > kCircleError * size;
}

}  // namespace

void Triangulation::start(Vec2 c1, Vec2 c2) {
  c1_ = c1;
  c2_ = c2;
  weights_.clear();
  places_.clear();
  leaving_.clear();
  corners_.clear();
  sides_.clear();
  doubtful_.clear();
  last_ = 0;
  add_point({0, 0});
  add_point({1, 0});
  add_point({0, 1});
  set(add_triangle(), {0, 1, 2}, {});
}

uint32_t Triangulation::add_point(Vec2 weights) {
  weights_.push_back(weights);
  places_.push_back(weights.x * c1_ + weights.y * c2_);
  leaving_.push_back(kNothing);
  return static_cast<uint32_t>(weights_.size() - 1);
}

uint32_t Triangulation::add_triangle() {
  corners_.emplace_back();
  sides_.resize(sides_.size() + 3);
  return static_cast<uint32_t>(corners_.size() - 1);
}

void Triangulation::set(uint32_t triangle, Corners corners, const std::array<Side, 3>& sides) {
  corners_[triangle] = corners;
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t edge = 3 * triangle + k;
    sides_[edge] = sides[k];
    if (sides[k].twin != kNothing) sides_[sides[k].twin].twin = edge;
    leaving_[corners[k]] = edge;
  }
}

bool Triangulation::holds(uint32_t triangle, Vec2 p) const {
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t edge = 3 * triangle + k;
    if (orientation(weights_[from(edge)], weights_[to(edge)], p) < 0) return false;
  }
  return true;
}

/// A walk towards the point; it ends in Delaunay triangulations, which this one is but for rounding and lines.
uint32_t Triangulation::locate(Vec2 p) {
  uint32_t triangle = last_;
  for (size_t steps = 0; steps < 2 * corners_.size() + 8; ++steps) {
    uint32_t exit = kNothing;
    for (uint32_t k = 0; k < 3 && exit == kNothing; ++k) {
      const uint32_t edge = 3 * triangle + static_cast<uint32_t>((k + steps) % 3);
      if (orientation(weights_[from(edge)], weights_[to(edge)], p) < 0) exit = edge;
    }
    if (exit == kNothing) return last_ = triangle;
    if (sides_[exit].twin == kNothing) break;
    triangle = sides_[exit].twin / 3;
  }
  for (triangle = 0; triangle < corners_.size(); ++triangle) {
    if (holds(triangle, p)) return last_ = triangle;
  }
  return kNothing;
}

uint32_t Triangulation::insert(Vec2 weights) { return insert_into(locate(weights), weights); }

uint32_t Triangulation::insert_into(uint32_t triangle, Vec2 weights) {
  if (triangle == kNothing) return kNothing;
  uint32_t on = kNothing;
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t edge = 3 * triangle + k, corner = corners_[triangle][k];
    if (weights_[corner].x == weights.x && weights_[corner].y == weights.y) return corner;
    if (orientation(weights_[from(edge)], weights_[to(edge)], weights) == 0) on = edge;
  }
  const uint32_t p = add_point(weights);
  return on == kNothing ? split_triangle(triangle, p) : split_edge(on, p);
}

uint32_t Triangulation::insert_clear(Vec2 weights, double clearance) {
  const uint32_t triangle = locate(weights);
  if (triangle == kNothing) return kNothing;
  const Vec2 p = weights.x * c1_ + weights.y * c2_;
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t edge = 3 * triangle + k;
    if (orientation(weights_[from(edge)], weights_[to(edge)], weights) == 0) return kNothing;
    if (norm(places_[from(edge)] - p) < clearance) return kNothing;
    const uint32_t twin = sides_[edge].twin;
    if (twin == kNothing || sides_[edge].fixed) {
      if (distance(p, from(edge), to(edge)) < clearance) return kNothing;
    } else if (norm(places_[apex(twin)] - p) < clearance) {
      return kNothing;
    }
  }
  return insert_into(triangle, weights);
}

double Triangulation::distance(Vec2 p, uint32_t a, uint32_t b) const {
  const Vec2 along = places_[b] - places_[a];
  const double length = dot(along, along);
  const double share = length > 0 ? std::clamp(dot(p - places_[a], along) / length, 0.0, 1.0) : 0;
  return norm(places_[a] + share * along - p);
}

uint32_t Triangulation::split_triangle(uint32_t t, uint32_t p) {
  const auto [a, b, c] = corners_[t];
  const Side ab = sides_[3 * t], bc = sides_[3 * t + 1], ca = sides_[3 * t + 2];
  const uint32_t u = add_triangle(), w = add_triangle();
  set(t, {a, b, p}, {ab, Side{3 * u + 2}, Side{3 * w + 1}});
  set(u, {b, c, p}, {bc, Side{3 * w + 2}, Side{3 * t + 1}});
  set(w, {c, a, p}, {ca, Side{3 * t + 2}, Side{3 * u + 1}});
  doubtful_.insert(doubtful_.end(), {3 * t, 3 * u, 3 * w});
  improve();
  return p;
}

uint32_t Triangulation::split_edge(uint32_t edge, uint32_t p) {
  const uint32_t a = from(edge), b = to(edge), c = apex(edge), t = edge / 3;
  const Side ab = sides_[edge], bc = sides_[next(edge)], ca = sides_[before(edge)];
  const uint32_t t1 = add_triangle();
  if (ab.twin == kNothing) {
    set(t, {c, a, p}, {ca, Side{kNothing, ab.fixed}, Side{3 * t1 + 1}});
    set(t1, {b, c, p}, {bc, Side{3 * t + 2}, Side{kNothing, ab.fixed}});
    doubtful_.insert(doubtful_.end(), {3 * t, 3 * t1});
  } else {
    const uint32_t twin = ab.twin, u = twin / 3, d = apex(twin);
    const Side ad = sides_[next(twin)], db = sides_[before(twin)];
    const uint32_t u1 = add_triangle();
    set(t, {c, a, p}, {ca, Side{3 * u1 + 2, ab.fixed}, Side{3 * t1 + 1}});
    set(t1, {b, c, p}, {bc, Side{3 * t + 2}, Side{3 * u + 1, ab.fixed}});
    set(u, {d, b, p}, {db, Side{3 * t1 + 2, ab.fixed}, Side{3 * u1 + 1}});
    set(u1, {a, d, p}, {ad, Side{3 * u + 2}, Side{3 * t + 1, ab.fixed}});
    doubtful_.insert(doubtful_.end(), {3 * t, 3 * t1, 3 * u, 3 * u1});
  }
  improve();
  return p;
}

bool Triangulation::convex(uint32_t edge) const {
  const uint32_t a = from(edge), b = to(edge), c = apex(edge), d = apex(sides_[edge].twin);
  return turn(a, d, c) > 0 && turn(d, b, c) > 0;
}

/// The other diagonal of the two triangles beside an edge takes its place.
void Triangulation::flip(uint32_t edge) {
  const uint32_t twin = sides_[edge].twin;
  const uint32_t a = from(edge), b = to(edge), c = apex(edge), d = apex(twin), t = edge / 3, u = twin / 3;
  const Side bc = sides_[next(edge)], ca = sides_[before(edge)], ad = sides_[next(twin)], db = sides_[before(twin)];
  set(t, {c, a, d}, {ca, ad, Side{3 * u + 2}});
  set(u, {d, b, c}, {db, bc, Side{3 * t + 2}});
}

bool Triangulation::improves(uint32_t edge) const {
  const Side& side = sides_[edge];
  if (side.twin == kNothing || side.fixed) return false;
  return in_circle(places_[from(edge)], places_[to(edge)], places_[apex(edge)], places_[apex(side.twin)]) &&
         convex(edge);
}

void Triangulation::improve() {
  // No more flips than could ever be needed, should rounding in the plane contradict what is exact.
  size_t flips = 64 + 4 * corners_.size();
  while (!doubtful_.empty() && flips > 0) {
    const uint32_t edge = doubtful_.back();
    doubtful_.pop_back();
    if (!improves(edge)) continue;
    const uint32_t t = edge / 3, u = sides_[edge].twin / 3;
    flip(edge);
    --flips;
    doubtful_.insert(doubtful_.end(), {3 * t, 3 * t + 1, 3 * u, 3 * u + 1});
  }
  doubtful_.clear();
}

/// Calls visit(edge) for the edges that begin in a point until it returns true.
template <class Visit>
void Triangulation::around(uint32_t point, const Visit& visit) const {
  const uint32_t first = leaving_[point];
  uint32_t edge = first;
  do {
    if (visit(edge)) return;
    edge = sides_[before(edge)].twin;
  } while (edge != kNothing && edge != first);
  if (edge == first) return;
  for (uint32_t in = sides_[first].twin; in != kNothing; in = sides_[edge].twin) {
    edge = next(in);
    if (visit(edge)) return;
  }
}

uint32_t Triangulation::edge_between(uint32_t a, uint32_t b) const {
  uint32_t found = kNothing;
  around(a, [&](uint32_t edge) {
    if (to(edge) == b) found = edge;
    if (apex(edge) == b) found = before(edge);
    return found != kNothing;
  });
  return found;
}

/// The edges that the line from a to b crosses, in order, of which there is one at least. Nothing where it runs into a
/// point or crosses a line.
std::optional<std::vector<uint32_t>> Triangulation::crossed(uint32_t a, uint32_t b) const {
  uint32_t edge = kNothing;
  around(a, [&](uint32_t leaving) {
    if (turn(a, to(leaving), b) > 0 && turn(a, b, apex(leaving)) > 0) edge = next(leaving);
    return edge != kNothing;
  });
  std::vector<uint32_t> edges;
  while (edge != kNothing && sides_[edge].twin != kNothing && !sides_[edge].fixed) {
    edges.push_back(edge);
    const uint32_t twin = sides_[edge].twin, c = apex(twin);
    if (c == b) return edges;
    const int side = turn(a, b, c);
    if (side == 0) return std::nullopt;
    // The line leaves by the edge whose ends are on either side of it.
    edge = side > 0 ? next(twin) : before(twin);
  }
  return std::nullopt;
}

void Triangulation::fix(uint32_t edge) {
  sides_[edge].fixed = true;
  if (sides_[edge].twin != kNothing) sides_[sides_[edge].twin].fixed = true;
}

bool Triangulation::constrain(uint32_t a, uint32_t b) {
  if (a == b) return false;
  if (const uint32_t edge = edge_between(a, b); edge != kNothing) {
    fix(edge);
    return true;
  }
  const auto edges = crossed(a, b);
  if (!edges) return false;
  // By their ends: flips renumber edges.
  std::deque<std::pair<uint32_t, uint32_t>> queue;
  for (const uint32_t edge : *edges) queue.emplace_back(from(edge), to(edge));
  std::vector<std::pair<uint32_t, uint32_t>> made;
  while (!queue.empty()) {
    const auto [p, q] = queue.front();
    queue.pop_front();
    const uint32_t edge = edge_between(p, q);
    if (!convex(edge)) {
      queue.emplace_back(p, q);
      continue;
    }
    const uint32_t c = apex(edge), d = apex(sides_[edge].twin);
    flip(edge);
    const bool ends = c == a || c == b || d == a || d == b;
    if (!ends && turn(a, b, c) * turn(a, b, d) < 0) {
      queue.emplace_back(c, d);
    } else {
      made.emplace_back(c, d);
    }
  }
  fix(edge_between(a, b));
  for (const auto& [p, q] : made) doubtful_.push_back(edge_between(p, q));
  improve();
  return true;
}

}  // namespace meander
