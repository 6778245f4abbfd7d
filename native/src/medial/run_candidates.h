// SPDX-License-Identifier: GPL-3.0-or-later
//
// The runs in which the balls of some neighbours may find what limits them.
#pragma once

#include "medial/curve_bvh.h"

namespace meander {

/// How many points of a run count for some others: none for any, maybe some, or all for each.
enum class RunShare : uint8_t { kNothing, kMaybe, kAll };

struct RunCandidates {
  static constexpr uint32_t kMost = 64;
  float low[3][kMost], high[3][kMost];  // of their boxes
  uint32_t run[kMost];
  RunShare share[kMost];  // how much of them counts
  uint32_t count = 0;

  bool add(uint32_t of, RunShare how_much, const CurveBvh::Box& box) {
    if (count == kMost) return false;
    run[count] = of;
    share[count] = how_much;
    set_box(count++, box);
    return true;
  }
  /// Fills up four lanes with boxes that are nowhere.
  void close() {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    for (uint32_t at = count; at % 4 != 0; ++at) set_box(at, {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}});
  }

 private:
  void set_box(uint32_t at, const CurveBvh::Box& box) {
    for (size_t axis = 0; axis < 3; ++axis) {
      low[axis][at] = box.low[axis];
      high[axis][at] = box.high[axis];
    }
  }
};

/// What points of one kind see of candidates, found out when it is first asked for.
class SeenLanes {
 public:
  void begin(const RunCandidates& near) {
    for (uint32_t k = 0; k < near.count; ++k) lanes_[k] = near.share[k] == RunShare::kAll ? kAll : kUnknown;
  }
  /// Whether it is known already that they see nothing of a candidate.
  bool known_blind(uint32_t candidate) const { return lanes_[candidate] == 0; }
  template <class Ask>
  uint32_t get(uint32_t candidate, const Ask& ask) {
    uint16_t& lanes = lanes_[candidate];
    if (lanes == kUnknown) lanes = static_cast<uint16_t>(ask());
    return lanes;
  }

 private:
  static constexpr uint16_t kUnknown = 1u << 15, kAll = (1u << CurveBvh::kRun) - 1;
  std::array<uint16_t, RunCandidates::kMost> lanes_;
};

/// A box as a region of a walk, which ends when there are too many runs.
struct StillBox {
  static constexpr bool kNearestFirst = false, kRunsAtOnce = true, kMoves = false;
  CurveBvh::Box box;

  uint32_t meets(const CurveBvh::Node& node, Float4& key) const {
    key = all(0);
    Int4 met = Int4{-1, -1, -1, -1};
    for (size_t axis = 0; axis < 3; ++axis) {
      met &= (load(node.low[axis]) <= all(box.high[axis])) & (load(node.high[axis]) >= all(box.low[axis]));
    }
    return lanes_of(met);
  }
  static bool passes(float) { return false; }
  static bool renew() { return false; }
};

/// The runs that the balls of the points begin .. end - 1 may meet, but for those of which nothing counts by
/// share(run); false if there are too many, or the points belong to several parts.
template <class Share>
bool find_candidates(const CurveBvh& tree, size_t begin, size_t end, std::span<const std::array<Eigen::Vector3d, 2>> b,
                     std::span<const std::array<double, 2>> radii, const Share& share, RunCandidates& near) {
  near.count = 0;
  Eigen::Vector3d low = tree.points()[begin], high = low;
  for (size_t i = begin; i < end; ++i) {
    if (tree.part(i) != tree.part(begin)) return false;
    for (size_t side = 0; side < 2; ++side) {
      const double r = radii[i][side];
      if (!(r > 0)) continue;
      const Eigen::Vector3d centre = tree.points()[i] + r * b[i][side], all_round = Eigen::Vector3d::Constant(r);
      low = low.cwiseMin(centre - all_round);
      high = high.cwiseMax(centre + all_round);
    }
  }
  StillBox region;
  for (int axis = 0; axis < 3; ++axis) {
    region.box.low[static_cast<size_t>(axis)] = rounded_down(low[axis]);
    region.box.high[static_cast<size_t>(axis)] = rounded_up(high[axis]);
  }
  bool few = true;
  tree.walk(tree.part(begin), region, [&](uint32_t run) {
    const RunShare of_run = share(run);
    few = of_run == RunShare::kNothing || near.add(run, of_run, tree.box(run));
    return !few;
  });
  if (few) near.close();
  return few;
}

}  // namespace meander
