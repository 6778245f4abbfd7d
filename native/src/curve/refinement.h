// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keeps segments between h and 2 h (section 3.3.2).
#pragma once

#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "curve/crossings.h"
#include "curve/curve.h"
#include "curve/node_data.h"

namespace meander {

/// Keeps its memory from call to call. One call at a time.
class Refinement {
 public:
  /// `test`  whose memory is used; nobody else uses it during a call
  explicit Refinement(std::shared_ptr<CrossingTest> test = std::make_shared<CrossingTest>()) : test_(std::move(test)) {}

  /// A strand may turn as sharply as it likes.
  static constexpr double kAnyTurn = std::numeric_limits<double>::infinity();

  /// Splits segments longer than 2 h into equal parts on their own path, and removes a node where a
  /// segment is shorter than h and the one that replaces it and its neighbour stays within 2 h, so
  /// that a split and a collapse never undo each other. Fixed nodes, the ends of open strands, and at
  /// least 3 nodes of a closed strand (2 of an open one) stay. A change that would make segments
  /// cross is not made. False if the curve stays as it is; so it does where this throws.
  ///
  /// A node where a strand doubles back, by more than `most_turn`, goes as well, whatever its segments measure.
  /// What replaces them runs straight past where it was, so a split of that does not bring it back.
  ///
  /// `target`     h at every node
  /// `most_turn`  in radians, at least pi / 2
  /// `origin`     where something changed, receives for every node of the new curve the old node it was, or, if new,
  ///              the old node before it
  bool refine(const Surface& surface, Curve& curve, const NodeData<double>& target, ThreadPool& pool,
              NodeData<uint32_t>& origin, double most_turn = kAnyTurn);

  /// Hands the memory of a call on.
  void hand_on() noexcept;

 private:
  /// What replaces segment `from`; where the node after it goes, that one and the next.
  struct Change {
    uint32_t from;
    uint32_t parts;     // 1 where a node goes
    uint32_t slot;      // of the first new segment in new_*_
    uint32_t segments;  // new ones: `parts`, or fewer where a cut came to lie on an end

    uint32_t removed() const { return parts == 1; }
    uint32_t added() const { return segments - 1; }
  };
  bool removes_next(const Curve& curve, const NodeData<double>& target, uint32_t i) const;
  uint32_t parts_of(const Curve& curve, const NodeData<double>& target, uint32_t i) const;
  void choose(const Curve& curve, const NodeData<double>& target, ThreadPool& pool);
  void make(const Surface& surface, const Curve& curve, Change& change, PathShortener& shortener);
  uint32_t find_places(const Curve& curve);
  void put_node(uint32_t place, const SurfacePoint& node, uint8_t fixed, uint32_t origin);
  void put_change(const Curve& curve, const Change& change, uint32_t place);
  void put_block(const Curve& curve, uint32_t begin, uint32_t end);
  void lay_out(const Curve& curve, ThreadPool& pool);
  bool propose(const Surface& surface, const Curve& curve, const NodeData<double>& target, ThreadPool& pool);
  void accept(Curve& curve, const ThreadPool& pool);

  double least_cosine_ = -2;  // of the turn at a node that stays
  std::shared_ptr<CrossingTest> test_;
  Curve next_;
  std::vector<Change> changes_;            // along the curve
  std::vector<uint32_t> places_;           // per change: of the node `from` in the new curve
  std::vector<SurfacePoint> new_nodes_;    // per new segment: where it begins
  std::vector<Path> new_paths_;            // kept from call to call, for their memory
  std::vector<PathShape> new_shapes_;
  std::vector<std::vector<uint32_t>> candidates_;  // by blocks of nodes
  NodeData<uint32_t> origin_;              // of the new curve
  Table<uint32_t> source_;           // per new segment that is changed: its slot
  Table<uint8_t> changed_;           // per new segment
  Table<uint8_t> may_split_, may_remove_;  // per old segment, per old node
};

}  // namespace meander
