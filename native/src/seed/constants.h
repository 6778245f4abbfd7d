// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants that decide what a flow starts from; curve/constants.h has what is said of each.
#pragma once

namespace meander {

/// The radius of a loop that is wider than the face it begins in, in r, >= 1: a small one collapses. Not measured.
inline constexpr double kFirstLoop = 1.5;

/// The outline of a face whose incircle is smaller than this, in r and as a share of its perimeter, has no room to move
/// in: it would stay where it is for ever. > 0 and below .096, the share of an equilateral face. "first_curve: Begin
/// with a circle where the first face is a sliver".
inline constexpr double kTightFace = 0.3, kSliverFace = 0.02;

/// A circle is made no narrower than the first, in r, to fit; the second is the largest share of the distance to the
/// nearest guide that its radius may have. Both > 0, the second below a half. Not measured.
inline constexpr double kNarrowestLoop = 0.01, kLoopShareOfRoom = 0.4;

/// A drawn seed jumps where the path between two neighbouring points is longer than the first, > pi / 2, times the way
/// between them plus the second in r, > 0. Half way round a sphere the path is pi / 2 times the way. Not measured.
inline constexpr double kJumpFactor = 2, kJumpRadii = 2;

}  // namespace meander
