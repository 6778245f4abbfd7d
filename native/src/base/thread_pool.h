// SPDX-License-Identifier: GPL-3.0-or-later
//
// A pool of threads for loops whose iterations do not write to the same places.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <numeric>
#include <vector>

#include "base/cancel_token.h"

namespace meander {

/// What a thread takes at a time of loops that do little for each node, or for each face or vertex.
inline constexpr size_t kNodeGrain = 2048;
inline constexpr size_t kMeshGrain = 4096;

/// Threads that share loops with the caller, and what ends those loops. A small value: copies have the same threads,
/// which live as long as the last of them. One loop at a time; the caller's thread is one of the pool.
///
/// Every thread starts with a share of its own, the same part of every loop, so that what it wrote in one loop
/// is still in its caches in the next. A thread that has finished its share takes blocks from the end of
/// another's. Between two loops threads stay awake for a moment, unless the pool has more of them than the
/// machine, and a loop does not wait for a thread that wakes up when nothing is left to do: loops here take
/// tens of microseconds, about as long as waking a thread.
class ThreadPool {
 public:
  /// `threads` in all, the caller included; 0 means as many as the machine has. Nothing ends its loops.
  explicit ThreadPool(unsigned threads);

  /// The same threads for a computation that `cancel` may stop: loops end with Failure(FailureKind::kCancelled) then.
  /// What they have written by then stays.
  ThreadPool with(const CancelToken& cancel) const;

  /// What stops the loops, for work that is no loop of the pool, or in a block that takes long. Only the caller's
  /// thread may ask, so that what another thread of the pool gets never stops anything.
  CancelToken poll(uint32_t pieces) const;

  unsigned size() const;

  /// Whether the calling thread is one of the pool, but not that of its caller.
  bool in_worker() const;

  /// Calls body(begin, end) for consecutive blocks of [0, count). Blocks depend on `count` and
  /// `grain` only, never on the number of threads, so a body that writes per index, or per block,
  /// gives the same bytes for any pool. An exception of a body is thrown again here, and so is a cancel.
  void for_blocks(size_t count, size_t grain,
                  const std::function<void(size_t block, size_t begin, size_t end)>& body);

  /// Calls visit(i) for every index of [0, count), which is below 2^32; `grain` indices are a block.
  template <class Visit>
  void for_each(size_t count, size_t grain, const Visit& visit) {
    for_blocks(count, grain, [&](size_t, size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) visit(static_cast<uint32_t>(i));
    });
  }

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
  class Crew;

  std::shared_ptr<Crew> crew_;
  CancelToken cancel_;
};

}  // namespace meander
