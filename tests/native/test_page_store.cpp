// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory that long lists hand on.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <random>
#include <thread>
#include <vector>

#include "base/large_pages.h"
#include "base/page_store.h"
#include "curve/node_data.h"

namespace meander::test::page_store_tests {
namespace {

constexpr size_t kMegabyte = size_t{1} << 20;

/// A block that is filled with a number of its own.
struct Block {
  uint64_t* memory;
  size_t bytes;
  uint64_t number;

  Block(size_t size, uint64_t own) : memory(static_cast<uint64_t*>(PageStore::take(size))), bytes(size), number(own) {
    std::fill_n(memory, bytes / sizeof number, number);
  }
  bool is_whole() const {
    return std::all_of(memory, memory + bytes / sizeof number, [&](uint64_t n) { return n == number; });
  }
  void give_back() const { PageStore::give_back(memory, bytes); }
};

/// Whether there is a store here, and not operator new.
bool has_store() {
  const size_t before = PageStore::figures().taken;
  const Block block(3 * kMegabyte, 1);
  const bool counted = PageStore::figures().taken > before;
  block.give_back();
  return counted;
}

/// Blocks of two threads that come and go in any order never share a byte, and leave nothing behind.
TEST(PageStore, BlocksAreApart) {
  const size_t before = PageStore::figures().taken;
  std::vector<std::thread> threads;
  std::atomic<bool> whole = true;
  for (const uint64_t seed : {1u, 2u}) {
    threads.emplace_back([seed, &whole] {
      const PageStore::Keeper keeper;
      std::mt19937_64 random(seed);
      std::vector<Block> blocks;
      for (uint64_t k = 1; k <= 200; ++k) {
        if (blocks.size() < 8 && random() % 3 != 0) {
          blocks.emplace_back(kMegabyte / 8 + random() % (4 * kMegabyte) / 8 * 8, 1000 * seed + k);
          if (reinterpret_cast<uintptr_t>(blocks.back().memory) % 64 != 0) whole = false;
        } else if (!blocks.empty()) {
          const size_t at = random() % blocks.size();
          if (!blocks[at].is_whole()) whole = false;
          blocks[at].give_back();
          blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(at));
        }
      }
      for (const Block& block : blocks) {
        if (!block.is_whole()) whole = false;
        block.give_back();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(whole);
  EXPECT_EQ(PageStore::figures().taken, before);
  EXPECT_EQ(PageStore::figures().free, 0u);
}

/// What one list hands on the next one takes, also of two that lay side by side, while somebody keeps it.
TEST(PageStore, MemoryIsHandedOn) {
  if (!has_store()) GTEST_SKIP() << "no store on this system";
  {
    const PageStore::Keeper keeper;
    Table<double> a(kMegabyte), b(kMegabyte), after(kMegabyte);  // 8 MB each
    EXPECT_EQ(PageStore::figures().free, 0u);
    hand_on(a, b);
    EXPECT_TRUE(a.empty());
    const size_t both = PageStore::figures().free;
    EXPECT_EQ(both, 16 * kMegabyte);
    const Table<double> larger(2 * kMegabyte);
    // In the place of both, or, where the system put them apart, in that of pages that went back to it.
    EXPECT_EQ(PageStore::figures().free, 0u);
  }
  EXPECT_EQ(PageStore::figures().free, 0u);
}

/// Where no free block is long enough, new pages take the place of free ones: they never come to more than the most
/// that was taken at once, and what rounding to large pages adds.
TEST(PageStore, FreeBlocksMakeRoom) {
  if (!has_store()) GTEST_SKIP() << "no store on this system";
  const PageStore::Keeper keeper;
  std::mt19937_64 random(7);
  std::vector<Block> blocks;
  const size_t others = PageStore::figures().taken;
  size_t most = 0;
  for (uint64_t k = 1; k <= 300; ++k) {
    if (blocks.size() < 6 && random() % 2 == 0) {
      blocks.emplace_back(kMegabyte + random() % (6 * kMegabyte) / 8 * 8, k);
    } else if (!blocks.empty()) {
      blocks.back().give_back();
      blocks.pop_back();
    }
    const PageStore::Figures now = PageStore::figures();
    most = std::max(most, now.taken - others);
    EXPECT_LE(now.taken - others + now.free, most + 8 * kMegabyte) << k;
  }
  for (const Block& block : blocks) block.give_back();
  PageStore::trim();
  EXPECT_EQ(PageStore::figures().free, 0u);
}

/// Short lists keep their memory: to ask for it again costs more.
TEST(PageStore, ShortListsKeepTheirs) {
  NodeData<double> few(100, 1.5);
  const double* const there = few.data();
  hand_on(few);
  EXPECT_EQ(few.size(), 100u);
  EXPECT_EQ(few.data(), there);
}

}  // namespace
}  // namespace meander::test::page_store_tests
