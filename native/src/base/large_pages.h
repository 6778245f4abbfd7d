// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lists of many megabytes.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/constants.h"
#include "base/page_store.h"

namespace meander {

/// An allocator that takes the memory of long lists from the PageStore: the system then provides the table of a fine
/// mesh in a dozen pieces instead of thousands, which saves a third of the time to set one up, and what one list of
/// nodes gives back another one takes. For small lists this is std::allocator.
template <class T>
struct LargePages {
  using value_type = T;

  LargePages() = default;
  template <class U>
  LargePages(const LargePages<U>&) {}
  friend bool operator==(const LargePages&, const LargePages&) { return true; }

  /// Whether lists of n entries are long.
  static bool is_large(size_t n) { return n >= kLargePage / sizeof(T); }

  T* allocate(size_t n) {
    if (!is_large(n)) return std::allocator<T>().allocate(n);
    if (n > SIZE_MAX / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(PageStore::take(n * sizeof(T)));
  }
  void deallocate(T* memory, size_t n) noexcept {
    if (!is_large(n)) return std::allocator<T>().deallocate(memory, n);
    PageStore::give_back(memory, n * sizeof(T));
  }
  /// resize() leaves new numbers, and what consists of them, uninitialized, so that the threads that fill a table are
  /// the first to touch it.
  template <class U>
  void construct([[maybe_unused]] U* p) {
    if constexpr (!std::is_trivially_destructible_v<U>) ::new (static_cast<void*>(p)) U;
  }
  template <class U, class... Arguments>
  void construct(U* p, Arguments&&... arguments) {
    ::new (static_cast<void*>(p)) U(std::forward<Arguments>(arguments)...);
  }
};

/// A list. Numbers that resize() adds, and what consists of them, are anything.
template <class T>
using Table = std::vector<T, LargePages<T>>;

/// Gives the memory of a list that nobody needs any more to the next one, if it is long: short ones keep theirs, which
/// costs less than to ask for it again.
template <class T>
void hand_on(Table<T>& list) noexcept {
  if (LargePages<T>::is_large(list.capacity())) Table<T>().swap(list);
}
template <class... Lists>
  requires(sizeof...(Lists) > 1)
void hand_on(Lists&... lists) noexcept {
  (hand_on(lists), ...);
}

}  // namespace meander
