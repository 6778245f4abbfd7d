// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants of the metric at the nodes and of hairpins, which decide how a curve grows.
//
// In every room each such constant has its unit, its range, and what chose it: a heading of docs/decisions.md, or the
// commit whose message has the figures. "Not measured" means that the first value that was tried has stayed. r is the
// local r unless something else is said. What callers may choose is not among them, nor what only saves time and limits
// of rounding, which stand beside their code.
//
// A change in one of these headers changes every curve: measure it as docs/quality.md does, and say in
// docs/decisions.md what chose it.
#pragma once

#include <numbers>

namespace meander {

/// In front of an empty strip wider than this, in spacings, > 0, the boundary pushes no harder than other strands do:
/// they have room to give way there, and between two such strips they would never come to rest (docs/decisions.md,
/// "Wide strips").
inline constexpr double kWideStrip = 1;

/// A hairpin turns by more than this, in radians, from 0 to pi, within this many r, > kHairpinTurn; a run that is drawn
/// in is marked with this many r, >= 0, beyond its hairpins. Not measured.
inline constexpr double kHairpinTurn = 2 * std::numbers::pi / 3;
inline constexpr double kHairpinWindow = 4;
inline constexpr double kHairpinMargin = 2;

}  // namespace meander
