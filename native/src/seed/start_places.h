// SPDX-License-Identifier: GPL-3.0-or-later
//
// Places in a face where lines may begin.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "mesh/surface.h"
#include "mesh/surface_point.h"
#include "seed/constants.h"

namespace meander {

/// Calls visit(place) for places in a face that are about kPlacesInFace from each other, in the local r: in
/// columns across its longest edge, so that a long face has as many as its area asks for. One that is smaller has one
/// in its middle.
template <class Visit>
void for_places_in_face(const Surface& surface, uint32_t f, double radius, const Visit& visit) {
  const auto parts = [&](double length) {
    const double count = std::ceil(length / (kPlacesInFace * radius));
    return static_cast<uint32_t>(std::clamp(count, 1.0, double{kMostRowsOfPlaces}));
  };
  uint32_t from = 0;
  for (uint32_t k = 1; k < 3; ++k) {
    if (norm(surface.along(3 * f + k)) > norm(surface.along(3 * f + from))) from = k;
  }
  const uint32_t to = (from + 1) % 3, apex = (from + 2) % 3;
  const Vec2 along = surface.along(3 * f + from);
  const double longest = norm(along), height = 2 * surface.face_area(f) / longest;
  const uint32_t columns = parts(longest);
  if (columns == 1) return visit(make_point(f, 1, 1, 1));
  const double foot = dot(-surface.along(3 * f + apex), along) / (longest * longest);  // of the height
  for (uint32_t i = 0; i < columns; ++i) {
    const double share = (i + 0.5) / columns;
    const bool before = share < foot;
    const double top = before ? share / foot : (1 - share) / (1 - foot);  // of the height, where the column ends
    const uint32_t count = parts(top * height);
    for (uint32_t j = 0; j < count; ++j) {
      const double up = (j + 1.0 / 3) / count;
      std::array<double, 3> weights{};
      weights[from] = (1 - up) * (1 - share) + up * (before ? 1 - top : 0);
      weights[to] = (1 - up) * share + up * (before ? 0 : 1 - top);
      weights[apex] = up * top;
      visit(make_point(f, weights[0], weights[1], weights[2]));
    }
  }
}

}  // namespace meander
