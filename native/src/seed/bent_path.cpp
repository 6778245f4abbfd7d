// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/bent_path.h"

#include <utility>

#include "geodesic/chart.h"
#include "seed/constants.h"

namespace meander {

std::optional<PathShape> bent_path(const LineNetwork& network, uint32_t from, uint32_t to, PathShortener& shortener,
                                   Path& path) {
  const Surface& s = network.surface();
  const LineNetwork::Node &a = network.nodes()[from], &b = network.nodes()[to];
  const double length = (b.place - a.place).norm();
  const Vec2 chord = length * unit(s.to_plane(a.point.face, b.place - a.place));
  std::optional<PathShape> best;
  for (int step = -kSidesteps; step <= kSidesteps; ++step) {
    Path legs;
    const Trace there = trace_geodesic(s, a.point, Vec2{0.5, kSidestep * step} * chord, legs);
    if (there.hit_boundary) continue;
    Chart chart = Chart::at(there.end, position(s, there.end));
    if (!chart.advance_to(s, b.point, b.place, 2 * length)) continue;
    trace_geodesic(s, there.end, chart.place, legs);
    const auto shape = shortener.adopt(a.point, b.point, legs);
    if (!shape || !(shape->length > 0) || (best && best->length <= shape->length)) continue;
    best = shape;
    path = std::move(legs);
  }
  return best;
}

}  // namespace meander
