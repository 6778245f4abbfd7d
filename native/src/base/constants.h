// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants of plane arithmetic, of elementary functions and of memory; curve/constants.h says how to read a line.
#pragma once

#include <cstddef>

namespace meander {

/// Coordinates inside a face, and along an edge, are multiples of this. So 1 - t and differences are exact, both faces
/// of an edge agree about a point on it, and orientation() is exact without multiple-precision arithmetic.
inline constexpr double kGrain = 0x1p-50;                   // length of the edge; > 0; geometry

// ---- Elementary functions -------------------------------------------------------------------------------------------

/// Terms of a series below this are none to a pair of numbers, which holds 106 bits.
inline constexpr double kLeastOfSeries = 0x1p-120;          // share of it; > 0; geometry
/// Tables have an entry for every kTableStep; what is left of an argument is small enough for the series there.
inline constexpr int kTableSteps = 64;                      // steps in 1; >= 1; geometry
inline constexpr double kTableStep = 1.0 / kTableSteps;     // 1; 0 to 1; geometry
/// That of logarithms has those of numbers from 1 / sqrt(2), rounded down, to sqrt(2), rounded up.
inline constexpr int kFirstLogarithm = 45;                  // steps; >= 1; geometry
inline constexpr int kLastLogarithm = 91;                   // steps; > kFirstLogarithm; geometry

// ---- Memory ---------------------------------------------------------------------------------------------------------

/// A large page of the processors that we know, and from what size on a list is long.
inline constexpr size_t kLargePage = 0x200000;              // bytes; > 0; geometry

}  // namespace meander
