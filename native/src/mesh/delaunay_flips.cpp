// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/delaunay_flips.h"

#include <algorithm>

#include "mesh/constants.h"
#include "mesh/edge_groups.h"
#include "mesh/in_circle.h"

namespace meander {
namespace {

constexpr uint32_t kRim = UINT32_MAX;

/// Half-edges as in edge_groups.h. This table of what lies beyond each is kept for one polygon only, which is no mesh
/// yet.
class DiagonalFlips {
 public:
  DiagonalFlips(std::span<const Vec2> points, std::vector<Triangle>& triangles)
      : given_(points), triangles_(triangles), beyond_(3 * triangles.size(), kRim) {
    Vec2 low{}, high{};
    for (const Vec2 p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const bool wide = high.x - low.x > high.y - low.y;
    for (const Vec2 p : points) points_.push_back({wide ? kPlaneStretch * p.x : p.x, wide ? p.y : kPlaneStretch * p.y});
    ThreadPool pool(1);
    EdgeGroups(triangles, points.size(), pool).for_each({}, [&](const VertexPair&, EdgeSides sides) {
      if (sides.size() != 2) return;
      const uint32_t one = sides[0].half_edge, other = sides[1].half_edge;
      if (from(triangles_, one) == from(triangles_, other)) return;
      beyond_[one] = other;
      beyond_[other] = one;
      doubtful_.push_back(one);
    });
  }

  void flip_all() {
    size_t left = kMostFlipsOfTriangle * triangles_.size();
    while (!doubtful_.empty() && left > 0) {
      const uint32_t e = doubtful_.back();
      doubtful_.pop_back();
      if (!improves(e)) continue;
      flip(e);
      --left;
    }
  }

  void widen(double flat) {
    std::vector<uint32_t> narrow;
    const auto look_at = [&](uint32_t t) {
      if (!(height(triangles_[t]) > flat)) narrow.push_back(t);
    };
    for (uint32_t t = 0; t < triangles_.size(); ++t) look_at(t);
    while (!narrow.empty()) {
      const uint32_t t = narrow.back();
      narrow.pop_back();
      if (height(triangles_[t]) > flat) continue;
      uint32_t best = kRim;
      double highest = 0;
      for (uint32_t e = 3 * t; e < 3 * t + 3; ++e) {
        const double gain = height_gained(e);
        if (gain <= highest) continue;
        best = e;
        highest = gain;
      }
      if (best == kRim) continue;
      const uint32_t other = beyond_[best] / 3;
      flip(best);
      for (const uint32_t changed : {t, other}) {
        look_at(changed);
        for (uint32_t e = 3 * changed; e < 3 * changed + 3; ++e) {
          if (beyond_[e] != kRim && beyond_[e] / 3 != t && beyond_[e] / 3 != other) look_at(beyond_[e] / 3);
        }
      }
    }
  }

 private:
  /// Over the longest side; negative for triangles that are turned over.
  double height(const Triangle& t) const {
    const Vec2 a = given_[t[0]], b = given_[t[1]], c = given_[t[2]];
    return cross(b - a, c - a) / std::max({norm(b - a), norm(c - b), norm(a - c)});
  }
  /// The smaller height of the two triangles with the other diagonal; 0 where that is no more than now.
  double height_gained(uint32_t e) const {
    const uint32_t o = beyond_[e];
    if (o == kRim) return 0;
    const uint32_t a = from(triangles_, e), b = to(triangles_, e), c = apex(triangles_, e), d = apex(triangles_, o);
    const double now = std::min(height(triangles_[e / 3]), height(triangles_[o / 3]));
    const double then = std::min(height({a, d, c}), height({d, b, c}));
    return then > now && then > 0 ? then : 0;
  }
  static uint32_t after(uint32_t e) { return e % 3 == 2 ? e - 2 : e + 1; }
  Vec2 at(uint32_t v) const { return points_[v]; }

  bool improves(uint32_t e) const {
    if (beyond_[e] == kRim) return false;
    const Vec2 a = at(from(triangles_, e)), b = at(to(triangles_, e)), c = at(apex(triangles_, e)),
               d = at(apex(triangles_, beyond_[e]));
    return in_circle(a, b, c, d) > 0 && orientation(a, d, c) > 0 && orientation(d, b, c) > 0;
  }

  /// The triangles a b c and b a d become a d c and d b c.
  void flip(uint32_t e) {
    const uint32_t o = beyond_[e];
    const uint32_t bc = after(e), ca = after(bc), ad = after(o), db = after(ad);
    const uint32_t a = from(triangles_, e), b = from(triangles_, o), c = from(triangles_, ca), d = from(triangles_, db);
    const uint32_t at_bc = beyond_[bc], at_ca = beyond_[ca], at_ad = beyond_[ad], at_db = beyond_[db];
    const uint32_t first = 3 * (e / 3), second = 3 * (o / 3);
    triangles_[first / 3] = {a, d, c};
    triangles_[second / 3] = {d, b, c};
    join(first, at_ad);
    join(first + 1, second + 2);
    join(first + 2, at_ca);
    join(second, at_db);
    join(second + 1, at_bc);
    doubtful_.insert(doubtful_.end(), {first, first + 2, second, second + 1});
  }
  void join(uint32_t e, uint32_t other) {
    beyond_[e] = other;
    if (other != kRim) beyond_[other] = e;
  }

  std::span<const Vec2> given_;
  std::vector<Vec2> points_;  // stretched
  std::vector<Triangle>& triangles_;
  std::vector<uint32_t> beyond_, doubtful_;
};

}  // namespace

void flip_to_delaunay(std::span<const Vec2> points, double flat, std::vector<Triangle>& triangles) {
  DiagonalFlips flips(points, triangles);
  flips.flip_all();
  flips.widen(flat);
}

}  // namespace meander
