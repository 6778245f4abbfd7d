// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/seams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "base/point_grid.h"
#include "mesh/sheets.h"

namespace meander {
namespace {

using Vec3 = Eigen::Vector3d;

/// Vertices as far apart as this share of the shortest edge at one of them are never one.
constexpr double kNearest = 0.25;

/// A turn (turn_at_edge) from which on faces count as lying on each other: they are two sheets, not one.
constexpr double kFlatTurn = 1.99;

constexpr uint32_t kNobody = UINT32_MAX;

uint32_t from(std::span<const Triangle> faces, uint32_t e) { return faces[e / 3][e % 3]; }
uint32_t to(std::span<const Triangle> faces, uint32_t e) { return faces[e / 3][(e % 3 + 1) % 3]; }
uint32_t apex(std::span<const Triangle> faces, uint32_t e) { return faces[e / 3][(e % 3 + 2) % 3]; }

/// The vertices of the boundary in places: those near each other share one, named by the lowest of them.
class Places {
 public:
  Places(std::span<const Vec3> positions, std::span<const Triangle> faces, std::span<const uint32_t> boundary,
         double distance) {
    place_.assign(positions.size(), kNobody);
    std::vector<uint32_t> used;
    for (const uint32_t e : boundary) {
      for (const uint32_t v : {from(faces, e), to(faces, e)}) {
        if (place_[v] == kNobody) used.push_back(v);
        place_[v] = v;
      }
    }
    std::sort(used.begin(), used.end());
    std::vector<double> reach(positions.size(), distance);
    for (const Triangle& t : faces) {
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t a = t[k], b = t[(k + 1) % 3];
        const double limit = kNearest * (positions[a] - positions[b]).norm();
        reach[a] = std::min(reach[a], limit);
        reach[b] = std::min(reach[b], limit);
      }
    }
    std::vector<Vec3> points;
    double extent = 0, farthest = 0;
    for (const uint32_t v : used) {
      points.push_back(positions[v] - positions[used[0]]);
      extent = std::max(extent, points.back().cwiseAbs().maxCoeff());
      farthest = std::max(farthest, reach[v]);  // however large the distance is
    }
    if (!(farthest > 0)) return;
    const PointGrid grid(points, std::max(farthest, 1e-8 * extent));
    for (size_t i = 0; i < used.size(); ++i) {
      const uint32_t v = used[i];
      if (place_[v] != v) continue;  // in the place of a lower one
      grid.near(points[i], reach[v], [&](uint32_t j, double squared) {
        const uint32_t w = used[j];
        if (w <= v || place_[w] != w || squared >= reach[w] * reach[w]) return;
        place_[w] = v;
        shared_ = true;
      });
    }
  }
  uint32_t operator[](uint32_t v) const { return place_[v]; }
  bool shared() const { return shared_; }

 private:
  std::vector<uint32_t> place_;  // per vertex
  bool shared_ = false;
};

}  // namespace

std::vector<uint32_t> boundary_of(std::span<const Triangle> faces) {
  std::vector<std::pair<VertexPair, uint32_t>> sides;
  sides.reserve(3 * faces.size());
  for (uint32_t e = 0; e < 3 * faces.size(); ++e) {
    const uint32_t a = from(faces, e), b = to(faces, e);
    sides.emplace_back(VertexPair{std::min(a, b), std::max(a, b)}, e);
  }
  std::sort(sides.begin(), sides.end());
  std::vector<uint32_t> boundary;
  for (size_t i = 0; i < sides.size();) {
    size_t j = i + 1;
    while (j < sides.size() && sides[j].first == sides[i].first) ++j;
    if (j - i == 1) boundary.push_back(sides[i].second);
    i = j;
  }
  std::sort(boundary.begin(), boundary.end());
  return boundary;
}

std::vector<Seam> find_seams(std::span<const Vec3> positions, std::span<const Triangle> faces,
                             std::span<const uint32_t> boundary, double distance) {
  std::vector<Seam> seams;
  if (boundary.empty()) return seams;
  const Places places(positions, faces, boundary, distance);
  if (!places.shared()) return seams;
  std::vector<std::pair<VertexPair, uint32_t>> sides;
  for (const uint32_t e : boundary) {
    const uint32_t a = places[from(faces, e)], b = places[to(faces, e)];
    sides.emplace_back(VertexPair{std::min(a, b), std::max(a, b)}, e);
  }
  std::sort(sides.begin(), sides.end());
  std::vector<uint8_t> taken(3 * faces.size(), 0);
  for (size_t i = 0; i < sides.size();) {
    size_t j = i + 1;
    while (j < sides.size() && sides[j].first == sides[i].first) ++j;
    if (j - i > kMostAtEdge) {
      i = j;
      continue;
    }
    std::vector<std::tuple<bool, double, uint32_t, uint32_t>> pairs;  // in the same direction, turn, half-edges
    const Vec3 &a = positions[sides[i].first[0]], &b = positions[sides[i].first[1]];
    for (size_t k = i; k < j; ++k) {
      for (size_t l = k + 1; l < j; ++l) {
        const uint32_t one = sides[k].second, other = sides[l].second;
        const bool along = places[from(faces, one)] == places[from(faces, other)];
        const double turn = turn_at_edge(a, b, positions[apex(faces, one)], positions[apex(faces, other)]);
        if (turn < (along ? 1 : kFlatTurn)) pairs.emplace_back(along, turn, one, other);
      }
    }
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [along, turn, one, other] : pairs) {
      if (taken[one] || taken[other]) continue;
      taken[one] = taken[other] = 1;
      seams.push_back({one, other, !along});
    }
    i = j;
  }
  return seams;
}

}  // namespace meander
