// SPDX-License-Identifier: GPL-3.0-or-later
//
// The progress of a context, for a call that is no run.
#pragma once

#include <atomic>

#include "api/handles.h"
#include "base/tell.h"

namespace meander {

/// Afterwards it is that of the run again, which later steps go on from.
class LentProgress {
 public:
  explicit LentProgress(meander_context* context) : share_(context ? &context->control->progress : nullptr) {
    if (share_) of_run_ = *share_;
  }
  ~LentProgress() {
    if (share_) *share_ = of_run_;
  }
  LentProgress(const LentProgress&) = delete;
  LentProgress& operator=(const LentProgress&) = delete;

  std::atomic<double>* share() const { return share_; }

  /// What tells it, from 0 on. Must not outlive this.
  Tell tell() const {
    if (!share_) return {};
    *share_ = 0;
    return [share = share_](double done) { *share = done; };
  }

 private:
  std::atomic<double>* share_;
  double of_run_ = 0;
};

}  // namespace meander
