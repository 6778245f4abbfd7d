// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/room.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace meander {
namespace {

/// A quarter of the width of every component that is a strip; infinite elsewhere.
std::vector<double> quarter_widths(const Surface& surface) {
  std::vector<double> area(surface.component_count(), 0), edge(surface.component_count(), 0);
  for (uint32_t f = 0; f < surface.face_count(); ++f) area[surface.component(f)] += surface.face_area(f);
  for (const HalfEdge e : surface.boundary()) edge[surface.component(face_of(e))] += norm(surface.along(e));
  std::vector<double> quarter(area.size(), std::numeric_limits<double>::infinity());
  for (size_t k = 0; k < area.size(); ++k) {
    const double mean = edge[k] / 4, apart = mean * mean - area[k];
    if (!(apart > 0)) continue;
    const double width = mean - std::sqrt(apart);
    if (2 * mean - width > kLeastStrip * width) quarter[k] = width / 4;
  }
  return quarter;
}

}  // namespace

Room leave_room(const Surface& surface, const Curve& curve, RadiusField& radius) {
  if (surface.boundary().empty()) return {};
  std::vector<double> largest = quarter_widths(surface);
  if (*std::ranges::min_element(largest) >= radius.most()) return {};
  std::vector<uint8_t> open(largest.size(), 0);
  for (const Strand& strand : curve.strands) {
    if (!strand.closed && !strand.guide) open[surface.component(curve.nodes[strand.first].face)] = 1;
  }
  for (size_t k = 0; k < largest.size(); ++k) {
    if (open[k]) largest[k] *= 2;
  }
  if (*std::ranges::min_element(largest) >= radius.most()) return {true, false};
  VertexData<double> most(surface.vertex_count());
  std::ranges::fill(most, std::numeric_limits<double>::infinity());
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    for (const uint32_t v : surface.face(f)) most[v] = largest[surface.component(f)];
  }
  const RadiusField before = radius;
  radius.limit(most, kLeastRoom);
  return {true, radius != before};
}

}  // namespace meander
