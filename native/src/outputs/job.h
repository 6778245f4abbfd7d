// SPDX-License-Identifier: GPL-3.0-or-later
//
// A run of the flow on a thread of the library's own, for hosts whose threads must stay their own.
#pragma once

#include <atomic>
#include <exception>
#include <memory>
#include <thread>

#include "flow/flow.h"
#include "outputs/previews.h"

namespace meander {

/// What a run asks and tells. Shared, so that a started run can outlive the caller's context.
struct RunControl {
  std::atomic<bool> cancelled{false};
  std::atomic<double> progress{0};
  std::atomic<Phase> phase{Phase::kGrowing};
  std::atomic<bool> under_way{false};  ///< an iteration has told its phase

  /// As before the first iteration.
  void begin();
  /// How far a run is after an iteration.
  void tell(const Flow& flow, double share);
};

/// One run at a time. Between start() and wait() the flow belongs to the worker. All but running()
/// is called by one thread at a time. Not copyable.
class Job {
 public:
  Job() = default;
  /// Cancels and joins what has not been waited for.
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  /// Makes the first copy of the curve, and begins flow.run() on a thread; `control` may be null.
  void start(Flow& flow, std::shared_ptr<RunControl> control);

  /// start() has been called, and wait() not yet.
  bool started() const { return thread_.joinable(); }

  /// The worker has not ended yet. Any thread.
  bool running() const { return running_; }

  /// Copies of the curve; those of a run stay until the next.
  Previews& previews() { return previews_; }

  /// Joins the worker; why it ended. Throws again what the worker threw.
  StopReason wait();

 private:
  void work(Flow& flow, RunControl* control) noexcept;

  std::shared_ptr<RunControl> control_;
  std::atomic<bool> running_{false}, quit_{false};
  StopReason reason_ = StopReason::kRunning;
  std::exception_ptr error_;
  Previews previews_;
  std::thread thread_;
};

}  // namespace meander
