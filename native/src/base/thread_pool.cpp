// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/thread_pool.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "base/exception_memory.h"

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

/// The threads themselves.
class ThreadPool::Crew {
 public:
  explicit Crew(unsigned threads);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  unsigned size() const { return static_cast<unsigned>(workers_.size()) + 1; }
  bool has_as_worker(std::thread::id thread) const {
    return std::ranges::any_of(workers_, [&](const std::thread& worker) { return worker.get_id() == thread; });
  }
  void for_blocks(size_t count, size_t grain, const std::function<void(size_t, size_t, size_t)>& body,
                  const CancelToken& cancel);

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
  template <class Done>
  void stay_awake(const Done& done) const;

  std::vector<std::thread> workers_;
  std::vector<Share> shares_;  // one for each thread, the caller's first
  std::mutex mutex_;
  std::condition_variable start_, done_;
  // The present loop.
  const std::function<void(size_t, size_t, size_t)>* body_ = nullptr;
  const CancelToken* cancel_ = nullptr;
  size_t count_ = 0, grain_ = 1;
  std::atomic<unsigned> running_ = 0;  // threads of the pool that take blocks, not counting the caller
  std::atomic<bool> open_ = false;     // there may be blocks to take
  bool quit_ = false;
  bool stays_awake_ = false;           // for a moment, see stay_awake
  std::exception_ptr error_;
};

ThreadPool::ThreadPool(unsigned threads) : crew_(std::make_shared<Crew>(threads)) {}

ThreadPool ThreadPool::with(const CancelToken& cancel) const {
  ThreadPool pool = *this;
  pool.cancel_ = cancel;
  return pool;
}

CancelToken ThreadPool::poll(uint32_t pieces) const {
  return in_worker() ? CancelToken() : cancel_.every(pieces);
}

unsigned ThreadPool::size() const { return crew_->size(); }

bool ThreadPool::in_worker() const { return crew_->has_as_worker(std::this_thread::get_id()); }

void ThreadPool::for_blocks(size_t count, size_t grain,
                            const std::function<void(size_t, size_t, size_t)>& body) {
  crew_->for_blocks(count, grain, body, cancel_);
}

ThreadPool::Crew::Crew(unsigned threads) {
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
void ThreadPool::Crew::stay_awake(const Done& done) const {
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

ThreadPool::Crew::~Crew() {
  {
    std::lock_guard lock(mutex_);
    quit_ = true;
  }
  start_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::Crew::for_blocks(size_t count, size_t grain, const std::function<void(size_t, size_t, size_t)>& body,
                                  const CancelToken& cancel) {
  if (count == 0) return;
  if (workers_.empty() || count <= grain) {
    for (size_t b = 0; b < block_count(count, grain); ++b) {
      cancel.now();
      body(b, b * grain, std::min(count, (b + 1) * grain));
    }
    return;
  }
  cancel.now();  // other threads may take all blocks
  {
    std::lock_guard lock(mutex_);
    body_ = &body;
    cancel_ = &cancel;
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
void ThreadPool::Crew::share_out(size_t blocks) {
  const size_t threads = size();
  for (size_t k = 0; k < threads; ++k) {
    shares_[k].blocks.store(pack(blocks * k / threads, blocks * (k + 1) / threads), std::memory_order_relaxed);
  }
}

/// The blocks of the thread's own share, then those that others have left in theirs.
void ThreadPool::Crew::take_blocks(unsigned thread) {
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

void ThreadPool::Crew::do_block(unsigned thread, size_t block) {
  try {
    if (thread == 0) cancel_->now();
    (*body_)(block, block * grain_, std::min(count_, (block + 1) * grain_));
  } catch (...) {
    share_out(0);
    std::lock_guard lock(mutex_);
    if (!error_) error_ = std::current_exception();
  }
}

void ThreadPool::Crew::work(unsigned thread) {
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
