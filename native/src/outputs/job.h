// SPDX-License-Identifier: GPL-3.0-or-later
//
// A run of the flow on a thread of the library's own, for hosts whose threads must stay their own; and a search in it.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>

#include "base/cancel_token.h"
#include "flow/flow.h"
#include "outputs/previews.h"
#include "outputs/run_control.h"

namespace meander {

/// One run or search at a time. Between start() and wait() the flow belongs to the worker. All but running()
/// is called by one thread at a time. Not copyable.
class Job {
 public:
  Job();
  /// Cancels and joins what has not been waited for.
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  /// Makes the first copy of the curve, and begins flow.run() on a thread; `control` may be null.
  void start(Flow& flow, std::shared_ptr<RunControl> control);

  /// What looks at the flow, until it is asked to end; it tells `control`, where that is there, how far it is.
  using Search = std::function<void(const CancelToken& cancel)>;
  /// Begins a search on a thread, for which wait() says kRunning.
  void search(Search search, std::shared_ptr<RunControl> control);

  /// start() or search() has been called, and wait() not yet.
  bool started() const { return worker_ != nullptr; }

  /// The worker has not ended yet. Any thread.
  bool running() const { return running_; }

  /// Copies of the curve; those of a run stay until the next.
  Previews& previews() { return previews_; }

  /// Joins the worker; why it ended. Throws again what the worker threw.
  StopReason wait();

 private:
  struct Worker;  // the thread; serial_job.cpp has none

  /// Begins what is to be done on the thread.
  void begin(std::shared_ptr<RunControl> control, std::function<StopReason()> work);
  void do_work(const std::function<StopReason()>& work) noexcept;
  bool stops() const { return quit_ || (control_ && control_->cancelled); }

  std::shared_ptr<RunControl> control_;
  std::atomic<bool> running_{false}, quit_{false};
  StopReason reason_ = StopReason::kRunning;
  std::exception_ptr error_;
  Previews previews_;
  std::unique_ptr<Worker> worker_;  // last, so that it is joined before the rest goes
};

}  // namespace meander
