// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keeps threads apart, where there are any; taken by std::lock_guard.
#pragma once

#include <mutex>

namespace meander {

#ifndef MEANDER_WITHOUT_THREADS
using Lock = std::mutex;
#else
/// In a build whose only thread is the caller's (MEANDER_THREADS in cmake/library.cmake).
class Lock {
 public:
  void lock() {}
  void unlock() {}
};
#endif

}  // namespace meander
