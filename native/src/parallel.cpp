// SPDX-License-Identifier: GPL-3.0-or-later
#include "parallel.h"

#include <algorithm>

namespace meander {

Team::Team(unsigned threads) {
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  workers_.reserve(threads - 1);  // so that nothing but a thread can fail below
  try {
    for (unsigned k = 1; k < threads; ++k) workers_.emplace_back([this] { work(); });
  } catch (const std::system_error&) {
    // The machine gives no more threads; the result is the same with fewer.
  }
}

Team::~Team() {
  {
    std::lock_guard lock(mutex_);
    quit_ = true;
  }
  start_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void Team::for_blocks(size_t count, size_t grain,
                      const std::function<void(size_t, size_t, size_t)>& body) {
  if (count == 0) return;
  if (workers_.empty() || count <= grain) {
    for (size_t b = 0; b < block_count(count, grain); ++b) {
      body(b, b * grain, std::min(count, (b + 1) * grain));
    }
    return;
  }
  {
    std::lock_guard lock(mutex_);
    body_ = &body;
    count_ = count;
    grain_ = grain;
    next_block_ = 0;
    running_ = static_cast<unsigned>(workers_.size());
    error_ = nullptr;
    ++round_;
  }
  start_.notify_all();
  take_blocks();
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return running_ == 0; });
  body_ = nullptr;
  if (error_) std::rethrow_exception(error_);
}

void Team::take_blocks() {
  for (;;) {
    size_t block;
    {
      std::lock_guard lock(mutex_);
      if (error_ || next_block_ >= block_count(count_, grain_)) return;
      block = next_block_++;
    }
    try {
      (*body_)(block, block * grain_, std::min(count_, (block + 1) * grain_));
    } catch (...) {
      std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
    }
  }
}

void Team::work() {
  unsigned long long seen = 0;
  std::unique_lock lock(mutex_);
  for (;;) {
    start_.wait(lock, [&] { return quit_ || round_ != seen; });
    if (quit_) return;
    seen = round_;
    lock.unlock();
    take_blocks();
    lock.lock();
    if (--running_ == 0) done_.notify_one();
  }
}

}  // namespace meander
