// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/thread_pool.h"

#include <algorithm>
#include <chrono>

#include "base/exception_memory.h"
#include "base/failure.h"

namespace meander {
namespace {

/// The loops of a flow mostly follow one another within less than this; putting a thread to sleep and waking it
/// takes a good part of it.
constexpr std::chrono::microseconds kMoment{50};

uint64_t pack(size_t first, size_t end) { return uint64_t{first} << 32 | end; }
size_t first_of(uint64_t blocks) { return blocks >> 32; }
size_t end_of(uint64_t blocks) { return static_cast<uint32_t>(blocks); }

/// Tells the processor that the thread only waits.
void relax() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

}  // namespace

ThreadPool::ThreadPool(unsigned threads) {
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  stays_awake_ = threads > 1 && threads <= std::thread::hardware_concurrency();
  shares_ = std::vector<Share>(threads);
  workers_.reserve(threads - 1);  // so that below a thread either is there or has not begun
  try {
    for (unsigned k = 1; k < threads; ++k) workers_.emplace_back([this, k] { work(k); });
  } catch (const std::exception&) {
    // The machine gives no more threads, or no memory for them; the result is the same with fewer.
  }
}

/// Waits for `done` without going to sleep, but not for long, and not at all where other threads of the
/// pool may need the processor.
template <class Done>
void ThreadPool::stay_awake(const Done& done) const {
  if (!stays_awake_) return;
  const auto until = std::chrono::steady_clock::now() + kMoment;
  constexpr int kSpins = 32;  // between two readings of the clock
  do {
    for (int k = 0; k < kSpins; ++k) {
      if (done()) return;
      relax();
    }
  } while (std::chrono::steady_clock::now() < until);
}

ThreadPool::~ThreadPool() {
  {
    std::lock_guard lock(mutex_);
    quit_ = true;
  }
  start_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::for_blocks(size_t count, size_t grain,
                      const std::function<void(size_t, size_t, size_t)>& body) {
  if (count == 0) return;
  if (workers_.empty() || count <= grain) {
    for (size_t b = 0; b < block_count(count, grain); ++b) {
      heed_cancel();
      body(b, b * grain, std::min(count, (b + 1) * grain));
    }
    return;
  }
  heed_cancel();  // other threads may take all blocks
  {
    std::lock_guard lock(mutex_);
    body_ = &body;
    count_ = count;
    grain_ = grain;
    share_out(block_count(count, grain));
    error_ = nullptr;
    open_ = true;
  }
  start_.notify_all();
  take_blocks(0);
  stay_awake([this] { return running_ == 0; });
  // No need to wait for a thread that has not woken up by now: nothing is left to do.
  std::unique_lock lock(mutex_);
  open_ = false;
  done_.wait(lock, [this] { return running_ == 0; });
  if (error_) std::rethrow_exception(error_);
}

/// A part of the blocks for each thread, in the order of the threads.
void ThreadPool::share_out(size_t blocks) {
  const size_t threads = size();
  for (size_t k = 0; k < threads; ++k) {
    shares_[k].blocks.store(pack(blocks * k / threads, blocks * (k + 1) / threads), std::memory_order_relaxed);
  }
}

/// The blocks of the thread's own share, then those that others have left in theirs.
void ThreadPool::take_blocks(unsigned thread) {
  for (unsigned k = 0; k < size(); ++k) {
    std::atomic<uint64_t>& share = shares_[(thread + k) % size()].blocks;
    uint64_t blocks = share.load(std::memory_order_relaxed);
    while (first_of(blocks) < end_of(blocks)) {
      const bool own = k == 0;
      const size_t block = own ? first_of(blocks) : end_of(blocks) - 1;
      const uint64_t rest = own ? pack(block + 1, end_of(blocks)) : pack(first_of(blocks), block);
      if (!share.compare_exchange_weak(blocks, rest, std::memory_order_relaxed)) continue;
      do_block(thread, block);
      blocks = share.load(std::memory_order_relaxed);
    }
  }
}

void ThreadPool::heed_cancel() const {
  if (cancelled_ && (*cancelled_)()) throw Failure(FailureKind::kCancelled, "The computation was cancelled.");
}

void ThreadPool::do_block(unsigned thread, size_t block) {
  try {
    if (thread == 0) heed_cancel();
    (*body_)(block, block * grain_, std::min(count_, (block + 1) * grain_));
  } catch (...) {
    share_out(0);
    std::lock_guard lock(mutex_);
    if (!error_) error_ = std::current_exception();
  }
}

void ThreadPool::work(unsigned thread) {
  if (!can_throw()) return;  // the others do its share
  std::unique_lock lock(mutex_);
  for (;;) {
    lock.unlock();
    stay_awake([this] { return open_.load(); });
    lock.lock();
    start_.wait(lock, [&] { return quit_ || open_; });
    if (quit_) return;
    ++running_;
    lock.unlock();
    take_blocks(thread);
    lock.lock();
    open_ = false;
    if (--running_ == 0) done_.notify_one();
  }
}

}  // namespace meander
