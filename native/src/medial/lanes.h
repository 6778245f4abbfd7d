// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers side by side, which every compiler for every processor here knows (GCC's and Clang's vector types).
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace meander {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = int32_t __attribute__((vector_size(16)));
using Double2 = double __attribute__((vector_size(16)));
using Long2 = int64_t __attribute__((vector_size(16)));

template <class Lanes, class Number>
Lanes load(const Number* p) {
  Lanes v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline Float4 load(const float* p) { return load<Float4>(p); }
inline Float4 all(float v) { return Float4{v, v, v, v}; }
inline Double2 both(double v) { return Double2{v, v}; }
inline Float4 larger(Float4 a, Float4 b) { return a > b ? a : b; }
inline Float4 smaller(Float4 a, Float4 b) { return a < b ? a : b; }

/// A bit for each lane in which a comparison holds.
inline uint32_t lanes_of(Int4 comparison) {
  const Int4 bits = comparison & Int4{1, 2, 4, 8};
  uint64_t halves[2];
  std::memcpy(halves, &bits, sizeof halves);
  const uint64_t both_halves = halves[0] | halves[1];
  return static_cast<uint32_t>(both_halves | both_halves >> 32);
}

inline float rounded_down(double v) {
  const float f = static_cast<float>(v);
  return f <= v ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
}
inline float rounded_up(double v) {
  const float f = static_cast<float>(v);
  return f >= v ? f : std::nextafter(f, std::numeric_limits<float>::infinity());
}

}  // namespace meander
