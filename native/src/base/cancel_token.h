// SPDX-License-Identifier: GPL-3.0-or-later
//
// How whoever asked for a computation ends it on the way.
#pragma once

#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "base/failure.h"

namespace meander {

/// Whether a computation is to stop. A small value, which refers to what says so: that must outlive it and its copies.
/// Every call that may take long is given one, and hands it on.
///
/// A token belongs to one thread, the caller's, which is the only one that asks; what is asked may be changed by any
/// thread, as a flag is. A ThreadPool asks before every loop and before every block of it that the caller's thread
/// takes. Other loops count their work in pieces, and ask once in so many that this costs nothing and takes less than
/// some milliseconds. A copy counts for itself.
class CancelToken {
 public:
  /// Never stops anything.
  CancelToken() = default;
  /// Stops once `flag` is set.
  CancelToken(const std::atomic<bool>& flag)
      : says_([](const void* asked) { return static_cast<const std::atomic<bool>*>(asked)->load(); }), asked_(&flag) {}
  /// Stops once `question()` is true, which may take a while to be found out.
  template <std::predicate Question>
  CancelToken(const Question& question)
      : says_([](const void* asked) -> bool { return (*static_cast<const Question*>(asked))(); }), asked_(&question) {}

  /// The same, asked once in `pieces` pieces of work.
  CancelToken every(uint32_t pieces) const {
    CancelToken token = *this;
    token.pieces_ = pieces;
    token.count_ = 0;
    return token;
  }

  /// Counts pieces of work, and asks when it is time. Throws as now() does.
  void operator()(size_t pieces = 1) {
    count_ += pieces;
    if (count_ < pieces_) return;
    count_ = 0;
    now();
  }

  /// Asks at once, before or after what takes long and cannot be divided. Throws Failure(FailureKind::kCancelled) if
  /// the computation is to stop.
  void now() const {
    if (says_ && says_(asked_)) throw Failure(FailureKind::kCancelled, "The computation was cancelled.");
  }

 private:
  bool (*says_)(const void*) = nullptr;
  const void* asked_ = nullptr;
  size_t pieces_ = 1, count_ = 0;
};

}  // namespace meander
