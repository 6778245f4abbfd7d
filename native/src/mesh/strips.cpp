// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/strips.h"

#include <cmath>
#include <limits>

namespace meander {

std::vector<double> strip_widths(const Surface& surface) {
  std::vector<double> area(surface.component_count(), 0), edge(surface.component_count(), 0);
  for (uint32_t f = 0; f < surface.face_count(); ++f) area[surface.component(f)] += surface.face_area(f);
  for (const HalfEdge e : surface.boundary()) edge[surface.component(face_of(e))] += norm(surface.along(e));
  std::vector<double> widths(area.size(), std::numeric_limits<double>::infinity());
  for (size_t k = 0; k < area.size(); ++k) {
    const double mean = edge[k] / 4, apart = mean * mean - area[k];
    if (!(apart > 0)) continue;
    const double width = mean - std::sqrt(apart);
    if (2 * mean - width > kLeastStrip * width) widths[k] = width;
  }
  return widths;
}

}  // namespace meander
