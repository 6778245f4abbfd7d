// SPDX-License-Identifier: GPL-3.0-or-later
//
// The straightest geodesic from a point along a tangent vector (retraction, section 3.3).
#pragma once

#include <vector>

#include "surface_point.h"

namespace meander {

struct Trace {
  SurfacePoint end;
  Vec2 direction;          ///< unit direction of travel, in the plane of the end's face
  double length = 0;       ///< travelled; less than asked for where the boundary came first
  bool hit_boundary = false;
};

/// Walks from `start` along `displacement` (in the plane of the start's face), unfolding face after
/// face, and appends the crossed edges to `crossings` (not cleared). Stops just inside the boundary.
/// Straight within the unfolded faces: the straightest geodesic of Polthier and Schmies (1998); it
/// passes vertices on the side where it meets them.
Trace trace_geodesic(const Surface& surface, const SurfacePoint& start, Vec2 displacement,
                     std::vector<Crossing>& crossings);

}  // namespace meander
