// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants that decide what a flow starts from; curve/constants.h says how to read a line.
#pragma once

namespace meander {

/// The radius of a loop that is wider than the face it begins in: a small one collapses.
inline constexpr double kFirstLoop = 1.5;             // r; >= 1; free

/// The outline of a face whose incircle is smaller than kTightFace, and than kSliverFace of its perimeter, has no room
/// to move in and would stay where it is for ever; an equilateral face has .096. "first_curve: Begin with a circle
/// where the first face is a sliver".
inline constexpr double kTightFace = 0.3;             // r; > 0; above
inline constexpr double kSliverFace = 0.02;           // share of the perimeter; 0 to 0.096; above

/// A circle is made no narrower than kNarrowestLoop to fit, and takes up no more than kLoopShareOfRoom of the distance
/// to the nearest guide.
inline constexpr double kNarrowestLoop = 0.01;        // r; > 0; free
inline constexpr double kLoopShareOfRoom = 0.4;       // share of the distance; 0 to 0.5; free

/// A drawn seed jumps where the path between two neighbouring points is longer than kJumpFactor times the way between
/// them and kJumpRadii: half way round a sphere it is pi / 2 times the way.
inline constexpr double kJumpFactor = 2;              // times; > 1.57; geometry
inline constexpr double kJumpRadii = 2;               // r; > 0; free

}  // namespace meander
