// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <unordered_map>

#include "base/point_tree.h"

namespace meander {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

uint64_t edge_key(uint32_t a, uint32_t b) { return (uint64_t{std::min(a, b)} << 32) | std::max(a, b); }

/// The surface cut up near its boundary, with the distance to it at every vertex.
class DistanceField {
 public:
  DistanceField(const Surface& surface, double reach, double edge) {
    positions_.reserve(surface.vertex_count());
    for (uint32_t v = 0; v < surface.vertex_count(); ++v) positions_.push_back(surface.position(v));
    for (uint32_t v = 0; v < surface.vertex_count(); ++v) caller_.push_back(surface.caller_position(v));
    for (uint32_t f = 0; f < surface.face_count(); ++f) faces_.push_back(surface.face(f));
    std::vector<Vec3> samples;
    for (const HalfEdge e : surface.boundary()) {
      const Triangle& t = surface.face(face_of(e));
      const uint32_t a = t[corner_of(e)], b = t[next_corner(corner_of(e))];
      boundary_.emplace(edge_key(a, b), 0);
      const Vec3 from = positions_[a], way = positions_[b] - from;
      const int pieces = static_cast<int>(std::min(1e5, 1 + std::ceil(way.norm() / edge)));
      for (int k = 0; k < pieces; ++k) samples.push_back(from + way * (double(k) / pieces));
    }
    const PointTree tree(std::move(samples));
    // Each pass halves the edges that are too long and near enough; a face with one, two or three of
    // them becomes as many more.
    constexpr int kMostPasses = 24;
    for (int pass = 0; pass < kMostPasses && halve(tree, reach, edge); ++pass) {
    }
    march(reach);
  }

  struct Point {
    uint64_t edge;
    uint32_t low, high;
    double t;
  };

  /// The closed lines of the level, as points in space and in the caller's.
  void lines(double level, std::vector<std::vector<Vec3>>& inside, std::vector<std::vector<Vec3>>& outside) const {
    // Every face that the level crosses joins two edges; with the inside on the left each edge has one
    // successor.
    std::unordered_map<uint64_t, uint64_t> next;
    std::vector<uint64_t> order;
    for (const Triangle& v : faces_) {
      uint64_t from = 0, to = 0;
      bool crossed = false;
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t a = v[k], b = v[(k + 1) % 3];
        const bool in_a = distance_[a] >= level, in_b = distance_[b] >= level;
        if (in_a == in_b) continue;
        crossed = true;
        (in_a ? from : to) = edge_key(a, b);
      }
      if (!crossed) continue;
      next.emplace(from, to);
      order.push_back(from);
    }
    std::unordered_map<uint64_t, uint8_t> visited;
    for (const uint64_t start : order) {
      if (visited.count(start)) continue;
      std::vector<Vec3> line, caller;
      uint64_t at = start;
      while (!visited.count(at)) {
        visited.emplace(at, 1);
        const uint32_t a = static_cast<uint32_t>(at >> 32), b = static_cast<uint32_t>(at);
        const double whole = distance_[b] - distance_[a];
        const double t = std::isfinite(whole) ? std::clamp((level - distance_[a]) / whole, 1e-3, 1 - 1e-3) : 0.5;
        line.push_back(positions_[a] + t * (positions_[b] - positions_[a]));
        caller.push_back(caller_[a] + t * (caller_[b] - caller_[a]));
        const auto found = next.find(at);
        if (found == next.end()) break;
        at = found->second;
      }
      inside.push_back(std::move(line));
      outside.push_back(std::move(caller));
    }
  }

