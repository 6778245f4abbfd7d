// SPDX-License-Identifier: GPL-3.0-or-later
//
// A team of threads for loops whose iterations write to places of their own.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace meander {

/// Threads that live as long as the team and share loops with the caller. Not copyable. One loop at
/// a time; the caller's thread is one of the team.
class Team {
 public:
  /// `threads` in all, the caller included; 0 means as many as the machine has.
  explicit Team(unsigned threads);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  unsigned size() const { return static_cast<unsigned>(workers_.size()) + 1; }

  /// Calls body(begin, end) for consecutive blocks of [0, count). Blocks depend on `count` and
  /// `grain` only, never on the number of threads, so a body that writes per index, or per block,
  /// gives the same bytes for any team. An exception of a body is thrown again here.
  void for_blocks(size_t count, size_t grain,
                  const std::function<void(size_t block, size_t begin, size_t end)>& body);

  /// Calls visit(i) for every index of [0, count) and returns the least for which it is true, `count` if
  /// there is none. What comes after such an index may be left out.
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

  static size_t block_count(size_t count, size_t grain) { return (count + grain - 1) / grain; }

 private:
  void work();
  void take_blocks();

  std::vector<std::thread> workers_;
  std::mutex mutex_;
  std::condition_variable start_, done_;
  const std::function<void(size_t, size_t, size_t)>* body_ = nullptr;
  size_t count_ = 0, grain_ = 1, next_block_ = 0;
  unsigned running_ = 0;
  unsigned long long round_ = 0;
  bool quit_ = false;
  std::exception_ptr error_;
};

}  // namespace meander
