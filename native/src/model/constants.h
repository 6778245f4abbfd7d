// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants of the quadratic model and of its weights; curve/constants.h has what is said of each.
#pragma once

namespace meander {

/// The Hessian of a pure length weight must stay positive; where the gradient's weight is below this, > 0 (it may be
/// negative, to let a strand grow), the Hessian uses this. Not measured.
inline constexpr double kLeastLengthStiffness = 0.05;

/// What alpha is multiplied by so that a power q of the medial term (eq. 13) leaves the spacing as it is falls from 1
/// at q = 2 to this limit, from 0 to 1, at this rate, > 0. Measured on a square of 17 x 17 spacings with both presets:
/// with alpha left as it is, the spacing falls by 11 to 16 % for q from 3 to 8.
inline constexpr double kPowerLimit = 0.53, kPowerRate = 1.1;

/// What is added to the length weights of a polish to the same end: the first, and the second for each unit of q; both
/// >= 0. Measured likewise: growth with q above 2 leaves the curve 7 to 16 % too dense. With a bending of 1.2 in the
/// polish the spacing is .86 to .90 of the one asked for; .5 instead of .8 leaves .84 to .87.
inline constexpr double kPolishBalance = 0.8, kPolishBalanceSlope = 0.05;

/// The spacing that the polish follows is smoothed along the curve over this many r, >= 0. Not measured.
inline constexpr double kSpacingSmoothing = 2;

}  // namespace meander
