// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory for long lists: what one gives back, the next one takes.
#pragma once

#include <cstddef>

namespace meander {

/// Blocks of whole pages, of the process: as with malloc, any thread may ask. Lists of nodes come and go in every
/// iteration, in the same order with nearly the same lengths; what one step gives back the next one takes, already
/// there and in large pages. malloc maps each of them anew instead, or leaves holes of their sizes.
///
/// Where the system is not Linux, and where an address sanitizer watches, this is operator new.
class PageStore {
 public:
  /// Memory for `bytes`, more than 0, aligned as any type here needs; what is in it is anything. Throws
  /// std::bad_alloc.
  static void* take(size_t bytes);
  /// `bytes` as it was taken.
  static void give_back(void* memory, size_t bytes) noexcept;

  /// While there is one, what is given back stays for others to take; after the last one it goes back to the system.
  class Keeper {
   public:
    Keeper() noexcept;
    ~Keeper();
    Keeper(const Keeper&) = delete;
    Keeper& operator=(const Keeper&) = delete;
  };

  /// Gives back to the system what waits for others all the same, and what malloc has of whole pages that are free:
  /// after a step that took much memory in small pieces. Takes some milliseconds for every 100 MB.
  static void trim() noexcept;

  /// Of all blocks: bytes that have been taken, and those that wait for others.
  struct Figures {
    size_t taken, free;
  };
  static Figures figures() noexcept;
};

}  // namespace meander
