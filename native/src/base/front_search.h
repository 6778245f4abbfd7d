// SPDX-License-Identifier: GPL-3.0-or-later
//
// The search for shortest paths from node to node: Dijkstra's, and A* where the caller knows how far the goal is
// at least.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

namespace meander {

/// What a search knows of a node.
struct Reached {
  double cost = std::numeric_limits<double>::infinity();  ///< of the cheapest path so far
  uint32_t by = UINT32_MAX;                               ///< what the caller gave with that path
  bool done = false;                                      ///< whether the front has passed
};

/// What is known of all nodes of a graph: for searches that come to most of them.
class AllNodes {
 public:
  explicit AllNodes(size_t count) : nodes_(count) {}
  Reached& operator[](uint32_t node) { return nodes_[node]; }
  const Reached& at(uint32_t node) const { return nodes_[node]; }

 private:
  std::vector<Reached> nodes_;
};

/// What is known of the nodes that a search has come to: for searches that stay in a small part of the graph.
class ReachedNodes {
 public:
  Reached& operator[](uint32_t node) { return nodes_[node]; }
  Reached at(uint32_t node) const {
    const auto found = nodes_.find(node);
    return found == nodes_.end() ? Reached() : found->second;
  }

 private:
  std::unordered_map<uint32_t, Reached> nodes_;
};

/// A front that starts at the nodes that are offered first and passes one node after another, in the order of
/// their costs; of equal ones the lowest number first. The caller knows the graph: it offers the neighbours
/// of every node that comes up, until the goal comes up.
///
///     search.offer(start, 0);
///     while (const auto node = search.next()) {
///       if (*node == goal) break;
///       for (neighbour) search.offer(neighbour, search.cost(*node) + length, *node);
///     }
///
/// One thread at a time. Source: Hart, Nilsson and Raphael, "A Formal Basis for the Heuristic Determination of
/// Minimum Cost Paths" (1968); no node comes up twice, so what is `ahead` has to be consistent for exact results.
template <class Nodes>
class FrontSearch {
 public:
  explicit FrontSearch(Nodes nodes = Nodes()) : nodes_(std::move(nodes)) {}

  /// A path of this cost to a node; costs are finite. `by` tells the caller later where it came from. `ahead` is
  /// what it costs at least from there to the goal. Nothing happens where a path is known that costs no more.
  void offer(uint32_t node, double cost, uint32_t by = UINT32_MAX, double ahead = 0) {
    Reached& known = nodes_[node];
    if (known.done || !(cost < known.cost)) return;
    known.cost = cost;
    known.by = by;
    queue_.push({cost + ahead, node});
  }

  /// The node that the front passes next: its cost is final. Nothing when no offered node is left.
  std::optional<uint32_t> next() {
    while (!queue_.empty()) {
      const uint32_t node = queue_.top().second;
      queue_.pop();
      Reached& known = nodes_[node];
      if (known.done) continue;  // passed when it was cheaper
      known.done = true;
      return node;
    }
    return std::nullopt;
  }

  double cost(uint32_t node) const { return nodes_.at(node).cost; }
  uint32_t by(uint32_t node) const { return nodes_.at(node).by; }
  bool done(uint32_t node) const { return nodes_.at(node).done; }

 private:
  using Entry = std::pair<double, uint32_t>;

  Nodes nodes_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace meander
