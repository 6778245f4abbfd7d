// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangle nearest to a point, by a tree of the triangles' boxes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/cancel_token.h"
#include "base/eigen.h"

namespace meander {

/// Exact: of all triangles the nearest, of several that are equally near the first, whatever the tree looks like.
/// Triangles may be anything finite within a few units of the origin, slivers and points too, and in any number but 0.
/// Queries may run on any number of threads.
class TriangleTree {
 public:
  using Vec3 = Eigen::Vector3d;
  using Corners = std::array<Vec3, 3>;

  struct Nearest {
    uint32_t triangle;              ///< as they were given
    std::array<double, 3> weights;  ///< of its corners, >= 0
    double distance;                ///< infinite where that is no double
  };

  /// `thin`  triangles whose height is below this share of their longest side are measured with more care, in more
  ///         time: distances are off by about 2^-53 / thin^2 of the side
  /// `poll`  counts what is done while the tree is made, some nanoseconds each
  TriangleTree(const std::vector<Corners>& triangles, double thin, CancelToken poll);

  /// `q` may be anywhere but NaN.
  Nearest nearest(const Vec3& q) const;

 private:
  static constexpr uint32_t kLeaf = 4;  // triangles of a leaf, but for the last one
  static constexpr uint32_t kThin = 1u << 31;
  struct Box {
    Vec3 low, high;
  };
  struct Node {
    Box box;
    uint32_t first, leaves;  // the leaves below it; its first child follows it, the other all below that
  };
  struct Centre {
    Vec3 at;
    uint32_t triangle;
  };
  class Search;

  void add(std::vector<Centre>& centres, uint32_t first, uint32_t leaves, const std::vector<Corners>& triangles,
           CancelToken& poll);
  void lay_out(const std::vector<Centre>& centres, Node& leaf, const std::vector<Corners>& triangles);

  double thin_;
  std::vector<Node> nodes_;
  std::vector<Corners> corners_;    // in the order of the leaves
  std::vector<uint32_t> triangle_;  // the same, with kThin
};

}  // namespace meander
