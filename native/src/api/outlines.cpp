// SPDX-License-Identifier: GPL-3.0-or-later
//
// Outlines along the boundary.
#include <cmath>

#include "api/guard.h"
#include "api/results.h"
#include "seed/outline.h"

using namespace meander;

namespace {

struct OutlineArrays {
  std::vector<Vec3> points;
  std::vector<uint64_t> offsets;
  std::vector<uint8_t> closed;
};

}  // namespace

meander_status meander_surface_find_outlines(const meander_surface* surface, double distance, double spacing,
                                             meander_outlines* outlines, meander_context* context,
                                             meander_error* error) {
  return guard(error, [&] {
    require(surface != nullptr, "The surface is NULL.");
    require_struct(outlines);
    const Surface& s = *surface->surface;
    if (!(std::isfinite(spacing) && spacing > 0 && spacing <= s.scale())) {
      refuse("The spacing of an outline must be positive and no larger than the surface; it is " + number(spacing) +
             ".");
    }
    require_range(distance / spacing, 0.1, 2, "distance of an outline (in spacings)");
    check_cancelled(context);
    Outlines found = find_outlines(s, distance / s.scale(), 0.5 * spacing / s.scale(),
                                   cancel_of(context));
    OutlineArrays arrays{std::move(found.points), {found.offsets.begin(), found.offsets.end()},
                         std::move(found.closed)};
    hand_out(outlines, std::move(arrays), [&found](const OutlineArrays& lines, meander_outlines& o) {
      o.point_count = lines.points.size();
      o.strand_count = lines.closed.size();
      o.skipped_count = found.skipped;
      point_to(o.positions, lines.points);
      point_to(o.offsets, lines.offsets);
      point_to(o.closed, lines.closed);
    });
  });
}
