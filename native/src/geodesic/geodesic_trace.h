// SPDX-License-Identifier: GPL-3.0-or-later
//
// The straightest geodesic from a point along a tangent vector (retraction, section 3.3).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "geodesic/constants.h"
#include "geodesic/unfolding.h"
#include "mesh/surface_point.h"

namespace meander {

/// Where a walk has led.
struct Trace {
  SurfacePoint end;
  Vec2 direction;          ///< unit direction of travel, in the plane of the end's face
  double length = 0;       ///< travelled; less than asked for where the boundary came first
  bool hit_boundary = false;
};

/// A walk from `start` along `displacement` (in the plane of the start's face), one face after another.
/// Straight within the unfolded faces: the straightest geodesic of Polthier and Schmies (1998). It passes a
/// vertex on the side where it meets it, and stops just inside the boundary.
///
/// The faces are unfolded into the plane in which the walk is the positive x axis from the origin, so that a
/// face costs one complex product and the sign of one number. Every step ends with a hint to fetch the next
/// face: several walks in turn do not wait for memory, where a single one would.
class GeodesicWalk {
 public:
  GeodesicWalk(const Surface& surface, const SurfacePoint& start, Vec2 displacement);

  /// The walk from the same start in the opposite direction, as far, for less than it costs anew; of a walk that has
  /// not taken a step.
  GeodesicWalk other_way() const;

  /// Lets the walk end after this length, if that is less, and be the same up to there to the last bit; before its
  /// first step.
  void shorten(double length) { wanted_ = std::min(wanted_, length); }

  /// Crosses into the next face; false where the walk ends in this one, and from then on.
  bool step();
  /// Whether the walk has left its first face.
  bool crossed() const { return crossings_ > 0; }
  /// What the last step crossed.
  Crossing crossing() const;

  /// The end, once step() has returned false.
  SurfacePoint end() const;
  double length() const;  ///< travelled
  bool hit_boundary() const { return hit_boundary_; }
  Vec2 direction() const;  ///< unit, in the plane of the end's face

 private:
  void begin_in(const std::array<double, 3>& x, const std::array<double, 3>& y);
  double exit_at() const;

  const Surface& surface_;
  SurfacePoint start_;
  Vec2 direction_;  // unit
  double wanted_;   // length
  Unfolding face_;  // the right end of its exit is below the axis, the left one on or above it
  HalfEdge entry_ = kNone;           // the exit's twin, once there is one
  int crossings_ = 0;
  bool ended_ = false, hit_boundary_ = false;
};

/// Takes all walks, 2 kTogether at most, to their ends in turns; calls crossed(k) after walk k has crossed an edge.
template <class Crossed>
void lead_together(std::vector<GeodesicWalk>& walks, const Crossed& crossed) {
  std::array<uint8_t, 2 * kTogether> under_way;
  uint32_t count = static_cast<uint32_t>(walks.size());
  for (uint32_t k = 0; k < count; ++k) under_way[k] = static_cast<uint8_t>(k);
  while (count > 0) {
    uint32_t left = 0;
    for (uint32_t w = 0; w < count; ++w) {
      const uint8_t k = under_way[w];
      if (!walks[k].step()) continue;
      under_way[left++] = k;
      crossed(k);
    }
    count = left;
  }
}

/// The whole walk. Appends the crossed edges to `crossings` (not cleared).
Trace trace_geodesic(const Surface& surface, const SurfacePoint& start, Vec2 displacement,
                     std::vector<Crossing>& crossings);

}  // namespace meander
