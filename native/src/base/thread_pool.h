// SPDX-License-Identifier: GPL-3.0-or-later
//
// A pool of threads for loops whose iterations do not write to the same places.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <numeric>
#include <thread>
#include <vector>

#include "base/cancel_poll.h"

namespace meander {

/// What a thread takes at a time of loops that do little for each node, or for each face or vertex.
inline constexpr size_t kNodeGrain = 2048;
inline constexpr size_t kMeshGrain = 4096;

/// Threads that live as long as the pool and share loops with the caller. Not copyable. One loop at
/// a time; the caller's thread is one of the pool.
///
/// Every thread starts with a share of its own, the same part of every loop, so that what it wrote in one loop
/// is still in its caches in the next. A thread that has finished its share takes blocks from the end of
/// another's. Between two loops threads stay awake for a moment, unless the pool has more of them than the
/// machine, and a loop does not wait for a thread that wakes up when nothing is left to do: loops here take
/// tens of microseconds, about as long as waking a thread.
class ThreadPool {
 public:
  /// `threads` in all, the caller included; 0 means as many as the machine has.
  explicit ThreadPool(unsigned threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// While it lives, loops of the pool end with Failure(FailureKind::kCancelled) where `cancelled` says so, which is
  /// asked before every loop and before every block that the caller's thread takes, and on that thread only. What a
  /// loop has written by then stays. The question must outlive it; an empty one is never asked. Watches nest; the inner
  /// one is asked.
  class Watch {
   public:
    Watch(ThreadPool& pool, const std::function<bool()>& cancelled) : pool_(pool), outer_(pool.cancelled_) {
      pool.cancelled_ = cancelled ? &cancelled : nullptr;
    }
    ~Watch() { pool_.cancelled_ = outer_; }
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

   private:
    ThreadPool& pool_;
    const std::function<bool()>* outer_;
  };

  /// Asks what the present watch asks, for work of the caller's thread that is no loop of the pool. It must not outlive
  /// the watch.
  CancelPoll poll(uint32_t pieces) const { return cancelled_ ? CancelPoll(*cancelled_, pieces) : CancelPoll(); }

  unsigned size() const { return static_cast<unsigned>(workers_.size()) + 1; }

  /// Calls body(begin, end) for consecutive blocks of [0, count). Blocks depend on `count` and
  /// `grain` only, never on the number of threads, so a body that writes per index, or per block,
  /// gives the same bytes for any pool. An exception of a body is thrown again here, and so is a cancel, see Watch.
  void for_blocks(size_t count, size_t grain,
                  const std::function<void(size_t block, size_t begin, size_t end)>& body);

  /// Calls visit(i) for the indices of [0, count) and returns the lowest for which it is true, `count` if there
  /// is none. Indices after one that is true may not be visited.
  template <class Visit>
  size_t first(size_t count, size_t grain, const Visit& visit) {
    std::vector<size_t> found(block_count(count, grain), count);
    for_blocks(count, grain, [&](size_t block, size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        if (!visit(i)) continue;
        found[block] = i;
        break;
      }
    });
    for (const size_t i : found) {
      if (i < count) return i;
    }
    return count;
  }

  /// The sum of term(i) over [0, count), added up in the same order whatever the number of threads.
  template <class Term>
  double sum(size_t count, const Term& term) {
    constexpr size_t kTerms = 2048;
    std::vector<double> sums(block_count(count, kTerms), 0);
    for_blocks(count, kTerms, [&](size_t block, size_t begin, size_t end) {
      double sum = 0;
      for (size_t i = begin; i < end; ++i) sum += term(i);
      sums[block] = sum;
    });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
  }

  static size_t block_count(size_t count, size_t grain) { return (count + grain - 1) / grain; }

 private:
  /// Blocks [begin, end) that no thread has taken yet, both numbers in one word, so that the owner can take the
  /// first block and other threads the last. Each share has a cache line of its own, since it is written
  /// whenever a block is taken.
  struct alignas(64) Share {
    std::atomic<uint64_t> blocks = 0;
  };

  void work(unsigned thread);
  void share_out(size_t blocks);
  void take_blocks(unsigned thread);
  void do_block(unsigned thread, size_t block);
  void heed_cancel() const;
  template <class Done>
  void stay_awake(const Done& done) const;

  std::vector<std::thread> workers_;
  std::vector<Share> shares_;  // one for each thread, the caller's first
  std::mutex mutex_;
  std::condition_variable start_, done_;
  const std::function<void(size_t, size_t, size_t)>* body_ = nullptr;
  size_t count_ = 0, grain_ = 1;
  std::atomic<unsigned> running_ = 0;  // threads of the pool that take blocks, not counting the caller
  std::atomic<bool> open_ = false;     // there may be blocks to take
  bool quit_ = false;
  bool stays_awake_ = false;           // for a moment, see stay_awake
  std::exception_ptr error_;
  const std::function<bool()>* cancelled_ = nullptr;  // of the present watch
};

}  // namespace meander
