// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/eigen.h"
#include "mesh/constants.h"

namespace meander {
namespace {

using Vec3 = Eigen::Vector3d;
using Weights = std::array<double, 3>;

/// Weights of the point of a triangle nearest to q (Ericson, Real-Time Collision Detection, 2005, 5.1.5).
Weights nearest_weights(const TriangleTree::Corners& corners, const Vec3& q) {
  const auto& [a, b, c] = corners;
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

Vec3 at(const TriangleTree::Corners& corners, const Weights& w) {
  return w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
}

/// The side, as its first corner, that is the longest.
uint32_t longest_side(const TriangleTree::Corners& c) {
  const double sides[] = {(c[1] - c[0]).squaredNorm(), (c[2] - c[1]).squaredNorm(), (c[0] - c[2]).squaredNorm()};
  return static_cast<uint32_t>(std::max_element(sides, sides + 3) - sides);
}

bool is_thin(const TriangleTree::Corners& c, double share) {
  const uint32_t k = longest_side(c);
  const double longest = (c[(k + 1) % 3] - c[k]).squaredNorm();
  const double area = (c[1] - c[0]).cross(c[2] - c[0]).squaredNorm();
  return !(area > share * share * longest * longest);
}

/// The foot of q on the plane of a triangle that may be thin, if it lies inside: by the direction of its longest side
/// and the height on that, which is made upright twice, as the first time leaves an error of the size of the side.
std::optional<Weights> inner_weights(const TriangleTree::Corners& corners, const Vec3& q) {
  const uint32_t k = longest_side(corners);
  const Vec3 &a = corners[k], &b = corners[(k + 1) % 3], &c = corners[(k + 2) % 3];
  const Vec3 side = b - a;
  const double length = side.squaredNorm();
  double foot = (c - a).dot(side) / length;
  Vec3 height = (c - a) - foot * side;
  const double rest = height.dot(side) / length;
  height -= rest * side;
  foot += rest;
  const double third = (q - a).dot(height) / height.squaredNorm();
  const double second = (q - a).dot(side) / length - third * foot;
  const double first = 1 - second - third;
  if (!(first >= 0 && second >= 0 && third >= 0)) return std::nullopt;
  Weights weights{};
  weights[k] = first;
  weights[(k + 1) % 3] = second;
  weights[(k + 2) % 3] = third;
  return weights;
}

/// nearest_weights of any triangle: of the nearest points of its sides and its inside the nearest.
Weights thin_nearest_weights(const TriangleTree::Corners& corners, const Vec3& q) {
  Weights best{};
  double least = std::numeric_limits<double>::infinity();
  const auto take = [&](const Weights& w) {
    const double d = (at(corners, w) - q).squaredNorm();
    if (!(d < least)) return;
    least = d;
    best = w;
  };
  take({1, 0, 0});
  for (uint32_t k = 0; k < 3; ++k) {
    const Vec3 side = corners[(k + 1) % 3] - corners[k];
    const double length = side.squaredNorm();
    const double t = length > 0 ? std::clamp((q - corners[k]).dot(side) / length, 0.0, 1.0) : 0;
    Weights w{};
    w[k] = 1 - t;
    w[(k + 1) % 3] = t;
    take(w);
  }
  if (const auto inside = inner_weights(corners, q)) take(*inside);
  return best;
}

double squared_distance(const Vec3& low, const Vec3& high, const Vec3& q) {
  return (low - q).cwiseMax(q - high).cwiseMax(0).squaredNorm();
}

}  // namespace

TriangleTree::TriangleTree(const std::vector<Corners>& triangles, double thin, CancelToken poll)
    : thin_(thin), corners_(triangles.size()), triangle_(triangles.size()) {
  std::vector<Centre> centres(triangles.size());
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    const Corners& c = triangles[t];
    centres[t] = {0.5 * (c[0].cwiseMin(c[1]).cwiseMin(c[2]) + c[0].cwiseMax(c[1]).cwiseMax(c[2])), t};
    poll();
  }
  const auto leaves = static_cast<uint32_t>((triangles.size() + kLeaf - 1) / kLeaf);
  nodes_.reserve(2 * size_t{leaves});
  add(centres, 0, leaves, triangles, poll);
}

/// Adds the node of these leaves and all below it.
void TriangleTree::add(std::vector<Centre>& centres, uint32_t first, uint32_t leaves,
                       const std::vector<Corners>& triangles, CancelToken& poll) {
  const size_t node = nodes_.size();
  nodes_.push_back({{Vec3::Zero(), Vec3::Zero()}, first, leaves});
  if (leaves == 1) {
    lay_out(centres, nodes_[node], triangles);
    return;
  }
  const auto begin = centres.begin() + size_t{kLeaf} * first;
  const auto end = centres.begin() + static_cast<ptrdiff_t>(std::min(size_t{kLeaf} * (first + leaves), centres.size()));
  Vec3 low = begin->at, high = low;
  for (auto c = begin; c != end; ++c) {
    low = low.cwiseMin(c->at);
    high = high.cwiseMax(c->at);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const uint32_t half = (leaves + 1) / 2;
  std::nth_element(begin, begin + size_t{kLeaf} * half, end, [&](const Centre& a, const Centre& b) {
    poll();
    return a.at[axis] < b.at[axis];
  });
  add(centres, first, half, triangles, poll);
  add(centres, first + half, leaves - half, triangles, poll);
  const Box &one = nodes_[node + 1].box, &other = nodes_[node + 2 * size_t{half}].box;
  nodes_[node].box = {one.low.cwiseMin(other.low), one.high.cwiseMax(other.high)};
}

void TriangleTree::lay_out(const std::vector<Centre>& centres, Node& leaf, const std::vector<Corners>& triangles) {
  const size_t first = size_t{kLeaf} * leaf.first, end = std::min(first + kLeaf, centres.size());
  leaf.box = {Vec3::Constant(std::numeric_limits<double>::infinity()),
              Vec3::Constant(-std::numeric_limits<double>::infinity())};
  for (size_t i = first; i < end; ++i) {
    const uint32_t t = centres[i].triangle;
    corners_[i] = triangles[t];
    triangle_[i] = t | (is_thin(triangles[t], thin_) ? kThin : 0);
    for (const Vec3& p : triangles[t]) {
      leaf.box.low = leaf.box.low.cwiseMin(p);
      leaf.box.high = leaf.box.high.cwiseMax(p);
    }
  }
}

/// One walk down the tree, the nearer child first.
class TriangleTree::Search {
 public:
  Search(const TriangleTree& tree, const Vec3& q) : tree_(tree), q_(q), rounding_(kTreeRounding * (1 + q.norm())) {}

  Nearest run() {
    visit(0, 0);
    return {found_, weights_, std::sqrt(squared_)};
  }
  const Vec3& nearest() const { return nearest_; }

 private:
  void visit(size_t node, double squared_to_box) {
    if (!(squared_to_box <= bound_)) return;
    const Node& n = tree_.nodes_[node];
    if (n.leaves == 1) {
      measure(n.first);
      return;
    }
    const size_t one = node + 1, other = node + 2 * size_t{(n.leaves + 1) / 2};
    const double to_one = distance(one), to_other = distance(other);
    if (to_one <= to_other) {
      visit(one, to_one);
      visit(other, to_other);
    } else {
      visit(other, to_other);
      visit(one, to_one);
    }
  }

  double distance(size_t node) const {
    const Box& box = tree_.nodes_[node].box;
    return squared_distance(box.low, box.high, q_);
  }

  void measure(uint32_t leaf) {
    const size_t first = size_t{kLeaf} * leaf, end = std::min(first + kLeaf, tree_.corners_.size());
    for (size_t i = first; i < end; ++i) {
      const Corners& corners = tree_.corners_[i];
      const bool thin = (tree_.triangle_[i] & kThin) != 0;
      const uint32_t t = tree_.triangle_[i] & ~kThin;
      const Weights w = thin ? thin_nearest_weights(corners, q_) : nearest_weights(corners, q_);
      const Vec3 p = at(corners, w);
      const double d = (p - q_).squaredNorm();
      if (!(d < squared_ || (d == squared_ && t < found_))) continue;
      squared_ = d;
      found_ = t;
      weights_ = w;
      nearest_ = p;
      const double farthest = std::sqrt(d) + rounding_;
      bound_ = farthest * farthest * (1 + kTreeRounding);
    }
  }

  const TriangleTree& tree_;
  const Vec3 q_;
  const double rounding_;
  double squared_ = std::numeric_limits<double>::infinity(), bound_ = squared_;
  uint32_t found_ = UINT32_MAX;
  Weights weights_{};
  Vec3 nearest_ = Vec3::Zero();
};

TriangleTree::Nearest TriangleTree::nearest(const Vec3& q) const {
  const double farthest = q.cwiseAbs().maxCoeff();
  if (farthest <= kFarFromTriangles) return Search(*this, q).run();
  // Squares of such lengths may be no doubles. Infinite coordinates count more than all others.
  const auto towards = [&](double x) {
    return std::isfinite(farthest) ? x / farthest : (std::isinf(x) ? std::copysign(1.0, x) : 0.0);
  };
  Search search(*this, kFarFromTriangles * q.unaryExpr(towards));
  Nearest place = search.run();
  place.distance = std::isfinite(farthest) ? (q - search.nearest()).stableNorm() : farthest;
  return place;
}

}  // namespace meander
