// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/page_store.h"

#include <new>

#if defined(__SANITIZE_ADDRESS__)
#define MEANDER_WATCHED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define MEANDER_WATCHED 1
#endif
#endif

#if defined(__linux__) && !defined(MEANDER_WATCHED)
#define MEANDER_HAS_PAGES 1
#include <malloc.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <mutex>

#include "base/constants.h"
#include "base/lock.h"
#endif

namespace meander {

#if defined(MEANDER_HAS_PAGES)

namespace {

/// What blocks are a multiple of.
constexpr size_t kBlockGrain = size_t{1} << 16;

size_t rounded_up(size_t bytes, size_t grain) { return (bytes + grain - 1) / grain * grain; }

/// A free block says in its first bytes how long it is, and which one is next.
struct FreeBlock {
  size_t size;
  FreeBlock* next;

  char* end() { return reinterpret_cast<char*>(this) + size; }
};

/// New pages, at `wanted` if nothing is there; null if the system has none.
char* map_near(char* wanted, size_t size) {
  void* const found = mmap(wanted, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return found == MAP_FAILED ? nullptr : static_cast<char*>(found);
}

/// Maps `size` bytes, a multiple of a large page, from the beginning of one on: right before `next` where that is free,
/// so that blocks of both can be joined.
void* map_pages(size_t size, char* next) {
  if (reinterpret_cast<uintptr_t>(next) > size) {
    char* const wanted = next - size;
    char* const found = map_near(wanted, size);
    if (found == wanted) return found;
    if (found) munmap(found, size);
  }
  const size_t room = size + kLargePage;
  char* const all = map_near(nullptr, room);
  if (!all) throw std::bad_alloc();
  const size_t before = rounded_up(reinterpret_cast<uintptr_t>(all), kLargePage) - reinterpret_cast<uintptr_t>(all);
  if (before > 0) munmap(all, before);
  if (before < kLargePage) munmap(all + before + size, kLargePage - before);
  return all + before;
}

/// The free blocks, by their addresses, none next to another.
class FreeBlocks {
 public:
  size_t bytes() const { return bytes_; }

  /// The smallest block that is large enough, or its first part; null if there is none.
  void* take(size_t size) {
    FreeBlock** best = nullptr;
    for (FreeBlock** at = &first_; *at; at = &(*at)->next) {
      if ((*at)->size >= size && (!best || (*at)->size < (*best)->size)) best = at;
    }
    if (!best) return nullptr;
    FreeBlock* const block = *best;
    if (block->size == size) {
      *best = block->next;
    } else {
      *best = ::new (reinterpret_cast<char*>(block) + size) FreeBlock{block->size - size, block->next};
    }
    bytes_ -= size;
    return block;
  }

  void add(void* memory, size_t size) noexcept {
    FreeBlock *before = nullptr, *after = first_;
    for (; after && static_cast<void*>(after) < memory; after = after->next) before = after;
    FreeBlock* block = ::new (memory) FreeBlock{size, after};
    bytes_ += size;
    (before ? before->next : first_) = block;
    if (after && block->end() == reinterpret_cast<char*>(after)) join(*block);
    if (before && before->end() == reinterpret_cast<char*>(block)) join(*before);
  }

  /// Gives the largest ones back to the system until these are `size` bytes, or all.
  void unmap(size_t size) noexcept {
    size_t gone = 0;
    while (first_ && gone < size) {
      FreeBlock** most = &first_;
      for (FreeBlock** at = &first_; *at; at = &(*at)->next) {
        if ((*at)->size > (*most)->size) most = at;
      }
      FreeBlock* const block = *most;
      const size_t length = block->size;
      *most = block->next;
      bytes_ -= length;
      gone += length;
      munmap(block, length);
    }
  }

 private:
  static void join(FreeBlock& block) {
    block.size += block.next->size;
    block.next = block.next->next;
  }

  FreeBlock* first_ = nullptr;
  size_t bytes_ = 0;
};

/// What there is of it in a process. It has no destructor: lists of static duration may end after it.
struct Store {
  Lock lock;
  FreeBlocks free;
  size_t taken = 0;
  size_t keepers = 0;
  char* lowest = nullptr;  // where the pages that were mapped last begin
};

Store& store() {
  static Store* const only = new Store;
  return *only;
}

}  // namespace

void* PageStore::take(size_t bytes) {
  if (bytes > SIZE_MAX / 2) throw std::bad_alloc();
  const size_t size = rounded_up(bytes, kBlockGrain);
  Store& all = store();
  const std::lock_guard locked(all.lock);
  void* memory = all.free.take(size);
  if (!memory) {
    // New pages take the place of free ones, which were too short: all that is there never comes to more than was
    // taken at once.
    const size_t mapped = rounded_up(size, kLargePage);
    all.free.unmap(std::min(mapped, all.free.bytes()));
    memory = map_pages(mapped, all.lowest);
#if defined(MADV_HUGEPAGE)
    madvise(memory, mapped, MADV_HUGEPAGE);
#endif
    all.lowest = static_cast<char*>(memory);
    if (mapped > size) all.free.add(static_cast<char*>(memory) + size, mapped - size);
  }
  all.taken += size;
  return memory;
}

void PageStore::give_back(void* memory, size_t bytes) noexcept {
  const size_t size = rounded_up(bytes, kBlockGrain);
  Store& all = store();
  const std::lock_guard locked(all.lock);
  all.taken -= size;
  all.free.add(memory, size);
  if (all.keepers == 0) all.free.unmap(all.free.bytes());
}

PageStore::Keeper::Keeper() noexcept {
  Store& all = store();
  const std::lock_guard locked(all.lock);
  ++all.keepers;
}

PageStore::Keeper::~Keeper() {
  Store& all = store();
  const std::lock_guard locked(all.lock);
  if (--all.keepers == 0) all.free.unmap(all.free.bytes());
}

void PageStore::trim() noexcept {
  {
    Store& all = store();
    const std::lock_guard locked(all.lock);
    all.free.unmap(all.free.bytes());
  }
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

PageStore::Figures PageStore::figures() noexcept {
  Store& all = store();
  const std::lock_guard locked(all.lock);
  return {all.taken, all.free.bytes()};
}

#else

namespace {

constexpr std::align_val_t kCacheLine{64};

}  // namespace

void* PageStore::take(size_t bytes) { return ::operator new(bytes, kCacheLine); }
void PageStore::give_back(void* memory, size_t) noexcept { ::operator delete(memory, kCacheLine); }
PageStore::Keeper::Keeper() noexcept = default;
PageStore::Keeper::~Keeper() = default;
void PageStore::trim() noexcept {}
PageStore::Figures PageStore::figures() noexcept { return {0, 0}; }

#endif

}  // namespace meander
