// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a variation, the number of one of many curves of the same settings, decides by.
#pragma once

#include <cstdint>
#include <initializer_list>

namespace meander {

/// A share in [0, 1) for each variation: 0 for the first, which is 0, and of those that follow each far from the ones
/// before (the multiples of the golden ratio; Knuth, "The Art of Computer Programming", vol. 3, section 6.4).
inline double share_of_variation(uint32_t variation) { return 0x1p-32 * (variation * 2654435769u); }

/// A number in [0, 1) for each place and variation that has nothing to do with any other (the finalizer of Steele, Lea
/// and Flood, "Fast Splittable Pseudorandom Number Generators", 2014).
inline double number_of_variation(uint32_t variation, uint32_t a, uint32_t b = 0) {
  uint64_t z = 0;
  for (const uint64_t part : {uint64_t{variation}, uint64_t{a}, uint64_t{b}}) {
    z = (z ^ part) + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
  }
  return 0x1p-53 * static_cast<double>(z >> 11);
}

}  // namespace meander
