// SPDX-License-Identifier: GPL-3.0-or-later
//
// The front search against costs that are relaxed until nothing changes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/front_search.h"
#include "meshes.h"

namespace meander::test::front_search_tests {
namespace {

struct Arc {
  uint32_t from, to;
  double length;
};

struct Graph {
  std::vector<Vec2> place;
  std::vector<Arc> arcs;  // in both directions
};

/// Points of the unit square, joined at random where they are close; some are left alone.
Graph random_graph(uint64_t seed) {
  Rng rng(seed);
  Graph g;
  for (uint32_t k = 0; k < 150; ++k) g.place.push_back({rng(), rng()});
  for (uint32_t a = 0; a < g.place.size(); ++a) {
    for (uint32_t b = 0; b < a; ++b) {
      const double length = norm(g.place[a] - g.place[b]);
      if (length < 0.15 && rng() < 0.6) g.arcs.push_back({a, b, length}), g.arcs.push_back({b, a, length});
    }
  }
  return g;
}

std::vector<double> relaxed(const Graph& g, uint32_t start) {
  std::vector<double> cost(g.place.size(), std::numeric_limits<double>::infinity());
  cost[start] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (const Arc& a : g.arcs) {
      if (!(cost[a.from] + a.length < cost[a.to])) continue;
      cost[a.to] = cost[a.from] + a.length;
      changed = true;
    }
  }
  return cost;
}

template <class Nodes>
void offer_neighbours(const Graph& g, uint32_t node, FrontSearch<Nodes>& search, const auto& ahead) {
  for (const Arc& a : g.arcs) {
    if (a.from == node) search.offer(a.to, search.cost(node) + a.length, node, ahead(a.to));
  }
}

template <class Nodes>
void expect_shortest(const Graph& g, FrontSearch<Nodes> search, uint32_t start) {
  const std::vector<double> cost = relaxed(g, start);
  double passed = 0;
  search.offer(start, 0);
  while (const auto node = search.next()) {
    EXPECT_GE(search.cost(*node), passed);
    passed = search.cost(*node);
    offer_neighbours(g, *node, search, [](uint32_t) { return 0.0; });
  }
  for (uint32_t v = 0; v < cost.size(); ++v) {
    EXPECT_EQ(search.cost(v), cost[v]);
    EXPECT_EQ(search.done(v), std::isfinite(cost[v]));
    if (v != start && search.done(v)) {
      EXPECT_EQ(search.cost(search.by(v)) + norm(g.place[v] - g.place[search.by(v)]), cost[v]);
    }
  }
}

TEST(FrontSearch, FindsShortestPathsWhateverItRemembers) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const Graph g = random_graph(seed);
    expect_shortest(g, FrontSearch(AllNodes(g.place.size())), 0);
    expect_shortest(g, FrontSearch<ReachedNodes>(), 7);
  }
}

TEST(FrontSearch, ComesToItsGoalOverFewerNodesWhenItKnowsHowFarItIs) {
  size_t with = 0, without = 0;
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const Graph g = random_graph(seed);
    const uint32_t goal = 1;
    const double least = relaxed(g, 0)[goal];
    for (const bool heuristic : {false, true}) {
      FrontSearch<ReachedNodes> search;
      search.offer(0, 0);
      while (const auto node = search.next()) {
        ++(heuristic ? with : without);
        if (*node == goal) break;
        offer_neighbours(g, *node, search,
                         [&](uint32_t v) { return heuristic ? norm(g.place[v] - g.place[goal]) : 0; });
      }
      EXPECT_NEAR(search.cost(goal), least, 1e-12);
    }
  }
  EXPECT_LT(2 * with, without);
}

TEST(FrontSearch, PassesEqualCostsInTheOrderOfNumbersAndNothingTwice) {
  FrontSearch<ReachedNodes> search;
  for (const uint32_t node : {5u, 3u, 9u, 3u}) search.offer(node, 1);
  search.offer(9, 0.5);
  search.offer(3, 2);  // costs more than what is known
  std::vector<uint32_t> order;
  while (const auto node = search.next()) {
    order.push_back(*node);
    search.offer(*node, 0);
  }
  EXPECT_EQ(order, (std::vector<uint32_t>{9, 3, 5}));
  EXPECT_FALSE(search.done(4));
}

}  // namespace
}  // namespace meander::test::front_search_tests
