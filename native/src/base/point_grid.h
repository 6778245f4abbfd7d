// SPDX-License-Identifier: GPL-3.0-or-later
//
// All points near to a place, for queries of about one size, or of very different ones: several times faster than a
// tree.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/cancel_token.h"
#include "base/eigen.h"

namespace meander {

/// Points in cubes of space, side by side in memory, and cubes in cubes that are twice as large, as many times as the
/// queries ask for: one of any size looks into a few tens of cubes of about its own. Any number of threads may ask.
class PointGrid {
 public:
  /// For queries of one radius. `size` of a cube, positive: about that radius. `poll` counts points, some times each.
  PointGrid(const std::vector<Eigen::Vector3d>& points, double size, const CancelToken& poll = {})
      : PointGrid(points, size, size, poll) {}

  /// For queries of radii from about `least` to about `most`, both positive. Where they differ by more than thirty
  /// thousand times, the least look into cubes that are too large for them.
  PointGrid(const std::vector<Eigen::Vector3d>& points, double least, double most, CancelToken poll = {})
      : size_(std::max(least, std::ldexp(most, 1 - kMostLevels))) {
    std::vector<std::pair<uint64_t, uint32_t>> order(points.size());
    for (uint32_t i = 0; i < points.size(); ++i) {
      poll();
      order[i] = {in_order(cube(points[i], size_)), i};
    }
    std::ranges::sort(order, [&](const auto& a, const auto& b) { return poll(), a < b; });
    places_.reserve(points.size());
    std::vector<Range> cubes;
    for (const auto& [place, i] : order) {
      poll();
      if (cubes.empty() || cubes.back().key != place) {
        cubes.push_back({place, static_cast<uint32_t>(places_.size()), 0});
      }
      places_.push_back({points[i], i});
      cubes.back().end = static_cast<uint32_t>(places_.size());
    }
    for (int level = 0; level <= level_of(most); ++level) {
      if (level > 0) merge(cubes);
      levels_.emplace_back(std::ldexp(size_, level), level, cubes, places_, poll);
    }
  }

  /// Calls visit(index, squared distance) for all points nearer to q than `radius`, in an order that only the points
  /// decide.
  template <class Visit>
  void near(const Eigen::Vector3d& q, double radius, const Visit& visit) const {
    const Level& level = level_for(radius);
    const Eigen::Array3i low = cube(q - Eigen::Vector3d::Constant(radius), level.size);
    const Eigen::Array3i high = cube(q + Eigen::Vector3d::Constant(radius), level.size);
    for (int x = low.x(); x <= high.x(); ++x) {
      for (int y = low.y(); y <= high.y(); ++y) {
        const uint64_t column = level.part(x) | level.part(y) << kBits;
        for (int z = low.z(); z <= high.z(); ++z) {
          const auto [first, end] = level.range(column | level.part(z) << (2 * kBits));
          for (uint32_t k = first; k < end; ++k) {
            const double squared = (places_[k].point - q).squaredNorm();
            if (squared < radius * radius) visit(places_[k].index, squared);
          }
        }
      }
    }
  }

 private:
  struct IndexedPoint {
    Eigen::Vector3d point;
    uint32_t index;
  };
  struct Range {
    uint64_t key;
    uint32_t first, end;  // end: 0 in an empty slot
  };

  /// Bits of the number of a cube on each axis. Cubes two million apart share a number, or half as many of the next
  /// size; they are too far from each other to matter, as long as there are some tens that do not.
  static constexpr uint32_t kBits = 21;
  static constexpr int kMostLevels = 16;

  /// Cubes of one size.
  struct Level {
    double size;
    uint32_t mask, shift;
    std::vector<Range> table;  // open addressing

    Level(double size_of_cubes, int level, const std::vector<Range>& cubes, const std::vector<IndexedPoint>& places,
          CancelToken& poll)
        : size(size_of_cubes), mask((1u << (kBits - static_cast<uint32_t>(level))) - 1) {
      const size_t slots = std::bit_ceil(std::max<size_t>(16, 2 * cubes.size()));
      shift = static_cast<uint32_t>(64 - std::countr_zero(slots));
      table.assign(slots, {0, 0, 0});
      for (const Range& each : cubes) {
        poll();
        const Eigen::Array3i c = cube(places[each.first].point, size);
        const uint64_t here = part(c.x()) | part(c.y()) << kBits | part(c.z()) << (2 * kBits);
        size_t at = slot(here);
        while (table[at].end != 0) at = (at + 1) & (slots - 1);
        table[at] = {here, each.first, each.end};
      }
    }
    /// Of the key of a cube, which has one of each axis.
    uint64_t part(int x) const { return static_cast<uint32_t>(x) & mask; }
    /// The highest bits depend on all of the key.
    size_t slot(uint64_t key) const { return key * 0x9e3779b97f4a7c15u >> shift; }
    std::pair<uint32_t, uint32_t> range(uint64_t key) const {
      for (size_t at = slot(key);; at = (at + 1) & (table.size() - 1)) {
        if (table[at].end == 0) return {0, 0};
        if (table[at].key == key) return {table[at].first, table[at].end};
      }
    }
  };

  static Eigen::Array3i cube(const Eigen::Vector3d& p, double size) { return (p / size).array().floor().cast<int>(); }

  /// A number for each cube of the least size, such that those in one of twice that size follow one another and differ
  /// in the last three bits only, and so on (Morton's order).
  static uint64_t in_order(const Eigen::Array3i& c) {
    const auto spread = [](int x) {
      uint64_t bits = static_cast<uint32_t>(x) & ((1u << kBits) - 1);
      bits = (bits | bits << 32) & 0x001f00000000ffffu;
      bits = (bits | bits << 16) & 0x001f0000ff0000ffu;
      bits = (bits | bits << 8) & 0x100f00f00f00f00fu;
      bits = (bits | bits << 4) & 0x10c30c30c30c30c3u;
      return (bits | bits << 2) & 0x1249249249249249u;
    };
    return spread(c.x()) | spread(c.y()) << 1 | spread(c.z()) << 2;
  }

  /// From cubes to those of twice the size, both in order.
  static void merge(std::vector<Range>& cubes) {
    size_t count = 0;
    for (const Range each : cubes) {
      const uint64_t around = each.key >> 3;
      if (count > 0 && cubes[count - 1].key == around) {
        cubes[count - 1].end = each.end;
      } else {
        cubes[count++] = {around, each.first, each.end};
      }
    }
    cubes.resize(count);
  }

  /// Cubes of about the size of a radius, by a factor of the root of 2 at most where there are such.
  int level_of(double radius) const { return std::clamp(std::ilogb(1.4142 * radius / size_), 0, kMostLevels - 1); }
  const Level& level_for(double radius) const {
    if (levels_.size() == 1) return levels_[0];
    return levels_[std::min(static_cast<size_t>(level_of(radius)), levels_.size() - 1)];
  }

  double size_;  // of the least cubes
  std::vector<IndexedPoint> places_;
  std::vector<Level> levels_;  // from the least to the largest
};

}  // namespace meander
