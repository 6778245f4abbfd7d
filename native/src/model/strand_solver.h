// SPDX-License-Identifier: GPL-3.0-or-later
//
// Systems of all strands: which thread solves which.
#pragma once

#include <functional>

#include "model/energy.h"

namespace meander {

/// Keeps the memory of the systems from call to call. One call at a time.
class StrandSolver {
 public:
  /// Calls body(strand, pool, system) once for every strand: long strands one after another, each with all threads;
  /// short ones side by side, each with one. `system` is anything, and for the body to fill. What a body writes is to
  /// be its strand's own; the result is then the same for any number of threads. The time is linear in the strands.
  void for_strands(const Curve& curve, ThreadPool& pool,
                   const std::function<void(const Strand&, ThreadPool&, StrandSystem&)>& body);

  /// Hands the memory of the systems on.
  void hand_on() noexcept { system_.hand_on(); }

 private:
  StrandSystem system_;  // of long strands
};

}  // namespace meander
