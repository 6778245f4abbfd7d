// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>

#include "base/failure.h"

namespace meander {

/// Asks now and then whether a computation is to stop; called once for every small piece of its work.
/// Points to the question, which must outlive it. Belongs to one thread; a copy counts for itself.
class CancelPoll {
 public:
  /// Never asks.
  CancelPoll() = default;
  /// `cancelled` is asked once in `pieces` pieces, so that a question that takes a while does not matter; an empty one
  /// never.
  CancelPoll(const std::function<bool()>& cancelled, uint32_t pieces)
      : cancelled_(cancelled ? &cancelled : nullptr), pieces_(pieces) {}

  /// Counts pieces of work. Throws Failure(FailureKind::kCancelled) if the computation is to stop.
  void operator()(size_t pieces = 1) {
    count_ += pieces;
    if (count_ < pieces_) return;
    count_ = 0;
    now();
  }

  /// Asks at once, before or after what takes long and cannot be divided.
  void now() const {
    if (cancelled_ && (*cancelled_)()) throw Failure(FailureKind::kCancelled, "The computation was cancelled.");
  }

 private:
  const std::function<bool()>* cancelled_ = nullptr;
  size_t pieces_ = SIZE_MAX, count_ = 0;
};

}  // namespace meander
