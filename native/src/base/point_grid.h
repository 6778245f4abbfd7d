// SPDX-License-Identifier: GPL-3.0-or-later
//
// All points near to a place, for queries of about one size: several times faster than a tree.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace meander {

/// Points in cubes of space, side by side in memory. Any number of threads may ask.
class PointGrid {
 public:
  /// `size`  of a cube, positive: about the radius of the queries
  PointGrid(const std::vector<Eigen::Vector3d>& points, double size) : size_(size) {
    std::vector<std::pair<uint64_t, uint32_t>> order(points.size());
    for (uint32_t i = 0; i < points.size(); ++i) order[i] = {key(cube(points[i])), i};
    std::ranges::sort(order);
    size_t slots = 16;
    while (slots < 2 * points.size()) slots *= 2;
    table_.assign(slots, {0, 0, 0});
    places_.reserve(points.size());
    for (size_t k = 0; k < order.size();) {
      const uint64_t here = order[k].first;
      const auto first = static_cast<uint32_t>(k);
      for (; k < order.size() && order[k].first == here; ++k) {
        places_.push_back({points[order[k].second], order[k].second});
      }
      size_t at = slot(here);
      while (table_[at].end != 0) at = (at + 1) & (slots - 1);
      table_[at] = {here, first, static_cast<uint32_t>(k)};
    }
  }

  /// Calls visit(index, squared distance) for all points nearer to q than `radius`, in an order that only the points
  /// decide.
  template <class Visit>
  void near(const Eigen::Vector3d& q, double radius, const Visit& visit) const {
    const Eigen::Array3i low = cube(q - Eigen::Vector3d::Constant(radius));
    const Eigen::Array3i high = cube(q + Eigen::Vector3d::Constant(radius));
    for (int x = low.x(); x <= high.x(); ++x) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int z = low.z(); z <= high.z(); ++z) {
          const auto [first, end] = range(key({x, y, z}));
          for (uint32_t k = first; k < end; ++k) {
            const double squared = (places_[k].point - q).squaredNorm();
            if (squared < radius * radius) visit(places_[k].index, squared);
          }
        }
      }
    }
  }

 private:
  struct Place {
    Eigen::Vector3d point;
    uint32_t index;
  };
  struct Range {
    uint64_t key;
    uint32_t first, end;  // end: 0 in an empty slot
  };

  Eigen::Array3i cube(const Eigen::Vector3d& p) const { return (p / size_).array().floor().cast<int>(); }
  /// Cubes a million apart share a key; they are too far from each other to matter.
  static uint64_t key(const Eigen::Array3i& c) {
    const auto part = [](int x) { return static_cast<uint64_t>(static_cast<uint32_t>(x) & 0xfffff); };
    return part(c.x()) | part(c.y()) << 20 | part(c.z()) << 40;
  }
  size_t slot(uint64_t key) const { return (key * 0x9e3779b97f4a7c15u >> 20) & (table_.size() - 1); }
  std::pair<uint32_t, uint32_t> range(uint64_t key) const {
    for (size_t at = slot(key);; at = (at + 1) & (table_.size() - 1)) {
      if (table_[at].end == 0) return {0, 0};
      if (table_[at].key == key) return {table_[at].first, table_[at].end};
    }
  }

  double size_;
  std::vector<Place> places_;
  std::vector<Range> table_;  // open addressing
};

}  // namespace meander
