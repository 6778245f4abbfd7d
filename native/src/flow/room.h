// SPDX-License-Identifier: GPL-3.0-or-later
//
// What room there is for a closed line on surfaces that are all narrow.
#pragma once

#include "curve/curve.h"
#include "mesh/radius_field.h"

namespace meander {

/// A component narrower than 4 r times this has no room for a line and its way back; from 0 to 1.
inline constexpr double kLeastRoom = 0.2;

/// What was found.
struct Room {
  bool narrow = false;   ///< some component is a strip that is narrower than 4 r
  bool smaller = false;  ///< r has become smaller
};

/// A closed line lies across a strip an even number of times. One narrower than two spacings has room for it and its
/// way back where r is a quarter of the strip's width; with a larger one the boundary pushes one strand into the other
/// until neither can move. So r becomes that on every component that is such a strip, and half of its width where a
/// strand that grows is open, which may lie along the middle; it stays what it is elsewhere, and where there is no room
/// at all.
Room leave_room(const Surface& surface, const Curve& curve, RadiusField& radius);

}  // namespace meander
