// SPDX-License-Identifier: GPL-3.0-or-later
//
// Levels of rows that are joined: a hub with thousands of spokes takes as few of them as a chain.
#include <gtest/gtest.h>

#include "mesh/aggregates.h"

namespace meander::test::aggregates_tests {
namespace {

/// A hub, row 0, with spokes; a spoke's value is the hub's, turned by a quarter and mirrored in turns.
Couplings<Mirroring> wheel(uint32_t spokes) {
  const auto to_spoke = [](uint32_t i) {
    return i % 2 == 0 ? Mirroring{{0, 1}, {}} : Mirroring{{}, {0, 1}};
  };
  Couplings<Mirroring> rows;
  for (uint32_t i = 1; i <= spokes; ++i) rows.add(i, conj(to_spoke(i)));
  rows.end_row();
  for (uint32_t i = 1; i <= spokes; ++i) {
    rows.add(0, to_spoke(i));
    rows.end_row();
  }
  return rows;
}

TEST(Aggregates, SpokesJoinTheirHubAtOnce) {
  CancelToken poll;
  const Couplings<Mirroring> rows = wheel(5000);
  const Pairs<Mirroring> pairs(rows, poll);
  EXPECT_EQ(pairs.count, 1u);
  EXPECT_EQ(pairs.joined(rows, poll).size(), 1u);
  const Vec2 hub{0.6, 0.8};
  for (uint32_t i = 0; i < rows.size(); ++i) {
    for (uint32_t e = rows.start[i]; e < rows.start[i + 1]; ++e) {
      const Vec2 taken = rows.weight[e].of(pairs.carry[rows.neighbour[e]].of(hub));
      EXPECT_NEAR(norm(pairs.carry[i].of(hub) - taken), 0, 1e-12) << i;
    }
  }
}

TEST(Aggregates, AChainIsJoinedInPairs) {
  CancelToken poll;
  Couplings<double> rows;
  for (uint32_t i = 0; i < 8; ++i) {
    if (i > 0) rows.add(i - 1, 1.0);
    if (i < 7) rows.add(i + 1, 1.0);
    rows.end_row();
  }
  const Pairs<double> pairs(rows, poll);
  EXPECT_EQ(pairs.of, (std::vector<uint32_t>{0, 0, 1, 1, 2, 2, 3, 3}));
  const Couplings<double> coarse = pairs.joined(rows, poll);
  EXPECT_EQ(coarse.neighbour, (std::vector<uint32_t>{1, 0, 2, 1, 3, 2}));
  EXPECT_EQ(coarse.weight, std::vector<double>(6, 1.0));
}

}  // namespace
}  // namespace meander::test::aggregates_tests
