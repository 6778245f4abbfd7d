// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/polygon_triangles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "base/eigen.h"
#include "base/elementary.h"
#include "base/plane.h"
#include "mesh/constants.h"
#include "mesh/delaunay_flips.h"
#include "mesh/repairs.h"

namespace meander {
namespace {

using Vec3 = Eigen::Vector3d;

/// Which way a corner of a polygon turns; counter-clockwise polygons are convex where they turn left.
enum Turn : int { kConcave = -1, kStraight = 0, kConvex = 1 };

Turn turn_of(Vec2 a, Vec2 b, Vec2 c) {
  const double area = cross(b - a, c - a);
  return area > 0 ? kConvex : (area < 0 ? kConcave : kStraight);
}

/// Corners of a polygon, a bit for each.
class CornerSet {
 public:
  void clear(uint32_t count) { words_.assign(count / kWord + 1, 0); }
  void add(uint32_t c) { words_[c / kWord] |= bit(c); }
  void remove(uint32_t c) { words_[c / kWord] &= ~bit(c); }

  /// The first of them from a corner on, of which there is one.
  uint32_t nearest(uint32_t c, bool backwards) const {
    const auto words = static_cast<uint32_t>(words_.size());
    uint32_t word = c / kWord;
    uint64_t left = words_[word] & (backwards ? bit(c) | (bit(c) - 1) : ~(bit(c) - 1));
    while (left == 0) {
      word = backwards ? (word == 0 ? words - 1 : word - 1) : (word + 1 == words ? 0 : word + 1);
      left = words_[word];
    }
    return word * kWord + static_cast<uint32_t>(backwards ? std::bit_width(left) - 1 : std::countr_zero(left));
  }

 private:
  static constexpr uint32_t kWord = 64;
  static uint64_t bit(uint32_t c) { return uint64_t{1} << (c % kWord); }

  std::vector<uint64_t> words_;
};

/// Some corners of a polygon in square cells, about one in each, so that an ear is compared with those near it only.
class CornerCells {
 public:
  /// Sorts the `count` corners of which is_one(corner) is true.
  template <class IsOne>
  void sort(const std::vector<Vec2>& points, size_t count, const IsOne& is_one) {
    Vec2 high{};
    low_ = high = points[0];
    for (const Vec2 p : points) {
      low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const double width = high.x - low_.x, height = high.y - low_.y, longest = std::max(width, height);
    const auto many = static_cast<double>(std::max<size_t>(1, count));
    // As many cells as corners, whatever the shape of the box.
    size_ = std::max(std::sqrt(width * height / many), longest / many);
    if (!(size_ > 0)) size_ = 1;
    columns_ = static_cast<size_t>(width / size_) + 1;
    rows_ = static_cast<size_t>(height / size_) + 1;
    end_.assign(columns_ * rows_ + 1, 0);
    for (uint32_t c = 0; c < points.size(); ++c) {
      if (is_one(c)) ++end_[cell_of(points[c]) + 1];
    }
    for (size_t k = 1; k < end_.size(); ++k) end_[k] += end_[k - 1];
    corners_.resize(count);
    for (uint32_t c = 0; c < points.size(); ++c) {
      if (is_one(c)) corners_[end_[cell_of(points[c])]++] = c;
    }
    // Each has moved to its end; what is the end of a cell is now the beginning of the next.
  }

  /// Whether it is true of any of them near a triangle.
  template <class Predicate>
  bool any_in_box(Vec2 a, Vec2 b, Vec2 c, const Predicate& predicate) const {
    const size_t left = column(std::min({a.x, b.x, c.x})), right = column(std::max({a.x, b.x, c.x}));
    const size_t top = row(std::max({a.y, b.y, c.y}));
    for (size_t r = row(std::min({a.y, b.y, c.y})); r <= top; ++r) {
      const size_t first = r * columns_ + left;
      const uint32_t begin = first == 0 ? 0 : end_[first - 1];
      for (uint32_t k = begin; k < end_[r * columns_ + right]; ++k) {
        if (predicate(corners_[k])) return true;
      }
    }
    return false;
  }

 private:
  size_t column(double x) const {
    return std::min(columns_ - 1, static_cast<size_t>(std::max(0.0, (x - low_.x) / size_)));
  }
  size_t row(double y) const { return std::min(rows_ - 1, static_cast<size_t>(std::max(0.0, (y - low_.y) / size_))); }
  size_t cell_of(Vec2 p) const { return row(p.y) * columns_ + column(p.x); }

  Vec2 low_;
  double size_ = 1;
  size_t columns_ = 1, rows_ = 1;
  std::vector<uint32_t> end_, corners_;
};

/// Cuts ears off one polygon in the plane after another, and keeps its memory.
class EarCutter {
 public:
  /// Calls triangle(i, j, k) with places in `points`, which go around counter-clockwise.
  template <class Triangle>
  void cut(const std::vector<Vec2>& points, const Triangle& triangle) {
    start(points);
    uint32_t begin = 0;
    bool backwards = false;
    for (size_t left = points.size(); left > 3; --left) {
      const uint32_t ear = find_ear(begin, backwards, left);
      const uint32_t before = corners_[ear].before, after = corners_[ear].after;
      triangle(before, ear, after);
      corners_[before].after = after;
      corners_[after].before = before;
      forget(ear);
      for (const uint32_t c : {before, after}) {
        if (corners_[c].turn == kConvex) continue;
        measure(c);
        if (corners_[c].turn == kConvex) --hindrances_;
      }
      first_ = after;
      begin = backwards ? corners_[before].before : corners_[after].after;
      if (corners_[begin].turn == kConvex) continue;
      begin = backwards ? corners_[begin].before : corners_[begin].after;
      backwards = !backwards;
    }
    const uint32_t a = corners_[first_].before;
    triangle(a, first_, corners_[first_].after);
  }