 private:
  bool halve(const PointTree& boundary, double reach, double edge) {
    std::unordered_map<uint64_t, uint32_t> middle;
    const auto consider = [&](uint32_t a, uint32_t b) {
      const uint64_t key = edge_key(a, b);
      if (middle.count(key)) return;
      const Vec3 m = 0.5 * (positions_[a] + positions_[b]);
      const double length = (positions_[b] - positions_[a]).norm();
      if (length <= edge) return;
      const double near = reach + length;
      if (!boundary.any_within(m, near * near)) return;
      middle.emplace(key, static_cast<uint32_t>(positions_.size()));
      const auto on_boundary = boundary_.find(key);
      const uint32_t c = static_cast<uint32_t>(positions_.size());
      positions_.push_back(m);
      caller_.push_back(0.5 * (caller_[a] + caller_[b]));
      if (on_boundary != boundary_.end()) {
        boundary_.erase(on_boundary);
        boundary_.emplace(edge_key(a, c), 0);
        boundary_.emplace(edge_key(c, b), 0);
      }
    };
    const size_t before = positions_.size();
    for (const Triangle& v : faces_) {
      for (size_t k = 0; k < 3; ++k) consider(v[k], v[(k + 1) % 3]);
    }
    if (positions_.size() == before) return false;
    std::vector<Triangle> cut;
    for (const Triangle& v : faces_) {
      uint32_t m[3];
      size_t count = 0;
      for (size_t k = 0; k < 3; ++k) {
        const auto found = middle.find(edge_key(v[k], v[(k + 1) % 3]));
        m[k] = found == middle.end() ? kNone : found->second;
        count += m[k] != kNone;
      }
      if (count == 0) {
        cut.push_back(v);
      } else if (count == 3) {
        cut.push_back({v[0], m[0], m[2]});
        cut.push_back({m[0], v[1], m[1]});
        cut.push_back({m[2], m[1], v[2]});
        cut.push_back({m[0], m[1], m[2]});
      } else if (count == 1) {
        size_t k = 0;
        while (m[k] == kNone) ++k;
        const uint32_t a = v[k], b = v[(k + 1) % 3], c = v[(k + 2) % 3];
        cut.push_back({a, m[k], c});
        cut.push_back({m[k], b, c});
      } else {
        size_t k = 0;  // the edge that stays whole
        while (m[k] != kNone) ++k;
        const uint32_t a = v[k], b = v[(k + 1) % 3], c = v[(k + 2) % 3];
        const uint32_t bc = m[(k + 1) % 3], ca = m[(k + 2) % 3];
        cut.push_back({ca, bc, c});
        cut.push_back({a, b, bc});
        cut.push_back({a, bc, ca});
      }
    }
    faces_ = std::move(cut);
    return true;
  }

  void march(double reach) {
    distance_.assign(positions_.size(), kFar);
    using Entry = std::pair<double, uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const auto& [key, unused] : boundary_) {
      for (const uint32_t v : {static_cast<uint32_t>(key >> 32), static_cast<uint32_t>(key)}) {
        if (distance_[v] == 0) continue;
        distance_[v] = 0;
        queue.push({0, v});
      }
    }
    std::vector<uint32_t> first(positions_.size() + 1, 0);
    for (const Triangle& v : faces_) {
      for (const uint32_t i : v) ++first[i + 1];
    }
    for (size_t v = 0; v < positions_.size(); ++v) first[v + 1] += first[v];
    std::vector<uint32_t> around(first.back());
    std::vector<uint32_t> fill(first.begin(), first.end() - 1);
    for (uint32_t f = 0; f < faces_.size(); ++f) {
      for (const uint32_t i : faces_[f]) around[fill[i]++] = f;
    }
    std::vector<uint8_t> done(positions_.size(), 0);
    while (!queue.empty()) {
      const auto [d, v] = queue.top();
      queue.pop();
      if (done[v]) continue;
      done[v] = 1;
      if (d > 2 * reach) break;
      for (uint32_t k = first[v]; k < first[v + 1]; ++k) {
        const Triangle& t = faces_[around[k]];
        for (size_t c = 0; c < 3; ++c) {
          if (t[c] == v || done[t[c]]) continue;
          const uint32_t other = t[0] + t[1] + t[2] - v - t[c];
          const double reached = done[other] ? across(v, other, t[c]) : d + (positions_[t[c]] - positions_[v]).norm();
          if (reached < distance_[t[c]]) {
            distance_[t[c]] = reached;
            queue.push({reached, t[c]});
          }
        }
      }
    }
  }

  /// The distance at c of a straight front that reaches a and b when it does.
  double across(uint32_t a, uint32_t b, uint32_t c) const {
    const double by_edges = std::min(distance_[a] + (positions_[c] - positions_[a]).norm(),
                                     distance_[b] + (positions_[c] - positions_[b]).norm());
    const Vec3 u = positions_[b] - positions_[a], w = positions_[c] - positions_[a];
    const double length = u.norm(), slope = (distance_[b] - distance_[a]) / length;
    if (!(std::abs(slope) < 1)) return by_edges;
    // In coordinates along ab and across: the front's normal is (slope, rise).
    const double x = w.dot(u) / length, y = std::sqrt(std::max(0.0, w.squaredNorm() - x * x));
    const double rise = std::sqrt(1 - slope * slope);
    const double foot = x - y * slope / rise;  // where the ray to c crosses ab
    if (!(foot >= 0 && foot <= length)) return by_edges;
    return std::min(by_edges, distance_[a] + slope * x + rise * y);
  }

  std::vector<Vec3> positions_, caller_;
  std::vector<Triangle> faces_;
  std::unordered_map<uint64_t, uint8_t> boundary_;
  std::vector<double> distance_;
};

