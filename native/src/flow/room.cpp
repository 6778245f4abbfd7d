// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/room.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "mesh/strips.h"

namespace meander {
Room leave_room(const Surface& surface, const Curve& curve, RadiusField& radius) {
  if (surface.boundary().empty()) return {};
  std::vector<double> largest = strip_widths(surface);
  for (double& width : largest) width /= 4;
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