 private:
  struct PolygonCorner {
    uint32_t before = 0, after = 0;
    Turn turn = kConvex;
    bool there = true;
  };

  void start(const std::vector<Vec2>& points) {
    points_ = &points;
    const auto count = static_cast<uint32_t>(points.size());
    corners_.assign(count, {});
    convex_.clear(count);
    for (uint32_t c = 0; c < count; ++c) {
      corners_[c].before = c == 0 ? count - 1 : c - 1;
      corners_[c].after = c + 1 == count ? 0 : c + 1;
    }
    first_ = 0;
    hindrances_ = 0;
    for (uint32_t c = 0; c < count; ++c) {
      measure(c);
      hindrances_ += corners_[c].turn != kConvex;
    }
    cells_.sort(points, hindrances_, [&](uint32_t c) { return corners_[c].turn != kConvex; });
  }

  void measure(uint32_t c) {
    PolygonCorner& corner = corners_[c];
    corner.turn = turn_of((*points_)[corner.before], (*points_)[c], (*points_)[corner.after]);
    if (corner.turn == kConvex) convex_.add(c);
  }
  void forget(uint32_t c) {
    corners_[c].there = false;
    convex_.remove(c);
    if (corners_[c].turn != kConvex) --hindrances_;
  }

  uint32_t find_ear(uint32_t begin, bool backwards, size_t left) const {
    const auto onwards = [&](uint32_t c) { return backwards ? corners_[c].before : corners_[c].after; };
    uint32_t c = begin;
    for (size_t i = hindrances_; i < left; ++i, c = onwards(c)) {
      c = convex_.nearest(c, backwards);
      if (is_ear(c)) return c;
    }
    c = begin;
    for (size_t i = 0; i < left; ++i, c = onwards(c)) {
      if (corners_[c].turn == kStraight && is_ear(c)) return c;
    }
    // No ear: the polygon crosses itself, or rounding makes it look so.
    c = begin;
    for (size_t i = 0; i < left && corners_[c].turn == kConcave; ++i) c = corners_[c].after;
    return c;
  }

