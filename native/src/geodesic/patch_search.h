// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far patches are from others along the surface, by steps from the middle of one to that of another. Part of
// patch_comparison.cpp and patch_sheets.cpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geodesic/constants.h"
#include "geodesic/surface_patches.h"

namespace meander {

/// From each patch to others near it, and how far it is between their middles: to those that touch it, and past one
/// that does to those beyond, where that goes off to the side. Over squares that touch along their sides only a way
/// along the diagonals would be longer by two fifths.
class PatchSteps {
 public:
  struct Step {
    uint32_t to;
    double length;
  };

  /// `centre`  of the patches
  PatchSteps(const SurfacePatches& patches, const std::vector<Vec3>& centre, ThreadPool& pool) {
    ends_.resize(patches.count());
    blocks_.resize(ThreadPool::block_count(patches.count(), kBlock));
    pool.for_blocks(patches.count(), kBlock, [&](size_t block, size_t begin, size_t end) {
      for (auto p = static_cast<uint32_t>(begin); p < end; ++p) {
        add(patches, centre, p, blocks_[block]);
        ends_[p] = static_cast<uint32_t>(blocks_[block].size());
      }
    });
  }

  std::span<const Step> from(uint32_t p) const {
    const uint32_t first = p % kBlock == 0 ? 0 : ends_[p - 1];
    return std::span(blocks_[p / kBlock]).subspan(first, ends_[p] - first);
  }

 private:
  static void add(const SurfacePatches& patches, const std::vector<Vec3>& centre, uint32_t p,
                  std::vector<Step>& steps) {
    const size_t first = steps.size();
    const auto length = [&](uint32_t a, uint32_t b) { return (centre[a] - centre[b]).norm(); };
    const auto alike = [&](uint32_t a, uint32_t b) { return patches.normal(a).dot(patches.normal(b)) >= kWayNormals; };
    for (const uint32_t q : patches.beside(p)) steps.push_back({q, length(p, q)});
    for (const uint32_t q : patches.beside(p)) {
      if (!alike(p, q) || patches.beside(q).size() > kMostBesidePatch) continue;
      for (const uint32_t beyond : patches.beside(q)) {
        const double straight = length(p, beyond);
        if (!(straight < kShorterWay * (length(p, q) + length(q, beyond)))) continue;
        if (beyond == p || !alike(p, beyond) || !alike(q, beyond)) continue;
        const bool known = std::any_of(steps.begin() + static_cast<ptrdiff_t>(first), steps.end(),
                                       [&](const Step& step) { return step.to == beyond; });
        if (!known) steps.push_back({beyond, straight});
      }
    }
  }

  static constexpr uint32_t kBlock = 512;  // patches whose steps are in one list
  std::vector<std::vector<Step>> blocks_;
  std::vector<uint32_t> ends_;  // of the steps of each patch, in its list
};

/// One search after another, in the same memory: that is as large as the surface, while a search is small. One thread.
class PatchSearch {
 public:
  /// `count`  of the patches
  void begin(uint32_t count) {
    if (distance_.empty()) distance_.resize(count, kUnreached);
  }
  void start_from(uint32_t p) { offer(p, 0); }

  /// Finds the patches q that are no farther than most(q) from where it starts. A shorter way to a patch may be found
  /// after it has handed a longer one on, which is rare where all steps are about as long; keeping the order costs
  /// more. Ends early where `targets` are given and all of them have been found.
  template <class Most>
  void spread(const PatchSteps& steps, const Most& most, std::span<const uint32_t> targets = {}) {
    const bool whole = targets.empty();
    for (size_t k = 0; k < front_.size(); ++k) {
      while (!targets.empty() && reached(targets.back())) targets = targets.first(targets.size() - 1);
      if (targets.empty() && !whole) return;
      const uint32_t q = front_[k];
      const double distance = distance_[q];
      for (const PatchSteps::Step& step : steps.from(q)) {
        const double farther = distance + step.length;
        if (farther <= most(step.to)) offer(step.to, farther);
      }
    }
  }

  bool reached(uint32_t p) const { return distance_[p] < kUnreached; }

  /// Before another search.
  void forget() {
    for (const uint32_t p : front_) distance_[p] = kUnreached;
    front_.clear();
  }

 private:
  static constexpr double kUnreached = std::numeric_limits<double>::infinity();
  void offer(uint32_t p, double at) {
    if (!(at < distance_[p])) return;
    distance_[p] = at;
    front_.push_back(p);
  }

  std::vector<double> distance_;  // per patch, as far as is known
  std::vector<uint32_t> front_;   // in the order in which they were reached, again where nearer
};

}  // namespace meander
