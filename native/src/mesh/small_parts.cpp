// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <limits>

#include "base/disjoint_sets.h"
#include "base/failure.h"
#include "mesh/repairs.h"

namespace meander {

void drop_small_parts(Soup& soup, double size, PrepareCounts& counts) {
  CancelToken poll = soup.poll();
  const auto positions = soup.positions();
  DisjointSets parts(positions.size());
  for (const Triangle& t : soup.faces()) {
    poll();
    parts.join(t[0], t[1]);
    parts.join(t[0], t[2]);
  }
  const Soup::Vec3 infinite = Soup::Vec3::Constant(std::numeric_limits<double>::infinity());
  std::vector<Soup::Vec3> low(positions.size(), infinite), high(positions.size(), -infinite);
  for (const Triangle& t : soup.faces()) {
    poll();
    const uint32_t part = parts.find(t[0]);
    for (const uint32_t v : t) {
      low[part] = low[part].cwiseMin(positions[v]);
      high[part] = high[part].cwiseMax(positions[v]);
    }
  }
  double largest = 0;
  for (uint32_t v = 0; v < positions.size(); ++v) {
    if (!(high[v].x() >= low[v].x())) continue;  // no part, or none that is named so
    const double diagonal = (high[v] - low[v]).norm();
    largest = std::max(largest, diagonal);
    counts.small_parts += diagonal < size;
  }
  if (largest < size) {
    throw Failure(FailureKind::kInvalidMesh, "All parts of the mesh are smaller than " + number(size) +
                                                 ", the largest one is " + number(largest) +
                                                 "; choose a smaller size of the smallest part.");
  }
  soup.leave_out_where([&](uint32_t f) {
    const uint32_t part = parts.find(soup.faces()[f][0]);
    return (high[part] - low[part]).norm() < size;
  });
}

}  // namespace meander
