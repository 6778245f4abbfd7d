// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tree of boxes over the points of a curve, and the one walk down it; medial/empty_balls.h has what is asked of it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "base/eigen.h"
#include "base/large_pages.h"
#include "base/thread_pool.h"
#include "medial/lanes.h"

namespace meander {

/// A tree of boxes, four to a node, over runs of consecutive points: neighbours on a curve are neighbours in space, so
/// nothing has to be sorted but the runs. Where points belong to parts that see nothing of each other, as those of the
/// components of a surface, each part has a tree of its own: a query costs what it would if there were no other. Any
/// number of threads may ask. Refers to the points and their parts, which must outlive it; points and all that is asked
/// for must lie within a few units of the origin (the surface's own unit), because the boxes are kept in single
/// precision.
class CurveBvh {
 public:
  /// Points in a run.
  static constexpr uint32_t kRun = 8;

  /// Around the points of a run.
  struct Box {
    std::array<float, 3> low, high;
  };
  /// The boxes of four branches, axis by axis.
  struct alignas(64) Node {
    float low[3][4], high[3][4];
    uint32_t child[4];
  };
  /// The points of a run side by side; a run that is not full repeats its last one.
  struct Points {
    double x[kRun], y[kRun], z[kRun];
  };

  CurveBvh() = default;
  CurveBvh(std::span<const Eigen::Vector3d> points, ThreadPool& pool) { build(points, pool); }

  /// Becomes the tree of other points, in the memory that it has.
  ///
  /// `parts`  the part of each point; empty: there is only one. A run that holds points of several parts is in the tree
  ///          of each: a query of one part may meet these few points of another
  void build(std::span<const Eigen::Vector3d> points, ThreadPool& pool, std::span<const uint32_t> parts = {});

  std::span<const Eigen::Vector3d> points() const { return points_; }
  const Points& lanes(uint32_t run) const { return lanes_[run]; }
  const Box& box(uint32_t run) const { return boxes_[run]; }
  /// The part of a point; 0 where there is one part.
  uint32_t part(size_t i) const { return parts_.empty() ? 0 : parts_[i]; }

  /// Hands its memory on; not to be asked then.
  void hand_on() noexcept { meander::hand_on(boxes_, lanes_, runs_, nodes_); }

  /// Calls visit(run) for the runs of a part whose boxes a region meets. Where the visit has changed the region, it
  /// returns true.
  ///
  /// `Region`  uint32_t meets(const Node&, Float4& key): a bit for each branch that it meets, and how far that is;
  ///           bool passes(float key): whether what was met is not any more;
  ///           bool renew(): takes a change in, and returns whether the walk goes on;
  ///           kNearestFirst: branches are looked at in the order of their keys, else the last first;
  ///           kRunsAtOnce: runs are visited before any branch beside them;
  ///           kMoves: keys from before a change say nothing after it
  template <class Region, class Visit>
  void walk(uint32_t part, Region& region, const Visit& visit) const;

 private:
  static constexpr uint32_t kLeaf = 1u << 31;  // marks a child that is a run

  void take_in(uint32_t run);
  uint32_t add_branch(Table<Node>& nodes, uint32_t first, uint32_t last, ThreadPool* pool);
  void set_boxes(Node& node, const uint32_t (&cuts)[5]) const;
  void halve(uint32_t first, uint32_t middle, uint32_t last);
  void list_runs_of_parts();

  std::span<const Eigen::Vector3d> points_;
  std::span<const uint32_t> parts_;
  Table<Box> boxes_;             // of the runs
  Table<Points> lanes_;          // of the runs
  Table<uint32_t> runs_;         // in the order of the tree's leaves, part after part
  std::vector<uint32_t> first_;  // of the runs of each part
  std::vector<uint32_t> roots_;  // of the parts; UINT32_MAX for one that has no points
  Table<Node> nodes_;
};

template <class Region, class Visit>
void CurveBvh::walk(uint32_t part, Region& region, const Visit& visit) const {
  const size_t tree = parts_.empty() ? 0 : part;
  if (tree >= roots_.size() || roots_[tree] == UINT32_MAX) return;
  struct Waiting {
    uint32_t id;
    float key;
  };
  // A level leaves at most 3 behind; 2^30 points make 15 levels.
  constexpr int kMost = 64;
  Waiting stack[kMost];
  int top = 0;
  stack[top++] = {roots_[tree], 0};
  const auto goes_on = [&](uint32_t run) {
    if (!visit(run)) return true;
    for (int k = 0; Region::kMoves && k < top; ++k) stack[k].key = 0;
    return region.renew();
  };
  while (top > 0) {
    const Waiting next = stack[--top];
    if (region.passes(next.key)) continue;
    if (next.id & kLeaf) {
      if (!goes_on(next.id & ~kLeaf)) return;
      continue;
    }
    const Node& node = nodes_[next.id];
    Float4 key;
    const int base = top;
    for (uint32_t met = region.meets(node, key); met != 0; met &= met - 1) {
      const int k = std::countr_zero(met);
      const uint32_t child = node.child[k];
      if (Region::kRunsAtOnce && (child & kLeaf)) {
        if (!goes_on(child & ~kLeaf)) return;
        continue;
      }
      // The nearest comes last, to be looked at first.
      int at = top++;
      for (; Region::kNearestFirst && at > base && stack[at - 1].key < key[k]; --at) stack[at] = stack[at - 1];
      stack[at] = {child, key[k]};
    }
  }
}

}  // namespace meander
