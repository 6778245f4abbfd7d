// SPDX-License-Identifier: GPL-3.0-or-later
//
// A run of the flow on a thread of the library's own, for hosts whose threads must stay their own.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "flow/flow.h"
#include "outputs/polylines.h"

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

/// The curve between two iterations of a started run; lengths in the caller's units.
struct Preview {
  uint32_t serial = 0;  ///< from 1 within a run
  uint32_t iterations = 0, nodes = 0;
  double length = 0, seconds = 0;
  Polylines polylines;
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

  /// For the runs that follow: copies are kept whenever the curve is longer by `length_step`, in the
  /// caller's units, than at the last, but no more points than `point_limit` at once. 0: none.
  void keep_growth(double length_step, size_t point_limit);

  /// Makes the first copy of the curve, and begins flow.run() on a thread; `control` may be null.
  void start(Flow& flow, std::shared_ptr<RunControl> control);

  /// start() has been called, and wait() not yet.
  bool started() const { return thread_.joinable(); }

  /// The worker has not ended yet. Any thread.
  bool running() const { return running_; }

  /// Takes out the oldest copy that has not been taken, of growth or the newest; how many of growth come after it, or
  /// nothing while there is none. The worker makes the next one after its present iteration where none is left.
  std::optional<size_t> take(Preview& copy) noexcept;

  /// Joins the worker; why it ended. Throws again what the worker threw.
  StopReason wait();

 private:
  void work(Flow& flow, RunControl* control) noexcept;
  void copy(const Flow& flow);
  void fill_next(const Flow& flow);
  void keep(const Flow& flow);

  std::shared_ptr<RunControl> control_;
  std::atomic<bool> running_{false}, quit_{false};
  std::atomic<bool> wanted_{false};  // the newest copy has been taken
  std::mutex mutex_;                 // of newest_ and kept_, and of what is about them
  Preview newest_;
  bool taken_ = true;  // newest_ has been taken
  Preview next_;  // the worker's: filled without the lock, then swapped in
  std::deque<Preview> kept_;
  size_t kept_points_ = 0, point_limit_ = 0;
  double length_step_ = 0, kept_length_ = 0;  // of the last copy that was kept, which is the worker's
  uint32_t serial_ = 0;                       // of the last copy: the worker's
  StopReason reason_ = StopReason::kRunning;
  std::exception_ptr error_;
  std::thread thread_;
};

}  // namespace meander
