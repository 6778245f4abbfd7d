// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repairs.h"
#include "mesh/shared_places.h"

namespace meander {

void merge_vertices(Soup& soup, double distance, PrepareCounts& counts) {
  const std::vector<uint32_t> place = shared_places(soup.positions(), soup.used(), distance, 2, soup.poll());
  for (uint32_t v = 0; v < place.size(); ++v) counts.merged_vertices += place[v] != v;
  counts.dropped_faces += soup.rename([&](uint32_t v) { return place[v]; });
}

}  // namespace meander
