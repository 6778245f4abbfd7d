// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/closest_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace meander {
namespace {

/// Most samples along a side of a face, so that one huge face among tiny ones does not swamp the tree.
constexpr int kMostAlongSide = 64;

/// Weights of the point of a triangle nearest to q (Ericson, Real-Time Collision Detection, 2005, 5.1.5).
std::array<double, 3> nearest_weights(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& q) {
  const Vec3 ab = b - a, ac = c - a, ap = q - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vec3 bp = q - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double t = d1 / (d1 - d3);
    return {1 - t, t, 0};
  }
  const Vec3 cp = q - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double t = d2 / (d2 - d6);
    return {1 - t, 0, t};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

}  // namespace

ClosestPoint::ClosestPoint(const Surface& surface, const CancelToken& poll)
    : ClosestPoint(surface, sample(surface, poll), poll) {}

ClosestPoint::ClosestPoint(const Surface& surface, Samples&& samples, const CancelToken& poll)
    : surface_(surface),
      face_(std::move(samples.face)),
      reach_(samples.reach),
      tree_(std::move(samples.points), poll) {}

ClosestPoint::Samples ClosestPoint::sample(const Surface& surface, CancelToken poll) {
  Samples s;
  const double step = surface.mean_edge_length();
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    const Triangle& t = surface.face(f);
    const Vec3 &a = surface.position(t[0]), &b = surface.position(t[1]), &c = surface.position(t[2]);
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const int k = std::clamp(static_cast<int>(std::ceil(longest / step)), 1, kMostAlongSide);
    s.reach = std::max(s.reach, longest / k);
    for (int i = 0; i < k; ++i) {
      for (int j = 0; i + j < k; ++j) {
        const double u = (i + 1.0 / 3) / k, v = (j + 1.0 / 3) / k;
        s.points.push_back((1 - u - v) * a + u * b + v * c);
        s.face.push_back(f);
        poll();
      }
    }
  }
  return s;
}

ClosestPoint::Result ClosestPoint::operator()(const Vec3& q) const {
  const auto sample = tree_.nearest(q);
  // So far away that the square of the distance overflows.
  if (!sample) return {make_point(0, 1, 0, 0), std::numeric_limits<double>::infinity()};
  const double bound = std::sqrt(sample->squared_distance) + reach_;
  std::vector<uint32_t> near, faces;
  tree_.within(q, bound * bound * (1 + 1e-12), near);
  for (const uint32_t i : near) faces.push_back(face_[i]);
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  double best = std::numeric_limits<double>::infinity();
  uint32_t face = 0;
  std::array<double, 3> weights{};
  for (const uint32_t f : faces) {
    const Triangle& t = surface_.face(f);
    const Vec3 &a = surface_.position(t[0]), &b = surface_.position(t[1]), &c = surface_.position(t[2]);
    const std::array<double, 3> w = nearest_weights(a, b, c, q);
    const double d = (w[0] * a + w[1] * b + w[2] * c - q).squaredNorm();
    if (d < best) {
      best = d;
      face = f;
      weights = w;
    }
  }
  return {make_point(face, weights[0], weights[1], weights[2]), std::sqrt(best)};
}

}  // namespace meander
