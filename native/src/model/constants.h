// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants of the quadratic model and of its weights; curve/constants.h says how to read a line.
#pragma once

#include <cstddef>

namespace meander {

/// alpha r^2 of the paper's relation between weight and spacing (Fig. 17: r = 1.68 / sqrt(alpha)): 2 sqrt(2).
inline constexpr double kAlphaRadiusSquared = 2.8284271247461903;  // none; > 0; above

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

/// A segment counts as no shorter than this: 1 / l would mean nothing, and smoothing would be infinitely stiff.
/// Refinement removes shorter ones right after.
inline constexpr double kShortestSegment = 1e-6;     // r; > 0; free
/// A medial radius counts as no smaller than this, as powers below 2 would be infinitely stiff.
inline constexpr double kLeastMedialRadius = 1e-3;   // r; > 0; free

/// A closed strand of fewer nodes has couplings that fall on one another, and is solved densely.
inline constexpr size_t kLeastBanded = 6;            // nodes; >= 6; geometry
/// What the ends of a chunk cause dies away from node to node; below this it counts as nothing.
inline constexpr double kNegligible = 1e-40;         // share of the ends; 0 to 1; free
/// A chunk keeps two nodes at either end of its couplings apart.
inline constexpr size_t kShortestChunk = 4;          // nodes; >= 4; geometry
/// Nodes of a chunk that a thread solves by itself: many more than the hundreds which feel its ends.
inline constexpr size_t kLeastChunk = 2048;          // nodes; >= kShortestChunk; free
/// With more chunks the small dense system between them would cost more than they save.
inline constexpr size_t kMostChunks = 64;            // chunks; >= 1; free

}  // namespace meander
