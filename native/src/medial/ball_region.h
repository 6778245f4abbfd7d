// SPDX-License-Identifier: GPL-3.0-or-later
//
// Balls as regions of a walk down the tree of boxes.
#pragma once

#include "medial/constants.h"
#include "medial/curve_bvh.h"

namespace meander {

/// A ball in single precision, with room for what that rounds.
struct RoundedBall {
  Float4 x, y, z;  // centre
  float squared;   // radius, with slack

  RoundedBall(const Eigen::Vector3d& at, const Eigen::Vector3d& b, double radius)
      : x(all(static_cast<float>(at.x() + radius * b.x()))),
        y(all(static_cast<float>(at.y() + radius * b.y()))),
        z(all(static_cast<float>(at.z() + radius * b.z()))) {
    const double r = radius + kBoxRounding * (1 + radius);
    squared = static_cast<float>(r * r * kRoundedUp);
  }

  /// Squared distances of the centre from four boxes, the first of them `at`.
  template <class Boxes>
  Float4 distances(const Boxes& boxes, uint32_t at) const {
    const auto outside = [&](Float4 c, size_t axis) {
      return c - smaller(larger(c, load(boxes.low[axis] + at)), load(boxes.high[axis] + at));
    };
    const Float4 dx = outside(x, 0), dy = outside(y, 1), dz = outside(z, 2);
    return dx * dx + dy * dy + dz * dz;
  }
};

/// A ball that passes through x, has its centre in direction b from it, and shrinks while it is looked at. Where b is
/// 0 the centre is x itself, and stays.
template <bool Centred>
struct ShrinkingBall {
  static constexpr bool kNearestFirst = true, kRunsAtOnce = false, kMoves = !Centred;
  const Eigen::Vector3d &x, &b;
  const double& radius;
  RoundedBall ball{x, b, radius};

  uint32_t meets(const CurveBvh::Node& node, Float4& key) const {
    key = ball.distances(node, 0);
    return lanes_of(key < all(ball.squared));
  }
  bool passes(float key) const { return key >= ball.squared; }
  bool renew() {
    ball = RoundedBall(x, b, radius);
    return true;
  }
};

/// A ball that stays as it is.
struct StillBall {
  static constexpr bool kNearestFirst = false, kRunsAtOnce = false, kMoves = false;
  RoundedBall ball;

  uint32_t meets(const CurveBvh::Node& node, Float4& key) const {
    key = ball.distances(node, 0);
    return lanes_of(key < all(ball.squared));
  }
  static bool passes(float) { return false; }
  static bool renew() { return true; }
};

}  // namespace meander
