// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory that loops hand on from one block to the next.
#pragma once

#include <utility>
#include <vector>

#include "base/lock.h"

namespace meander {

/// Hands memory on from one block of a loop to the next: as much is made as threads take part. Any thread.
template <class Memory>
class SpareMemory {
 public:
  Memory take() {
    const std::lock_guard locked(lock_);
    if (spare_.empty()) return {};
    Memory last = std::move(spare_.back());
    spare_.pop_back();
    return last;
  }
  /// It must have forgotten what it knows.
  void give_back(Memory memory) {
    const std::lock_guard locked(lock_);
    spare_.push_back(std::move(memory));
  }

 private:
  Lock lock_;
  std::vector<Memory> spare_;
};

}  // namespace meander
