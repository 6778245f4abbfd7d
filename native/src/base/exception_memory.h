// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdlib>
#include <exception>

namespace meander {

/// Has the C++ runtime get what it keeps for the exceptions of this thread; false where there is no memory for it,
/// and then nothing may be thrown here. Cheap from the second time on.
///
/// Where a program has loaded the runtime late, as Python does, it asks for that memory with a thread's first
/// exception, and ends the program if there is none. That first exception may well be std::bad_alloc.
inline bool can_throw() noexcept {
  constexpr std::size_t kPlenty = 4096;
  void* const memory = std::malloc(kPlenty);
  asm volatile("" : : "r"(memory) : "memory");  // or else a compiler sees that nobody uses it, and asks for none
  if (!memory) return false;
  std::free(memory);
  return std::uncaught_exceptions() >= 0;  // in what has just become free
}

}  // namespace meander
