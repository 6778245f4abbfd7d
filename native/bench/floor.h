// SPDX-License-Identifier: GPL-3.0-or-later
//
// The floor: what the medial axis alone must cost. Shrinking a ball takes about 4.3 nearest-point
// queries per node and side from a cold start (Ma, Bae and Choi 2012, as measured here), so one
// tree over the nodes plus that many queries, on one thread, is the work of an iteration that does
// not start from known radii, use threads, or search better; the ratio shows what these gain.
#pragma once

#include "result.h"

namespace meander::bench {

struct Floor {
  double tree_seconds = 0;
  double query_seconds = 0;
  double cpu_seconds = 0;  ///< processor time of both
};

/// Medians of three. Queries are `radius` from the node on either side, as a ball's centre is.
Floor measure_floor(const Mesh& mesh, const Nodes& nodes, double radius);

}  // namespace meander::bench