  bool is_ear(uint32_t c) const {
    if (hindrances_ == 0) return true;
    const PolygonCorner& tip = corners_[c];
    const Vec2 a = (*points_)[tip.before], b = (*points_)[c], d = (*points_)[tip.after];
    const auto inside = [&](uint32_t other) {
      if (!corners_[other].there || corners_[other].turn == kConvex) return false;
      if (other == tip.before || other == c || other == tip.after) return false;
      const Vec2 p = (*points_)[other];
      return turn_of(d, a, p) != kConcave && turn_of(a, b, p) != kConcave && turn_of(b, d, p) != kConcave;
    };
    return !cells_.any_in_box(a, b, d, inside);
  }

  const std::vector<Vec2>* points_ = nullptr;
  std::vector<PolygonCorner> corners_;
  CornerSet convex_;  // and left
  uint32_t first_ = 0;      // a corner that is left
  size_t hindrances_ = 0;   // corners that are left and not convex
  CornerCells cells_;       // of the corners that were not convex at first
};

class PolygonDivision {
 public:
  PolygonDivision(std::span<const double> vertices, PolygonTriangles& triangles)
      : vertices_(vertices), triangles_(triangles) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (uint32_t v = 0; v < vertices.size() / 3; ++v) {
      if (!is_there(v)) continue;
      low = low.cwiseMin(at(v));
      high = high.cwiseMax(at(v));
    }
    diagonal_ = (high - low).norm();
  }

  void divide(uint32_t polygon, std::span<const uint32_t> corners) {
    polygon_ = polygon;
    ring_.assign(corners.begin(), corners.end());
    if (corners.size() > 3) {
      if (!std::ranges::all_of(corners, [&](uint32_t v) { return is_there(v); })) return add_fan();
      drop_spikes();
      if (ring_.size() > 3 && !measure()) return add_fan();
    }
    if (ring_.size() == 3) add(ring_[0], ring_[1], ring_[2]);
    if (ring_.size() == 4) add_quadrangle();
    if (ring_.size() > 4) add_ears();
  }

 private:
  bool is_there(uint32_t v) const {
    return v < vertices_.size() / 3 && std::isfinite(vertices_[3 * size_t{v}]) &&
           std::isfinite(vertices_[3 * size_t{v} + 1]) && std::isfinite(vertices_[3 * size_t{v} + 2]);
  }
  Vec3 at(uint32_t v) const { return Vec3::Map(vertices_.data() + 3 * size_t{v}); }
  /// Seen from the first corner, in units of the polygon's size: products of them neither vanish nor become infinite.
  Vec3 place(uint32_t v) const { return (at(v) - at(ring_[0])) / size_; }
  /// False: the polygon has no size, or none that is a number.
  bool measure() {
    size_ = 0;
    for (const uint32_t v : ring_) size_ = std::max(size_, (at(v) - at(ring_[0])).cwiseAbs().maxCoeff());
    return size_ > 0 && std::isfinite(size_);
  }
  void add_fan() {
    for (size_t k = 2; k < ring_.size(); ++k) add(ring_[0], ring_[k - 1], ring_[k]);
  }
  void add(uint32_t a, uint32_t b, uint32_t c) {
    triangles_.corners.insert(triangles_.corners.end(), {a, b, c});
    triangles_.polygons.push_back(polygon_);
  }

  /// Takes out corners that repeat the one before, and those between two that are one.
  void drop_spikes() {
    size_t kept = 0;
    for (const uint32_t v : ring_) {
      ring_[kept++] = v;
      while (kept >= 2 && (ring_[kept - 1] == ring_[kept - 2] || (kept >= 3 && ring_[kept - 1] == ring_[kept - 3]))) {
        kept -= ring_[kept - 1] == ring_[kept - 2] ? 1 : 2;
      }
    }
    size_t first = 0;
    while (kept - first >= 2) {  // across the end
      if (ring_[first] == ring_[kept - 1]) {
        --kept;
      } else if (kept - first >= 3 && ring_[first] == ring_[kept - 2]) {
        kept -= 2;
      } else if (kept - first >= 3 && ring_[first + 1] == ring_[kept - 1]) {
        ++first;
      } else {
        break;
      }
    }
    ring_.resize(kept);
    ring_.erase(ring_.begin(), ring_.begin() + static_cast<std::ptrdiff_t>(first));
  }

