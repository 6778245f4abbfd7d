// SPDX-License-Identifier: GPL-3.0-or-later
//
// Copies of a curve while it grows: a worker makes them between iterations, and a host takes them out.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "base/lock.h"
#include "flow/flow.h"
#include "outputs/polylines.h"

namespace meander {

/// The curve between two iterations of a started run; lengths in the caller's units.
struct Preview {
  uint32_t serial = 0;  ///< from 1 within a run
  uint32_t iterations = 0, nodes = 0;
  double length = 0, seconds = 0;
  Polylines polylines;
};

/// The newest copy, where the last one has been taken, and those of growth, which all are kept. keep_growth() and
/// begin() are called while no worker runs, after_iteration() by the worker, and take() by the host meanwhile.
class Previews {
 public:
  /// For the runs that follow: copies are kept whenever the curve is longer by `length_step`, in the
  /// caller's units, than at the last, but no more points than `point_limit` at once. 0: none.
  void keep_growth(double length_step, size_t point_limit);

  /// Forgets the copies of the run before, and makes the first one of this.
  void begin(const Flow& flow);

  /// Makes the copies that are due.
  void after_iteration(const Flow& flow);

  /// Takes out the oldest copy that has not been taken, of growth or the newest; how many of growth come after it, or
  /// nothing while there is none. The worker makes the next one after its present iteration where none is left.
  std::optional<size_t> take(Preview& copy) noexcept;

 private:
  void keep(const Flow& flow);
  void copy(const Flow& flow);
  void fill_next(const Flow& flow);

  std::atomic<bool> wanted_{false};  // the newest copy has been taken, and none of growth is left
  Lock lock_;                        // of newest_ and kept_, and of what is about them
  Preview newest_;
  bool taken_ = true;  // newest_ has been taken
  std::deque<Preview> kept_;
  size_t kept_points_ = 0;

  Preview next_;  // the worker's: filled without the lock, then swapped in
  size_t point_limit_ = 0;
  double length_step_ = 0, kept_length_ = 0;  // of the last copy that was kept, which is the worker's
  uint32_t serial_ = 0;                       // of the last copy: the worker's
};

}  // namespace meander