/// Points of a closed line, evenly spaced: shares of its length, and of which piece.
std::vector<Vec3> resampled(const std::vector<Vec3>& measure, const std::vector<Vec3>& line, double step,
                            double& length) {
  const size_t n = measure.size();
  std::vector<double> until(n + 1, 0);
  for (size_t k = 0; k < n; ++k) until[k + 1] = until[k] + (measure[(k + 1) % n] - measure[k]).norm();
  length = until[n];
  const size_t count = std::max<size_t>(3, static_cast<size_t>(std::round(length / step)));
  std::vector<Vec3> result;
  size_t k = 0;
  for (size_t i = 0; i < count; ++i) {
    const double s = length * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    while (k + 1 < n && until[k + 1] < s) ++k;
    const double t = until[k + 1] > until[k] ? (s - until[k]) / (until[k + 1] - until[k]) : 0;
    result.push_back(line[k] + t * (line[(k + 1) % n] - line[k]));
  }
  return result;
}

}  // namespace

Outlines find_outlines(const Surface& surface, double distance, double radius) {
  Outlines result;
  if (surface.boundary().empty()) return result;
  const DistanceField field(surface, distance, distance / 6);
  std::vector<std::vector<Vec3>> inside, outside;
  field.lines(distance, inside, outside);

  constexpr double kStep = 0.5;    // of points, in radii
  constexpr double kLeast = 6;     // length of a strand, in radii
  constexpr double kBeside = 3;    // way along the line that does not count as beside it, in radii
  std::vector<std::vector<Vec3>> lines, callers;
  std::vector<Vec3> all;
  std::vector<std::pair<uint32_t, uint32_t>> where;
  for (size_t i = 0; i < inside.size(); ++i) {
    double length = 0;
    std::vector<Vec3> line = resampled(inside[i], inside[i], kStep * radius, length);
    if (length < kLeast * radius) {
      ++result.skipped;
      continue;
    }
    callers.push_back(resampled(inside[i], outside[i], kStep * radius, length));
    for (uint32_t k = 0; k < line.size(); ++k) {
      where.emplace_back(static_cast<uint32_t>(lines.size()), k);
      all.push_back(line[k]);
    }
    lines.push_back(std::move(line));
  }
  const PointTree tree(all);
  std::vector<uint32_t> near;
  size_t at = 0;
  for (size_t i = 0; i < lines.size(); ++i) {
    const size_t n = lines[i].size();
    std::vector<uint8_t> free(n, 1);
    for (size_t k = 0; k < n; ++k, ++at) {
      tree.within(all[at], radius * radius, near);
      for (const uint32_t other : near) {
        const auto [line, index] = where[other];
        const size_t along = std::max<size_t>(index, k) - std::min<size_t>(index, k);
        if (line != i || static_cast<double>(std::min(along, n - along)) > kBeside / kStep) free[k] = 0;
      }
    }
    const auto add = [&](size_t first, size_t count, bool closed) {
      for (size_t k = 0; k < count; ++k) result.points.push_back(callers[i][(first + k) % n]);
      result.offsets.push_back(static_cast<uint32_t>(result.points.size()));
      result.closed.push_back(closed);
    };
    const auto blocked = std::find(free.begin(), free.end(), 0);
    if (blocked == free.end()) {
      add(0, n, true);
      continue;
    }
    // Stretches between places without room, starting at one of them.
    const size_t begin = static_cast<size_t>(blocked - free.begin());
    for (size_t k = 0; k < n;) {
      if (!free[(begin + k) % n]) {
        if (k == 0 || free[(begin + k - 1) % n]) ++result.skipped;
        ++k;
        continue;
      }
      size_t end = k;
      while (end < n && free[(begin + end) % n]) ++end;
      if (static_cast<double>(end - k) * kStep >= kLeast) add(begin + k, end - k, false);
      k = end;
    }
  }
  return result;
}

}  // namespace meander
