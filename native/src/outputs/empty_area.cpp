// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/empty_area.h"

#include <algorithm>
#include <cmath>

#include "base/front_search.h"

namespace meander {
namespace {

/// A part of a face in the plane of that: what of the triangle lies in a box, so that long faces are cut across.
class Cell {
 public:
  Cell() = default;
  Cell(const Surface& surface, uint32_t face) {
    for (uint32_t k = 0; k < 3; ++k) add(surface.corner(face, k));
  }
  bool empty() const { return count_ < 3; }
  /// Inside of it.
  Vec2 middle() const {
    Vec2 sum{0, 0};
    for (size_t k = 0; k < count_; ++k) sum = sum + corners_[k];
    return (1.0 / static_cast<double>(count_)) * sum;
  }
  double area() const {
    double twice = 0;
    for (size_t k = 2; k < count_; ++k) twice += cross(corners_[k - 1] - corners_[0], corners_[k] - corners_[0]);
    return 0.5 * std::abs(twice);
  }
  /// How far it reaches from its middle.
  double reach() const {
    const Vec2 from = middle();
    double farthest = 0;
    for (size_t k = 0; k < count_; ++k) farthest = std::max(farthest, norm(corners_[k] - from));
    return farthest;
  }
  /// Both halves of its bounding box, across the longer side.
  std::array<Cell, 2> halves() const {
    Vec2 low = corners_[0], high = corners_[0];
    for (size_t k = 1; k < count_; ++k) {
      low = {std::min(low.x, corners_[k].x), std::min(low.y, corners_[k].y)};
      high = {std::max(high.x, corners_[k].x), std::max(high.y, corners_[k].y)};
    }
    const Vec2 middle = 0.5 * (low + high);
    const bool wide = high.x - low.x > high.y - low.y;
    const auto beyond = [&](Vec2 p) { return wide ? p.x - middle.x : p.y - middle.y; };
    std::array<Cell, 2> halves;
    for (size_t k = 0; k < count_; ++k) {
      const Vec2 p = corners_[k], next = corners_[(k + 1) % count_];
      const double at = beyond(p), there = beyond(next);
      if (at <= 0) halves[0].add(p);
      if (at >= 0) halves[1].add(p);
      if (!((at < 0 && there > 0) || (at > 0 && there < 0))) continue;
      const Vec2 between = p + (at / (at - there)) * (next - p);
      for (Cell& half : halves) half.add(between);
    }
    return halves;
  }

 private:
  void add(Vec2 corner) { corners_[count_++] = corner; }

