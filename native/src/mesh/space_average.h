// SPDX-License-Identifier: GPL-3.0-or-later
//
// Averages over about r, through space, of what is known at the vertices.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

#include "base/cancel_token.h"
#include "mesh/radius_field.h"

namespace meander {

/// `Count` numbers of every vertex, added up over the corners of a lattice of cubes, each number shared out to the
/// eight corners around its vertex. Read between the corners, and divided by one another, such sums are averages over
/// a ball of about 1.2 cubes that change continuously with the place. In time and memory linear in the vertices,
/// however many of them a cube holds.
template <size_t Count>
class SpaceSums {
 public:
  using Sums = std::array<double, Count>;

  /// `size`  of a cube, positive
  explicit SpaceSums(double size) : to_cubes_(std::min(1 / size, std::numeric_limits<double>::max())) {}

  void add(const Vec3& p, const Sums& values) {
    const CubeShares place = find(p, true);
    for (size_t k = 0; k < 8; ++k) {
      Sums& there = sums_[place.corner[k]];
      for (size_t n = 0; n < Count; ++n) there[n] += place.share[k] * values[n];
    }
  }

  /// The sums at a place near to which something has been added.
  Sums at(const Vec3& p) {
    const CubeShares place = find(p, false);
    Sums result{};
    for (size_t k = 0; k < 8; ++k) {
      if (place.corner[k] == kNone) continue;
      for (size_t n = 0; n < Count; ++n) result[n] += place.share[k] * sums_[place.corner[k]][n];
    }
    return result;
  }

  /// What all corners hold, to be changed.
  std::vector<Sums>& corners() { return sums_; }

 private:
  using Cube = std::array<int64_t, 3>;
  struct CubeShares {
    std::array<uint32_t, 8> corner;
    std::array<double, 8> share;
  };

  CubeShares find(const Vec3& p, bool make) {
    CubeShares place;
    Cube cube;
    std::array<double, 3> t;
    for (size_t k = 0; k < 3; ++k) {
      // What is 2^62 cubes away and farther shares the last one.
      const double x = std::clamp(to_cubes_ * p[static_cast<Eigen::Index>(k)], -0x1p62, 0x1p62);
      const double low = std::floor(x);
      cube[k] = static_cast<int64_t>(low);
      t[k] = x - low;
    }
    // Vertices that follow one another are near one another: most are in the cube of the one before.
    if (cube != last_ || (make && !last_made_)) {
      for (size_t k = 0; k < 8; ++k) last_corners_[k] = corner(beside(cube, k), make);
      last_ = cube;
      last_made_ = make;
    }
    place.corner = last_corners_;
    for (size_t k = 0; k < 8; ++k) {
      place.share[k] = (k & 1 ? t[0] : 1 - t[0]) * (k & 2 ? t[1] : 1 - t[1]) * (k & 4 ? t[2] : 1 - t[2]);
    }
    return place;
  }

  static Cube beside(const Cube& cube, size_t k) {
    return {cube[0] + static_cast<int64_t>(k & 1), cube[1] + static_cast<int64_t>(k >> 1 & 1),
            cube[2] + static_cast<int64_t>(k >> 2 & 1)};
  }
  struct Hash {
    size_t operator()(const Cube& cube) const {
      uint64_t h = 0;
      for (const int64_t x : cube) h = (h ^ static_cast<uint64_t>(x)) * 0x9e3779b97f4a7c15u, h ^= h >> 29;
      return static_cast<size_t>(h);
    }
  };

  uint32_t corner(const Cube& cube, bool make) {
    if (!make) {
      const auto found = numbers_.find(cube);
      return found == numbers_.end() ? kNone : found->second;
    }
    const auto [place, is_new] = numbers_.try_emplace(cube, static_cast<uint32_t>(sums_.size()));
    if (is_new) sums_.push_back({});
    return place->second;
  }

  double to_cubes_;
  std::vector<Sums> sums_;
  std::unordered_map<Cube, uint32_t, Hash> numbers_;  // in the order of their first vertices; never gone through
  Cube last_{};
  std::array<uint32_t, 8> last_corners_{};
  bool last_made_ = false;
};

/// An average over about the local r for every vertex. Where r varies, lattices of cubes twice as large as those before
/// serve, and between two of them the average is in between as well, so that it follows r continuously.
///
/// `add(v)`       gives the sums that vertex v adds
/// `finish(sums)` is called once for all corners of a lattice, before any is read
/// `read(v, sums, share)` is called once or twice a vertex, with shares whose sum is 1
template <size_t Count, class Add, class Finish, class Read>
void average_over_radius(const Surface& surface, const RadiusField& radius, double cubes_of_radius, CancelToken poll,
                         const Add& add, const Finish& finish, const Read& read) {
  const auto n = static_cast<uint32_t>(surface.vertex_count());
  const double least = radius.least();
  // r = least (1 + fraction) 2^octave
  const auto octave_of = [&](uint32_t v, double& fraction) {
    int exponent = 0;
    fraction = 2 * std::frexp(std::max(1.0, radius.at(v) / least), &exponent) - 1;
    return exponent - 1;
  };
  int octaves = 0;
  bool between = false;
  for (uint32_t v = 0; radius.varies() && v < n; ++v) {
    double fraction = 0;
    octaves = std::max(octaves, octave_of(v, fraction));
    between = between || fraction > 0;
  }
  for (int octave = 0; octave <= octaves + (between ? 1 : 0); ++octave) {
    SpaceSums<Count> sums(std::ldexp(cubes_of_radius * least, octave));
    for (uint32_t v = 0; v < n; ++v) {
      poll();
      // What no face uses may lie nowhere.
      if (surface.position(v).allFinite()) sums.add(surface.position(v), add(v));
    }
    if (!finish(sums.corners())) continue;
    for (uint32_t v = 0; v < n; ++v) {
      poll();
      double fraction = 0;
      const int own = octave_of(v, fraction);
      const double share = own == octave ? 1 - fraction : (own + 1 == octave ? fraction : 0);
      if (share > 0 && surface.position(v).allFinite()) read(v, sums.at(surface.position(v)), share);
    }
  }
}

}  // namespace meander
