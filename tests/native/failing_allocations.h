// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes one allocation of a program fail, in whichever thread. To be included by one file of a program only: it
// replaces the operators `new` and `delete`, which the library's own code in the program then uses too.
//
// Eigen and nanoflann ask malloc instead. A program that the linker wraps malloc for, and that is compiled with
// MEANDER_WRAPPED_MALLOC, has those fail as well (cmake/tests.cmake); those of the system's libraries never fail.
#pragma once

#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>
#ifdef _WIN32
#include <malloc.h>
#endif

namespace {

constexpr long kNoneFails = std::numeric_limits<long>::max();
/// How many allocations will succeed before one fails.
std::atomic<long> allocations_left{kNoneFails};

/// Whether the present allocation is the one that is to fail.
bool fails() { return allocations_left.fetch_sub(1, std::memory_order_relaxed) == 0; }

#ifdef _WIN32  // has aligned memory under other names
void* aligned(std::size_t alignment, std::size_t size) { return _aligned_malloc(size, alignment); }
void free_aligned(void* memory) { _aligned_free(memory); }
#else
void* aligned(std::size_t alignment, std::size_t size) { return std::aligned_alloc(alignment, size); }
void free_aligned(void* memory) { std::free(memory); }
#endif

void* allocate(std::size_t size, std::size_t alignment) {
  if (fails()) throw std::bad_alloc();
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  void* memory = aligned(alignment, rounded > 0 ? rounded : alignment);
  if (!memory) throw std::bad_alloc();
  return memory;
}

/// Not inline: the compiler would warn that free() gets a pointer from `new`.
[[gnu::noinline]] void release(void* memory) noexcept { free_aligned(memory); }

}  // namespace

void* operator new(std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new[](std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t a) { return allocate(size, static_cast<std::size_t>(a)); }
void* operator new[](std::size_t size, std::align_val_t a) { return allocate(size, static_cast<std::size_t>(a)); }
// A sanitizer has its own versions, which would not call these.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return ::operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void* operator new[](std::size_t size, const std::nothrow_t& nothrow) noexcept { return ::operator new(size, nothrow); }
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }

#ifdef MEANDER_WRAPPED_MALLOC
extern "C" {
// What the linker calls them.
// NOLINTBEGIN(bugprone-reserved-identifier)
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* memory, std::size_t size);
void* __wrap_malloc(std::size_t size) { return fails() ? nullptr : __real_malloc(size); }
void* __wrap_calloc(std::size_t count, std::size_t size) { return fails() ? nullptr : __real_calloc(count, size); }
void* __wrap_realloc(void* memory, std::size_t size) { return fails() ? nullptr : __real_realloc(memory, size); }
// NOLINTEND(bugprone-reserved-identifier)
}
#endif

namespace meander::test {

/// Calls work() with its n-th allocation, counted from 0, failing. Returns whether it was reached.
template <class Work>
bool with_failing_allocation(long n, const Work& work) {
  allocations_left = n;
  work();
  return allocations_left.exchange(::kNoneFails) < 0;
}

/// The number of allocations of work().
template <class Work>
long allocations_of(const Work& work) {
  allocations_left = ::kNoneFails;
  work();
  return ::kNoneFails - allocations_left.exchange(::kNoneFails);
}

}  // namespace meander::test
