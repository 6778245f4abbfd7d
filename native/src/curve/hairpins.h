// SPDX-License-Identifier: GPL-3.0-or-later
//
// Hairpins: where a strand turns back, and which of them lie close together along it.
//
// Nearly all uneven spacing lies beside hairpins, and no local force removes one: a finger may grow
// or shrink by any length at the same energy, since straight strands are pulled alike from both
// sides. So they have to be sorted out along the strand. Two neighbouring hairpins that turn to opposite
// sides bound a run that lies, with the strand before and after it, three times side by side (an S
// pulled long). When the run has shrunk to nothing both hairpins are gone.
#pragma once

#include <vector>

#include "base/thread_pool.h"
#include "curve/curve.h"
#include "curve/local_metric.h"

namespace meander {

struct Hairpin {
  double at = 0;  ///< arc length along the strand from its first node, in units of the local r
  int side = 1;   ///< 1 turns left, -1 right
};

/// The hairpins of a strand in order: turns of more than 120 degrees within 4 r.
std::vector<Hairpin> find_hairpins(const Curve& curve, const Strand& strand, const LocalMetric& metric,
                                   ThreadPool& pool);

/// Marks (1, others 0) the nodes of the shortest runs, the `share` of all, between two hairpins that
/// turn to opposite sides, with 2 r beyond them.
NodeData<uint8_t> mark_short_runs(const Curve& curve, const LocalMetric& metric, double share,
                                     ThreadPool& pool);

}  // namespace meander
