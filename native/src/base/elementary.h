// SPDX-License-Identifier: GPL-3.0-or-later
//
// Elementary functions that give the same bytes on every system and processor.
//
// Those of the C libraries do not: glibc, Microsoft's, Apple's and Zig's differ in the last bit, and glibc
// itself has others for processors with fused multiplication. One bit is enough for another curve. These
// compute with pairs of doubles by additions, multiplications, divisions and roots alone, which IEEE 754
// fixes, and are rounded correctly in all but about one of 4,000 results: their error is at most
// 0.502 units in the last place (pow: 0.53, where the result is near the largest or least number).
//
// What std:: has beside them is exact, and so the same everywhere: sqrt, fma, floor, lround, remainder, frexp.
#pragma once

namespace meander::elementary {

double exp(double x);
/// The natural logarithm; -inf of 0, NaN of less.
double log(double x);
/// log(1 + x), also where x is far smaller than 1.
double log1p(double x);
/// x to the power y, for x of at least 0; NaN of less.
double pow(double x, double y);
/// Of angles in radians. Beyond 2^30 they are first reduced by a rounded multiple of 2 pi.
double sin(double x);
double cos(double x);
/// The angle of the point (x, y), from -pi to pi; signs of zeros count, as in the C library.
double atan2(double y, double x);
/// sqrt(x^2 + y^2) without overflow.
double hypot(double x, double y);

}  // namespace meander::elementary
