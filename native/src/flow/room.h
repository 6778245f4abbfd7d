// SPDX-License-Identifier: GPL-3.0-or-later
//
// What room there is for a closed line on surfaces that are all narrow, and what is too long to grow along.
#pragma once

#include "curve/curve.h"
#include "mesh/radius_field.h"

namespace meander {

/// What was found.
struct Room {
  bool narrow = false;   ///< some component is a strip that is narrower than 4 r
  bool smaller = false;  ///< r has become smaller
};

/// A closed line lies across a strip an even number of times. One narrower than two spacings has room for it and its
/// way back where r is a quarter of the strip's width; with a larger one the boundary pushes one strand into the other
/// until neither can move. So r becomes that on every component that is such a strip, and half of its width where a
/// strand that grows is open and may lie along the middle: where the strip has two ends and is no wider than a line
/// alone fills better than two strands. It stays what it is elsewhere, and where there is no room at all.
Room leave_room(const Surface& surface, const Curve& curve, RadiusField& radius);

/// Whether all components are strips so long that growth, which advances at two tips there, would take longer than on a
/// square of that area.
bool too_long_to_grow(const Surface& surface, const RadiusField& radius);

/// Whether all components are strips narrower than two spacings: nothing can turn on them, and a line that grows can do
/// no more than run on along them. Not where an open strand needs no way back: it grows on along the middle.
bool too_narrow_to_grow(const Surface& surface, const Curve& curve, const RadiusField& radius);

}  // namespace meander
