// SPDX-License-Identifier: GPL-3.0-or-later
//
// Walks round trees of lines: which edges a curve runs along, and where its nodes are placed beside them.
#pragma once

#include <span>
#include <vector>

#include "base/cancel_token.h"
#include "seed/line_network.h"

namespace meander {

/// A trunk: nodes of the network in the order of a strand, each joined to the next by an edge.
struct Trunk {
  std::vector<uint32_t> nodes;
  std::vector<uint8_t> fixed;  ///< per node: the curve keeps it
  bool closed = false;
};

/// Half-edge 2 e runs along edge e of a network, 2 e + 1 the other way.
using Way = uint32_t;

/// On which side of a tree a curve walks: the sign of angles there.
using Hand = double;
inline constexpr Hand kLeft = 1, kRight = -1;

/// The edges around the nodes of a network.
class Ways {
 public:
  explicit Ways(const LineNetwork& network);

  static Way twin(Way w) { return w ^ 1u; }
  const LineNetwork::Edge& edge(Way w) const { return network_.edges()[w / 2]; }
  uint32_t from(Way w) const { return w % 2 == 0 ? edge(w).from : edge(w).to; }
  uint32_t to(Way w) const { return from(twin(w)); }
  double length(Way w) const { return edge(w).shape.length; }
  /// Unit, in the plane of the node that it leaves.
  Vec2 leaving(Way w) const { return w % 2 == 0 ? edge(w).shape.leaving : -edge(w).shape.arriving; }
  bool any_at(uint32_t node) const { return first_[node] < first_[node + 1]; }
  Way first_at(uint32_t node) const { return around_[first_[node]]; }
  Way between(uint32_t from, uint32_t to) const;

  /// The way on along the left side of the tree: the first one clockwise from where `w` came from; and along the right.
  Way next(Way w, Hand hand) const;

  /// All ways from a node.
  std::span<const Way> from_node(uint32_t v) const {
    return std::span(around_).subspan(first_[v], first_[v + 1] - first_[v]);
  }

  /// Appends the crossings of a way.
  void append_to(Path& path, Way w) const;

 private:
  const LineNetwork& network_;
  std::vector<uint32_t> first_;  // per node, in around_
  std::vector<Way> around_;      // counterclockwise
  std::vector<uint32_t> place_;  // of every way in around_
};

/// Where a walk may turn: after each of its ways.
struct WalkCorner {
  enum Kind { kRound, kOnTrunk, kFromTrunk, kToTrunk, kEnd } kind;
  Hand hand;
  bool stays = false;  ///< on a trunk: whatever is near
  uint8_t fixed = 0;
  double share = 1;    ///< of the offset, at which its stops are
};

/// A node of a curve, and where it comes in the walk.
struct Stop {
  uint32_t node;      ///< of the network, that it is placed from,
  Vec2 direction;     ///< in this direction, unit,
  double reach;       ///< at this distance
  size_t after;       ///< the number of ways of the walk before it
  uint8_t fixed;
  uint8_t number;     ///< among those of its corner, below kMostStops

  static constexpr size_t kMostStops = 3;
};

/// A walk round a tree, or along a trunk and round what leaves it. An open one begins with a stop before its first way,
/// at the first node of its trunk. What leaves the ends of that it walks round before and after.
struct Walk {
  bool closed = true;
  bool on_trunk = false;
  uint8_t begins_fixed = 0;  ///< an open one
  std::vector<Way> ways;
  std::vector<WalkCorner> corners;  ///< after each way

  static Walk round_tree(const Ways& ways, uint32_t root, CancelToken& poll);
  static Walk along_trunk(const Ways& ways, const Trunk& trunk, CancelToken& poll);
};

/// Where the curve of a walk has its nodes, `offset` local radii from the tree times the share of their corners. Beside
/// a narrow corner, and where a trunk is left, those are missing that would be in the way.
std::vector<Stop> stops_of(const Walk& walk, const LineNetwork& network, const Ways& ways, double offset);

}  // namespace meander
