// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants of the quadratic model and of its weights; curve/constants.h says how to read a line.
#pragma once

namespace meander {

/// The Hessian of a pure length weight must stay positive: it uses no smaller weight than this. The gradient's may be
/// negative, to let a strand grow.
inline constexpr double kLeastLengthStiffness = 0.05;  // length weight; > 0; free

/// With a power q of the medial term (eq. 13) above 2 the spacing stays what it is when alpha falls, from 1 at q = 2 to
/// kPowerLimit, at the rate kPowerRate. Measured on a square of 17 x 17 spacings with both presets: with alpha left as
/// it is, the spacing falls by 11 to 16 % for q from 3 to 8.
inline constexpr double kPowerLimit = 0.53;          // times alpha; 0 to 1; above
inline constexpr double kPowerRate = 1.1;            // 1 / q; > 0; above

/// What is added to the length weights of a polish to the same end: kPolishBalance, and kPolishBalanceSlope for each
/// unit of q. Measured likewise: growth with q above 2 leaves the curve 7 to 16 % too dense. With a bending of 1.2 in
/// the polish the spacing is .86 to .90 of the one asked for; .5 instead of .8 leaves .84 to .87.
inline constexpr double kPolishBalance = 0.8;        // length weight; >= 0; above
inline constexpr double kPolishBalanceSlope = 0.05;  // length weight / q; >= 0; above

/// The spacing that the polish follows is smoothed along the curve over this much.
inline constexpr double kSpacingSmoothing = 2;       // r; >= 0; free

}  // namespace meander
