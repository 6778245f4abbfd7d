// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sets of numbers without a common member, which are joined two at a time (union-find).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace meander {

/// 0 .. n - 1, each alone at first. A set is named by its lowest member, so that names do not depend
/// on the order of joining.
class DisjointSets {
 public:
  explicit DisjointSets(size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  uint32_t find(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Another one, alone.
  void add() { parent_.push_back(static_cast<uint32_t>(parent_.size())); }
  /// False if they were one before.
  bool join(uint32_t i, uint32_t j) {
    i = find(i);
    j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
    return i != j;
  }

 private:
  std::vector<uint32_t> parent_;
};

}  // namespace meander
