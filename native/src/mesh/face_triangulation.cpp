// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/face_triangulation.h"

#include <algorithm>
#include <cmath>

#include "mesh/in_circle.h"

namespace meander {
namespace {

/// The distance of p from the line from a to b.
double distance(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double length = dot(along, along);
  const double share = length > 0 ? std::clamp(dot(p - a, along) / length, 0.0, 1.0) : 0;
  return norm(a + share * along - p);
}

}  // namespace

FaceTriangulation::FaceTriangulation(const Surface& surface, RefinedSurface& mesh)
    : surface_(surface), mesh_(mesh), parts_(surface.face_count(), 0) {
  for (uint32_t f = 0; f < mesh.face_count(); ++f) ++parts_[mesh.origin(f)];
}

bool FaceTriangulation::holds(uint32_t f, Vec2 p) const {
  for (const HalfEdge h : mesh_.corners(f)) {
    if (orientation(start(h), end(h), p) < 0) return false;
  }
  return true;
}

/// A walk towards the point; it ends in Delaunay triangulations, which this one is but for rounding and lines.
uint32_t FaceTriangulation::locate(uint32_t origin, Vec2 p) {
  // The first part of a face keeps its number.
  uint32_t f = mesh_.origin(last_) == origin ? last_ : origin;
  for (size_t steps = 0; steps < 2 * size_t{parts_[origin]} + 8; ++steps) {
    const std::array<HalfEdge, 3> corners = mesh_.corners(f);
    HalfEdge exit = kNone;
    for (size_t k = 0; k < 3 && exit == kNone; ++k) {
      const HalfEdge h = corners[(k + steps) % 3];
      if (orientation(start(h), end(h), p) < 0) exit = h;
    }
    if (exit == kNone) return last_ = f;
    const uint32_t beyond = mesh_.face(RefinedSurface::opposite(exit));
    if (beyond == kNone || mesh_.origin(beyond) != origin) break;
    f = beyond;
  }
  for (f = 0; f < mesh_.face_count(); ++f) {
    if (mesh_.origin(f) == origin && holds(f, p)) return last_ = f;
  }
  return kNone;
}

void FaceTriangulation::split_side(HalfEdge h, uint32_t v, Vec2 at, Vec2 beyond) {
  size_t parts = 0;
  for (const HalfEdge side : {h, RefinedSurface::opposite(h)}) {
    if (const uint32_t f = mesh_.face(side); f != kNone) parts += ++parts_[mesh_.origin(f)];
  }
  mesh_.split_edge(h, v, at, beyond);
  look_around(v);
  improve(parts);
}

bool FaceTriangulation::insert(uint32_t origin, uint32_t v, Vec2 at) {
  const uint32_t f = locate(origin, at);
  if (f == kNone) return false;
  HalfEdge on = kNone;
  for (const HalfEdge h : mesh_.corners(f)) {
    if (start(h).x == at.x && start(h).y == at.y) return false;
    if (orientation(start(h), end(h), at) == 0) on = h;
  }
  if (on != kNone && !mesh_.inside(on)) return false;
  if (on == kNone) {
    mesh_.split_face(f, v, at);
  } else {
    mesh_.split_edge(on, v, at, at);
  }
  parts_[origin] += 2;
  look_around(v);
  improve(parts_[origin]);
  return true;
}

bool FaceTriangulation::is_clear(uint32_t origin, Vec2 at, double clearance) {
  const uint32_t f = locate(origin, at);
  if (f == kNone) return false;
  const Plane plane = this->plane(origin);
  const Vec2 p = plane.place(at);
  for (const HalfEdge h : mesh_.corners(f)) {
    if (orientation(start(h), end(h), at) == 0) return false;
    if (norm(plane.place(start(h)) - p) < clearance) return false;
    if (mesh_.inside(h)) {
      if (norm(plane.place(apex(RefinedSurface::opposite(h))) - p) < clearance) return false;
    } else if (distance(p, plane.place(start(h)), plane.place(end(h))) < clearance) {
      return false;
    }
  }
  return true;
}

bool FaceTriangulation::convex(HalfEdge h) const {
  const Vec2 a = start(h), b = end(h), c = apex(h), d = apex(RefinedSurface::opposite(h));
  return orientation(a, d, c) > 0 && orientation(d, b, c) > 0;
}

/// Is the other diagonal of the two triangles beside an edge the better one?
bool FaceTriangulation::improves(HalfEdge h) const {
  if (!mesh_.inside(h)) return false;
  const Plane plane = this->plane(mesh_.origin(mesh_.face(h)));
  const Vec2 a = plane.place(start(h)), b = plane.place(end(h)), c = plane.place(apex(h)),
             d = plane.place(apex(RefinedSurface::opposite(h)));
  if (const int side = in_circle(a, b, c, d); side != 0) return side > 0 && convex(h);
  // Rounding may know it of the other diagonal. Asked for either one, the answer is the same.
  if (const int side = in_circle(d, c, a, b); side != 0) return side < 0 && convex(h);
  return ends_last(h) && convex(h);
}

/// Does the last of the four points lie on this diagonal?
bool FaceTriangulation::ends_last(HalfEdge h) const {
  const auto later = [&](HalfEdge one, HalfEdge other) { return std::max(order(one), order(other)); };
  return later(h, mesh_.next(h)) > later(mesh_.prev(h), mesh_.prev(RefinedSurface::opposite(h)));
}

/// Where a corner comes among the points of its face of the surface.
std::pair<int, double> FaceTriangulation::order(HalfEdge corner) const {
  const Vec2 at = mesh_.at(corner);
  const double weights[] = {at.y, 1 - at.x - at.y, at.x}, along[] = {at.x, at.y, 1 - at.y};
  if (mesh_.from(corner) < surface_.vertex_count()) return {0, mesh_.from(corner)};
  for (uint32_t k = 0; k < 3; ++k) {
    if (weights[k] != 0) continue;
    // Seen alike from both faces of the side.
    const HalfEdge side = 3 * mesh_.origin(mesh_.face(corner)) + k;
    return {1 + k, surface_.twin(side) < side ? -along[k] : along[k]};
  }
  return {4, mesh_.from(corner)};
}

void FaceTriangulation::look_around(uint32_t v) {
  mesh_.each_leaving(v, [&](HalfEdge h) { doubtful_.push_back(mesh_.next(h)); });
}

void FaceTriangulation::improve(size_t parts) {
  // No more flips than could ever be needed, should rounding in the plane contradict what is exact.
  size_t flips = 64 + 4 * parts;
  while (!doubtful_.empty() && flips > 0) {
    const HalfEdge h = doubtful_.back(), o = RefinedSurface::opposite(h);
    doubtful_.pop_back();
    if (!improves(h)) continue;
    mesh_.flip(h);
    --flips;
    doubtful_.insert(doubtful_.end(), {mesh_.next(h), mesh_.prev(h), mesh_.next(o), mesh_.prev(o)});
  }
  doubtful_.clear();
}

bool FaceTriangulation::constrain(uint32_t origin, uint32_t a, uint32_t b, Vec2 at_b) {
  if (a == b) return false;
  Vec2 at_a;
  HalfEdge h = kNone;  // the first edge that the line crosses
  bool is_edge = false;
  mesh_.each_leaving(a, [&](HalfEdge leaving) {
    if (mesh_.origin(mesh_.face(leaving)) != origin) return;
    at_a = start(leaving);
    if (orientation(at_a, end(leaving), at_b) > 0 && orientation(at_a, at_b, apex(leaving)) > 0) {
      h = mesh_.next(leaving);
    }
    for (const HalfEdge side : {leaving, mesh_.prev(leaving)}) {
      if (mesh_.from(side) != b && mesh_.to(side) != b) continue;
      mesh_.fix(side);
      is_edge = true;
    }
  });
  if (is_edge) return true;
  crossed_.clear();
  for (bool arrives = false; !arrives;) {
    if (h == kNone || !mesh_.inside(h)) return false;
    crossed_.push_back(h);
    const HalfEdge beyond = RefinedSurface::opposite(h);
    arrives = mesh_.from(mesh_.prev(beyond)) == b;
    const int side = orientation(at_a, at_b, apex(beyond));
    if (side == 0 && !arrives) return false;
    // The line leaves by the edge whose ends are on either side of it.
    h = side > 0 ? mesh_.next(beyond) : mesh_.prev(beyond);
  }
  const auto is_end = [&](uint32_t v) { return v == a || v == b; };
  while (!crossed_.empty()) {
    h = crossed_.front();
    crossed_.pop_front();
    if (!convex(h)) {
      crossed_.push_back(h);
      continue;
    }
    mesh_.flip(h);
    const int ends = is_end(mesh_.from(h)) + is_end(mesh_.to(h));
    if (ends == 2) mesh_.fix(h);
    if (ends == 0 && orientation(at_a, at_b, start(h)) * orientation(at_a, at_b, end(h)) < 0) {
      crossed_.push_back(h);
    } else {
      doubtful_.push_back(h);
    }
  }
  improve(parts_[origin]);
  return true;
}

}  // namespace meander
