// SPDX-License-Identifier: GPL-3.0-or-later
//
// Levels of rows that are joined: a hub with thousands of spokes takes as few of them as a chain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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
  ThreadPool pool(2);
  EXPECT_EQ(pairs.joined(rows, pool).size(), 1u);
  const Vec2 hub{0.6, 0.8};
  for (uint32_t i = 0; i < rows.size(); ++i) {
    for (uint32_t e = rows.start[i]; e < rows.start[i + 1]; ++e) {
      const Vec2 taken = rows.weight[e] * (pairs.carry[rows.neighbour[e]] * hub);
      EXPECT_NEAR(norm(pairs.carry[i] * hub - taken), 0, 1e-12) << i;
    }
  }
}

TEST(Aggregates, AreTheSameForAnyNumberOfThreads) {
  // A grid that is wrapped round, whose weights all differ; more pairs than a thread takes at a time.
  constexpr uint32_t kSide = 160, kRows = kSide * kSide;
  const auto weight = [](uint32_t a, uint32_t b) {
    const double turn = 0.001 * (a + b) * (a < b ? 1 : -1);
    return (1 + 0.5 * std::sin(3.0 * (a + b))) * Vec2{std::cos(turn), std::sin(turn)};
  };
  const auto fill = [&](uint32_t begin, uint32_t end, Couplings<Vec2>& rows) {
    for (uint32_t i = begin; i < end; ++i) {
      for (const uint32_t step : {1u, kSide, kRows - 1, kRows - kSide}) {
        rows.add((i + step) % kRows, weight(i, (i + step) % kRows));
      }
      rows.end_row();
    }
  };
  Couplings<Vec2> whole;
  fill(0, kRows, whole);
  CancelToken poll;
  const Pairs<Vec2> pairs(whole, poll);
  ASSERT_GT(pairs.count, 2 * kMeshGrain);
  const auto same = [](const Couplings<Vec2>& a, const Couplings<Vec2>& b) {
    const auto alike = [](Vec2 p, Vec2 q) { return p.x == q.x && p.y == q.y; };
    return a.start == b.start && a.neighbour == b.neighbour && std::ranges::equal(a.weight, b.weight, alike);
  };
  ThreadPool one(1), three(3);
  EXPECT_TRUE(same(Couplings<Vec2>::in_blocks(kRows, one, fill), whole));
  EXPECT_TRUE(same(Couplings<Vec2>::in_blocks(kRows, three, fill), whole));
  const Couplings<Vec2> coarse = pairs.joined(whole, one);
  EXPECT_EQ(coarse.size(), pairs.count);
  EXPECT_TRUE(same(pairs.joined(whole, three), coarse));
  // What flows between two pairs is what flows between their rows.
  double fine_sum = 0, coarse_sum = 0;
  for (uint32_t i = 0; i < kRows; ++i) {
    for (uint32_t e = whole.start[i]; e < whole.start[i + 1]; ++e) {
      const uint32_t other = whole.neighbour[e];
      if (pairs.of[i] != pairs.of[other]) fine_sum += (conj(pairs.carry[i]) * whole.weight[e] * pairs.carry[other]).x;
    }
  }
  for (const Vec2& w : coarse.weight) coarse_sum += w.x;
  EXPECT_NEAR(coarse_sum, fine_sum, 1e-9 * kRows);
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
  EXPECT_EQ(pairs.of, (Table<uint32_t>{0, 0, 1, 1, 2, 2, 3, 3}));
  ThreadPool pool(1);
  const Couplings<double> coarse = pairs.joined(rows, pool);
  EXPECT_EQ(coarse.neighbour, (Table<uint32_t>{1, 0, 2, 1, 3, 2}));
  EXPECT_EQ(coarse.weight, Table<double>(6, 1.0));
}

}  // namespace
}  // namespace meander::test::aggregates_tests
