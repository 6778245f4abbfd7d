// SPDX-License-Identifier: GPL-3.0-or-later
//
// The thread pool: every block runs once, the same blocks for any number of threads, exceptions are
// passed on, and nothing waits for a thread that is held up.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

#include "base/thread_pool.h"

namespace meander::test::thread_pool_tests {
namespace {

class ThreadPoolOf : public testing::TestWithParam<unsigned> {};

TEST_P(ThreadPoolOf, RunsEveryBlockOnceWithTheSameBounds) {
  ThreadPool pool(GetParam());
  for (const size_t count : {size_t{0}, size_t{1}, size_t{7}, size_t{8}, size_t{9}, size_t{1000}}) {
    for (const size_t grain : {size_t{1}, size_t{8}, size_t{2000}}) {
      const size_t blocks = ThreadPool::block_count(count, grain);
      std::vector<std::atomic<int>> calls(blocks), visits(count);
      std::vector<std::pair<size_t, size_t>> bounds(blocks);
      pool.for_blocks(count, grain, [&](size_t block, size_t begin, size_t end) {
        ASSERT_LT(block, blocks);
        ++calls[block];
        bounds[block] = {begin, end};
        for (size_t i = begin; i < end; ++i) ++visits[i];
      });
      for (size_t b = 0; b < blocks; ++b) {
        EXPECT_EQ(calls[b], 1);
        EXPECT_EQ(bounds[b].first, b * grain);
        EXPECT_EQ(bounds[b].second, std::min(count, (b + 1) * grain));
      }
      for (const auto& v : visits) EXPECT_EQ(v, 1);
    }
  }
}

TEST_P(ThreadPoolOf, ThrowsWhatABodyThrewAndWorksAfterwards) {
  ThreadPool pool(GetParam());
  for (int round = 0; round < 20; ++round) {
    const auto body = [](size_t block, size_t, size_t) {
      if (block % 5 == 3) throw std::runtime_error("from a body");
    };
    EXPECT_THROW(pool.for_blocks(100, 3, body), std::runtime_error);
    std::atomic<size_t> sum{0};
    pool.for_blocks(100, 3, [&](size_t, size_t begin, size_t end) { sum += end - begin; });
    EXPECT_EQ(sum, 100u);
  }
}

/// Each of `rounds` loops visits every index once; `between` is called with the number of each.
template <class Between>
void expect_rounds(unsigned threads, int rounds, const Between& between) {
  ThreadPool pool(threads);
  std::vector<int> values(64, 0);
  for (int round = 0; round < rounds; ++round) {
    pool.for_blocks(values.size(), 4, [&](size_t, size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) ++values[i];
    });
    between(round);
  }
  for (const int v : values) EXPECT_EQ(v, rounds);
}

TEST_P(ThreadPoolOf, MakesManyShortRounds) {
  expect_rounds(GetParam(), 2000, [](int) {});
}

TEST_P(ThreadPoolOf, WakesUpAfterAPause) {
  expect_rounds(GetParam(), 50, [](int round) {
    std::this_thread::sleep_for(std::chrono::microseconds(40 * (round % 8)));  // some fall asleep in between
  });
}

TEST_P(ThreadPoolOf, AddsUpTheSameNumberOnAnyThreads) {
  ThreadPool pool(GetParam()), alone(1);
  for (const size_t count : {size_t{0}, size_t{3}, size_t{100'000}}) {
    const auto term = [](size_t i) { return 1 / (1.0 + static_cast<double>(i)); };
    long double exact = 0;
    for (size_t i = 0; i < count; ++i) exact += 1 / (1.0L + static_cast<long double>(i));
    EXPECT_EQ(pool.sum(count, term), alone.sum(count, term));
    EXPECT_NEAR(pool.sum(count, term), static_cast<double>(exact), 1e-12);
  }
}

TEST_P(ThreadPoolOf, TakesTheBlocksOfAThreadThatIsHeldUp) {
  constexpr size_t kBlocks = 12;
  ThreadPool pool(GetParam());
  if (pool.size() == 1) return;  // there is no other thread
  for (size_t held = 0; held < kBlocks; ++held) {
    std::atomic<size_t> others = 0;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    pool.for_blocks(kBlocks, 1, [&](size_t block, size_t, size_t) {
      if (block != held) {
        ++others;
        return;
      }
      while (others < kBlocks - 1 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
      EXPECT_EQ(others, kBlocks - 1);
    });
  }
}

/// Only the pool that is given the token stops, though both have the same threads, and the question is put on the
/// caller's thread alone.
TEST_P(ThreadPoolOf, AsksOnTheCallersThreadAlone) {
  ThreadPool pool(GetParam());
  const std::thread::id caller = std::this_thread::get_id();
  int asked = 0;
  const auto question = [&] {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    ++asked;
    return false;
  };
  ThreadPool counted = pool.with(question);
  counted.for_blocks(64, 1, [&](size_t, size_t, size_t) {
    CancelToken poll = counted.poll(1);
    for (int k = 0; k < 100; ++k) poll();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // so that no thread takes all blocks
  });
  EXPECT_GT(asked, 100);
}

TEST_P(ThreadPoolOf, StopsTheLoopsOfTheComputationThatIsCancelled) {
  ThreadPool pool(GetParam());
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<bool> flag = false;
  int asked = 0;
  const auto question = [&] {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    return ++asked > 3;
  };
  ThreadPool flagged = pool.with(flag), counted = pool.with(question);
  std::atomic<size_t> sum = 0;
  const auto body = [&](size_t, size_t begin, size_t end) { sum += end - begin; };
  flagged.for_blocks(100, 3, body);
  EXPECT_EQ(sum.exchange(0), 100u);
  flag = true;
  EXPECT_THROW(flagged.for_blocks(100, 3, body), Failure);
  EXPECT_EQ(sum, 0u);
  EXPECT_THROW(
      {
        for (int round = 0; round < 5; ++round) counted.for_blocks(4, 1, body);
      },
      Failure);
  EXPECT_EQ(asked, 4);
  sum = 0;
  pool.for_blocks(100, 3, body);
  EXPECT_EQ(sum, 100u);
}

INSTANTIATE_TEST_SUITE_P(Threads, ThreadPoolOf, testing::Values(1u, 2u, 3u, 16u));

TEST(ThreadPool, CountsTheCaller) {
  EXPECT_EQ(ThreadPool(1).size(), 1u);
  EXPECT_EQ(ThreadPool(3).size(), 3u);
  EXPECT_GE(ThreadPool(0).size(), 1u);
}

}  // namespace
}  // namespace meander::test::thread_pool_tests
