// SPDX-License-Identifier: GPL-3.0-or-later
//
// How much of a surface a curve leaves empty, and how much of that is too narrow for it.
#pragma once

#include <array>

#include "base/cancel_token.h"
#include "medial/boundary_reach.h"
#include "outputs/constants.h"
#include "outputs/emptiness.h"

namespace meander {

/// A strip along the boundary that is to stay empty.
struct EmptyStrip {
  const BoundaryObstacle& boundary;
  double distance = 0.5;  ///< of the last strand from the boundary, in spacings

  /// How far the curve is to be from a place with this local r, on account of the strip.
  double wanted_at(const Vec3& place, double r) const;
};

/// Areas that are empty, or their shares of the surface.
struct EmptyArea {
  double wide = 0;    ///< where a curve has room
  double narrow = 0;  ///< where the surface is narrower than a spacing, see is_narrow()

  EmptyArea& operator+=(const EmptyArea& other);
};

/// Whether a surface is narrower than a spacing at a place, so that a line and its way back have no room.
///
/// What is connected to the place within 4 r of it has an area and a longest extent. The one by the other is the width
/// of a strip or the girth of a tube, and from 2.2 r in a corner of 90 degrees to 6.3 r in the plane; below 2 r it is
/// narrow.
bool is_slender(const Emptiness& emptiness, const SurfacePoint& p, CancelToken& poll);

/// Whether a place lies so deep in a sharp corner of the boundary that no circle as wide as a spacing comes as near to
/// it as to the point of a right angle: in a corner of 60 degrees up to .55 r from the point, where it is .6 r wide. A
/// line half a spacing from the boundary turns 2 r from that point.
bool is_in_corner(const Emptiness& emptiness, const SurfacePoint& p, CancelToken& poll);

/// The one or the other.
bool is_narrow(const Emptiness& emptiness, const SurfacePoint& p, CancelToken& poll);

/// Adds up how much of faces is empty. Faces near one another should come one after the other.
class EmptyFaces {
 public:
  /// `poll` counts the places that are looked at.
  EmptyFaces(const Emptiness& emptiness, const EmptyStrip& strip, CancelToken poll)
      : emptiness_(emptiness), strip_(strip), poll_(std::move(poll)) {}

  /// `nearer_than`: the middle of the face is known to be of a smaller size; 0: nothing is known
  void add(uint32_t face, double nearer_than);
  const EmptyArea& area() const { return area_; }

 private:
  bool slender_at(const SurfacePoint& place, double r);

  const Emptiness& emptiness_;
  EmptyStrip strip_;
  CancelToken poll_;
  EmptyArea area_;
  // The last places that were asked about: what is near to one of them is as slender.
  struct Known {
    uint32_t component = kNone;
    Vec3 place = Vec3::Zero();
    bool slender = false;
  };
  std::array<Known, 16> known_;
  size_t next_ = 0;
};

}  // namespace meander
