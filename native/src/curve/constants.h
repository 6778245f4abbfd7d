// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants of the metric at the nodes and of hairpins, which decide how a curve grows.
//
// In every room each line of such a table has the unit, the range without its ends, and what chose the value: a heading
// of docs/decisions.md in quotes; "above", where the figures, or the subject of the commit that has them, stand above
// the line; "geometry", where it follows from what is said above it; or "free", where the first value that was tried
// has stayed. r is the local r. What callers may choose is not among them; what only saves time, and limits of
// rounding, stand beside their code. tests/core/test_constants.py reads these lines.
//
// A change in one of these headers changes every curve: measure it as docs/quality.md does, and say in
// docs/decisions.md what chose it.
#pragma once

#include <numbers>

namespace meander {

/// In front of an empty strip wider than this the boundary pushes no harder than other strands do: they have room to
/// give way there, and between two such strips they would never come to rest.
inline constexpr double kWideStrip = 1;                           // spacings; > 0; "Wide strips"

/// A hairpin turns by more than kHairpinTurn within kHairpinWindow. A run that is drawn in is marked with
/// kHairpinMargin beyond its hairpins.
inline constexpr double kHairpinTurn = 2 * std::numbers::pi / 3;  // radians; 0 to pi; free
inline constexpr double kHairpinWindow = 4;                       // r; > kHairpinTurn; free
inline constexpr double kHairpinMargin = 2;                       // r; >= 0; free

}  // namespace meander
