// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pool where the system has no threads, as in a browser: loops run block after block on the caller's thread, in
// the blocks and the order of thread_pool.cpp with one thread, so that the bytes are the same.
#include <algorithm>

#include "base/thread_pool.h"

namespace meander {

ThreadPool::ThreadPool(unsigned) {}

ThreadPool ThreadPool::with(const CancelToken& cancel) const {
  ThreadPool pool = *this;
  pool.cancel_ = cancel;
  return pool;
}

CancelToken ThreadPool::poll(uint32_t pieces) const { return cancel_.every(pieces); }

unsigned ThreadPool::size() const { return 1; }

bool ThreadPool::in_worker() const { return false; }

void ThreadPool::for_blocks(size_t count, size_t grain,
                            const std::function<void(size_t, size_t, size_t)>& body) {
  for (size_t block = 0; block < block_count(count, grain); ++block) {
    cancel_.now();
    body(block, block * grain, std::min(count, (block + 1) * grain));
  }
}

}  // namespace meander