  void add_quadrangle() {
    const Vec3 diagonal = place(ring_[2]);
    const Vec3 one = place(ring_[1]).cross(diagonal), other = place(ring_[3]).cross(diagonal);
    if (one.dot(other) > 0) {  // both on one side of the diagonal
      add(ring_[0], ring_[1], ring_[3]);
      add(ring_[1], ring_[2], ring_[3]);
    } else {
      add(ring_[0], ring_[1], ring_[2]);
      add(ring_[0], ring_[2], ring_[3]);
    }
  }

  void add_ears() {
    // Along the axis to which the normal is nearest, as Blender looks at it, with the normal towards the eye.
    Vec3 normal = Vec3::Zero();
    for (size_t k = 0; k < ring_.size(); ++k) {
      normal += place(ring_[k]).cross(place(ring_[k + 1 == ring_.size() ? 0 : k + 1]));
    }
    const double length = normal.norm();
    normal = length > 0 ? Vec3(normal / length) : Vec3(0, 0, 1);
    const double flat = elementary::hypot(normal.x(), normal.y());
    const Vec3 right = flat > 0 ? Vec3(normal.y() / flat, -normal.x() / flat, 0) : Vec3(1, 0, 0);
    const Vec3 up = normal.cross(right);
    points_.clear();
    for (const uint32_t v : ring_) {
      const Vec3 p = place(v);
      points_.push_back({p.dot(right), p.dot(up)});
    }
    ears_.clear();
    cutter_.cut(points_, [&](uint32_t a, uint32_t b, uint32_t c) { ears_.push_back({a, b, c}); });
    const double least = kFlatForRepair * diagonal_ / size_;
    if (std::ranges::any_of(ears_, [&](const auto& ear) { return is_sliver(ear, least); })) {
      flip_to_delaunay(points_, least, ears_);
    }
    for (const auto& [a, b, c] : ears_) {
      if (ring_[a] == ring_[b] || ring_[b] == ring_[c] || ring_[c] == ring_[a]) continue;  // along a bridge
      add(ring_[a], ring_[b], ring_[c]);
    }
  }
  /// Would it count as a face without area?
  bool is_sliver(const std::array<uint32_t, 3>& ear, double least) const {
    const Vec2 a = points_[ear[0]], b = points_[ear[1]], c = points_[ear[2]];
    const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
    return !(cross(b - a, c - a) > least * longest);
  }

  std::span<const double> vertices_;
  PolygonTriangles& triangles_;
  uint32_t polygon_ = 0;
  double size_ = 1, diagonal_ = 0;  // of the polygon, of all vertices
  std::vector<uint32_t> ring_;
  std::vector<Vec2> points_;
  std::vector<std::array<uint32_t, 3>> ears_;
  EarCutter cutter_;
};

}  // namespace

PolygonTriangles triangulate_polygons(std::span<const double> vertices, std::span<const uint32_t> corners,
                                      std::span<const uint64_t> ends) {
  PolygonTriangles triangles;
  triangles.corners.reserve(3 * (corners.size() > 2 * ends.size() ? corners.size() - 2 * ends.size() : 0));
  PolygonDivision division(vertices, triangles);
  for (uint32_t p = 0; p < ends.size(); ++p) {
    const size_t begin = p == 0 ? 0 : ends[p - 1];
    division.divide(p, corners.subspan(begin, ends[p] - begin));
  }
  return triangles;
}

}  // namespace meander
