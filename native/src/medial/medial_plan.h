// SPDX-License-Identifier: GPL-3.0-or-later
//
// How balls are found in one iteration, and how hard the boundary pushes.
#pragma once

#include <limits>

#include "medial/constants.h"

namespace meander {

/// What an iteration wants of the medial axis. As it is made, it is that of a curve as it is, and as exact as may be.
struct MedialPlan {
  /// Balls along the surface are measured also where it is creased, see compute_geodesic_medial_axis.
  bool measure = true;
  /// In r: the boundary is looked for within this of every node, and farther only where balls reach farther. What the
  /// state says of it beyond is only of these.
  double boundary_within = std::numeric_limits<double>::infinity();
  /// 0 where the boundary pushes twice as hard as strands do, 1 where it hardly pushes harder.
  double boundary_ease = 0;
  /// Where a node is nearer to the boundary than this share of the distance wanted, it pushes much harder.
  double very_near = kVeryNear;
};

}  // namespace meander
