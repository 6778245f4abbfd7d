// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>

#include "flow/flow.h"

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

}  // namespace meander
