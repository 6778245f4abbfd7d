// SPDX-License-Identifier: GPL-3.0-or-later
//
// What has happened in a flow so far.
#pragma once

#include <cstdint>
#include <vector>

#include "curve/retraction.h"

namespace meander {

/// Wall-clock seconds of all iterations, and of their parts.
struct FlowSeconds {
  double total = 0, medial_axis = 0, solve = 0, refine = 0;
  MoveSeconds move;

  FlowSeconds& operator+=(const FlowSeconds& more) {
    total += more.total;
    medial_axis += more.medial_axis;
    solve += more.solve;
    refine += more.refine;
    move += more.move;
    return *this;
  }
};

/// One iteration; lengths in the surface's own unit.
struct IterationRecord {
  uint32_t nodes = 0;
  double length = 0;
  double mean_step = 0;  ///< of the displacements that were wanted, which crossings may have shortened
  double energy = 0, seconds = 0;
};

enum class StopReason { kRunning, kConverged, kIterationLimit, kStalled, kCancelled };

/// Grows with every iteration; nothing in it changes a curve.
struct RunRecord {
  std::vector<IterationRecord> history;
  FlowSeconds seconds;
  size_t started_at = 0;  ///< iterations that do not count for the limit any more
  bool cancelled = false;

  size_t iterations() const { return history.size() - started_at; }

  /// Makes room for one more iteration; the only part of adding it that may throw.
  void make_room() {
    if (history.size() == history.capacity()) history.reserve(2 * history.size() + 16);
  }
  void add(const IterationRecord& iteration, const FlowSeconds& spent) noexcept {
    history.push_back(iteration);
    seconds += spent;
  }

  /// Begins a new run on a surface whose unit is `factor` times smaller.
  void restart(double factor) {
    for (IterationRecord& record : history) {
      for (double* value : {&record.length, &record.mean_step, &record.energy}) *value *= factor;
    }
    started_at = history.size();
    cancelled = false;
  }
};

}  // namespace meander