  std::array<Vec2, 8> corners_;  // of a triangle in a box 7 at most, and one more where cuts meet corners
  size_t count_ = 0;
};

/// Calls visit(cell, reach) for a cell and then, where that is true, for its halves.
template <class Visit>
void visit_cells(const Cell& cell, const Visit& visit) {
  if (!visit(cell, cell.reach())) return;
  for (const Cell& half : cell.halves()) {
    if (!half.empty()) visit_cells(half, visit);
  }
}

/// The faces that are connected to a place within `look` of it, one after the other, until visit(face) is false.
template <class Visit>
void visit_faces(const Surface& surface, const SurfacePoint& p, double look, const Visit& visit) {
  const Vec3 x = position(surface, p);
  FrontSearch<ReachedNodes> search;
  search.offer(p.face, 0);
  while (const auto face = search.next()) {
    if (!visit(*face)) return;
    const Triangle& corners = surface.face(*face);
    for (uint32_t k = 0; k < 3; ++k) {
      const HalfEdge twin = surface.twin(3 * *face + k);
      if (twin == kNone || search.done(face_of(twin))) continue;
      const double d = distance_to_segment(x, surface.position(corners[k]), surface.position(corners[next_corner(k)]));
      if (d < look) search.offer(face_of(twin), std::max(search.cost(*face), d));
    }
  }
}

/// The edges of a face that are of the boundary.
template <class Visit>
void visit_boundary(const Surface& surface, uint32_t face, const Visit& visit) {
  const Triangle& corners = surface.face(face);
  for (uint32_t k = 0; k < 3; ++k) {
    if (surface.twin(3 * face + k) != kNone) continue;
    visit(surface.position(corners[k]), surface.position(corners[next_corner(k)]));
  }
}

/// The distance between two of the points that are about as far apart as any are.
double extent_of(const std::vector<Vec3>& points, const Vec3& from) {
  const auto farthest = [&](const Vec3& x) {
    return *std::ranges::max_element(points, {}, [&](const Vec3& y) { return (y - x).squaredNorm(); });
  };
  const Vec3 end = farthest(from);
  return (farthest(end) - end).norm();
}

}  // namespace

double EmptyStrip::wanted_at(const Vec3& place, double r) const {
  if (distance <= 0.5 || boundary.empty()) return 0;
  const double to_boundary = std::sqrt(boundary.tree().nearest(place)->squared_distance);
  return std::max(0.0, (2 * distance - 1) * r - to_boundary);
}

EmptyArea& EmptyArea::operator+=(const EmptyArea& other) {
  wide += other.wide;
  narrow += other.narrow;
  return *this;
}

bool is_slender(const Emptiness& emptiness, const SurfacePoint& p, CancelToken& poll) {
  const Surface& surface = emptiness.surface();
  const Vec3 x = position(surface, p);
  const double r = emptiness.local_radius(p), spacing = 2 * r, look = kLook * r;
  const double enough = spacing * 2 * look;
  double area = 0;
  std::vector<Vec3> places;
  visit_faces(surface, p, look, [&](uint32_t face) {
    visit_cells(Cell(surface, face), [&](const Cell& cell, double reach) {
      poll();
      const Vec3 middle = position(surface, point_at(surface, face, cell.middle()));
      const double distance = (middle - x).norm();
      if (area >= enough || distance - reach > look) return false;
      if (reach > kLookFinest * r) return true;
      if (distance > look) return false;
      area += cell.area();
      places.push_back(middle);
      return false;
    });
    return area < enough;
  });
  return area < enough && (places.empty() || area < spacing * extent_of(places, x));
}

bool is_in_corner(const Emptiness& emptiness, const SurfacePoint& p, CancelToken& poll) {
  const Surface& surface = emptiness.surface();
  const Vec3 x = position(surface, p);
  const double r = emptiness.local_radius(p), look = kRightAngle * r;
  bool beside = false;
  visit_faces(surface, p, r, [&](uint32_t face) {
    poll();
    visit_boundary(surface, face, [&](const Vec3& a, const Vec3& b) { beside |= distance_to_segment(x, a, b) < r; });
    return !beside;
  });
  if (!beside) return false;
  std::vector<uint32_t> faces;
  std::vector<std::array<Vec3, 2>> boundary;
  visit_faces(surface, p, look + r, [&](uint32_t face) {
    poll();
    faces.push_back(face);
    visit_boundary(surface, face, [&](const Vec3& a, const Vec3& b) { boundary.push_back({a, b}); });
    return true;
  });
  bool reached = false;
  for (size_t k = 0; k < faces.size() && !reached; ++k) {
    visit_cells(Cell(surface, faces[k]), [&](const Cell& cell, double reach) {
      if (reached) return false;
      poll(1 + boundary.size());
      const Vec3 middle = position(surface, point_at(surface, faces[k], cell.middle()));
      if ((middle - x).norm() - reach > look) return false;
      double inside = r;
      for (const auto& [a, b] : boundary) inside = std::min(inside, distance_to_segment(middle, a, b));
      if (inside + reach < r) return false;
      reached = reach <= kCornerFinest * r;
      return !reached;
    });
  }
  return !reached;
}

bool is_narrow(const Emptiness& emptiness, const SurfacePoint& p, CancelToken& poll) {
  return is_slender(emptiness, p, poll) || is_in_corner(emptiness, p, poll);
}

bool EmptyFaces::slender_at(const SurfacePoint& place, double r) {
  const Surface& surface = emptiness_.surface();
  const Vec3 x = position(surface, place);
  const uint32_t component = surface.component(place.face);
  for (const Known& known : known_) {
    if (known.component == component && (x - known.place).norm() < kAsNarrow * r) return known.slender;
  }
  const bool slender = is_slender(emptiness_, place, poll_);
  known_[next_++ % known_.size()] = {component, x, slender};
  return slender;
}

void EmptyFaces::add(uint32_t face, double nearer_than) {
  const Surface& surface = emptiness_.surface();
  const double least_r = emptiness_.least_radius(face);
  const Cell whole(surface, face);
  visit_cells(whole, [&](const Cell& cell, double reach) {
    poll_();
    const SurfacePoint middle = point_at(surface, face, cell.middle());
    const double r = emptiness_.local_radius(middle), filled = (kEmptySize * least_r - reach) / r;
    if (&cell == &whole && nearer_than > 0 && nearer_than <= filled) return false;
    if (filled > 0 && emptiness_.closer_than(middle, filled)) return false;
    if (reach > r) return true;
    // How far a line is to be from there, to leave it empty.
    const double wanted = strip_.wanted_at(position(surface, middle), r) + kEmptySize * r;
    const double unsure = reach <= kFinestCell * r ? 0 : reach;
    const Emptiness::Size size = emptiness_.compare(middle, wanted - unsure, wanted + unsure);
    if (size == Emptiness::Size::kAbove) {
      const bool narrow = slender_at(middle, r) || is_in_corner(emptiness_, middle, poll_);
      (narrow ? area_.narrow : area_.wide) += cell.area();
    }
    return size == Emptiness::Size::kBetween;
  });
}

}  // namespace meander
