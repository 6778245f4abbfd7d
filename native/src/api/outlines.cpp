// SPDX-License-Identifier: GPL-3.0-or-later
//
// Outlines along the boundary.
#include <algorithm>
#include <cmath>

#include "api/guard.h"
#include "geodesic/outline.h"

using namespace meander;

meander_status meander_surface_find_outlines(const meander_surface* surface, double distance, double spacing,
                                             double* positions, size_t point_capacity, size_t* point_count,
                                             uint64_t* offsets, uint8_t* closed, size_t strand_capacity,
                                             size_t* strand_count, size_t* skipped_count, meander_context* context,
                                             meander_error* error) {
  return guard(error, [&] {
    require(surface != nullptr, "The surface is NULL.");
    require(point_count != nullptr && strand_count != nullptr, "A pointer for a count is NULL.");
    const Surface& s = *surface->surface;
    if (!(std::isfinite(spacing) && spacing > 0 && spacing <= s.scale())) {
      refuse("The spacing of an outline must be positive and no larger than the surface; it is " + number(spacing) +
             ".");
    }
    require_range(distance / spacing, 0.1, 2, "distance of an outline (in spacings)");
    check_cancelled(context);
    const Outlines outlines = find_outlines(s, distance / s.scale(), 0.5 * spacing / s.scale(),
                                            [context] { return cancelled(context); });
    const size_t points = outlines.points.size(), strands = outlines.closed.size();
    const bool fits = points <= point_capacity && strands <= strand_capacity;
    if (fits) require(positions && offsets && closed, "An array for the outlines is NULL.");
    *point_count = points;
    *strand_count = strands;
    if (skipped_count) *skipped_count = outlines.skipped;
    if (!fits) return;
    for (size_t i = 0; i < points; ++i) std::copy_n(outlines.points[i].data(), 3, positions + 3 * i);
    std::ranges::copy(outlines.offsets, offsets);
    std::ranges::copy(outlines.closed, closed);
  });
}
