// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces of every kind, and curves without a plan on them.
#pragma once

#include <vector>

#include "curves.h"

namespace meander::test {

inline std::vector<Mesh> varied_meshes() {
  return {sphere(2),
          torus(16, 8),
          cube(),
          octahedron(),
          with_noise(sphere(2), 0.3, 19),
          grid_with_hole(7),
          cone(12, 3, 1, true),
          flat_grid(1)};
}

/// Rings of very unequal segments, wherever there is room, and an open strand if there is still room for one.
inline Curve random_curve(const Surface& s, uint32_t rings, Rng& rng) {
  Curve curve;
  for (uint32_t k = 0; k < 10 * rings && curve.strands.size() < rings; ++k) {
    Curve next = curve;
    if (!add_ring(s, next, random_point(s, rng), rng.in(0.03, 0.15), 4 + rng.below(60), 0.15, rng)) continue;
    if (exact_crossings(s, next).empty()) curve = next;
  }
  for (int k = 0; k < 20; ++k) {
    Curve next = curve;
    add_walk(s, next, random_point(s, rng), rng.in(0.005, 0.06), 15, 0.3, rng);
    if (!exact_crossings(s, next).empty()) continue;
    curve = next;
    break;
  }
  return curve;
}

}  // namespace meander::test
