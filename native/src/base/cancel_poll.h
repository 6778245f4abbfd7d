// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>

#include "base/failure.h"

namespace meander {

/// Asks now and then whether a computation is to stop; called once for every small piece of its work.
/// Holds a reference to the question, which must outlive it. Belongs to one thread.
class CancelPoll {
 public:
  /// `cancelled` is asked once in `pieces` calls, so that a question that takes a while does not matter.
  CancelPoll(const std::function<bool()>& cancelled, uint32_t pieces) : cancelled_(cancelled), pieces_(pieces) {}

  /// Throws Failure(FailureKind::kCancelled) if the computation is to stop.
  void operator()() {
    if (++count_ < pieces_) return;
    count_ = 0;
    if (cancelled_()) throw Failure(FailureKind::kCancelled, "The computation was cancelled.");
  }

 private:
  const std::function<bool()>& cancelled_;
  uint32_t pieces_, count_ = 0;
};

}  // namespace meander
