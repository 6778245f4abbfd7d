// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/near_points.h"

#include <cmath>

namespace meander {

void find_inside(const CurveBvh& tree, const Eigen::Vector3d& centre, double radius, std::vector<uint32_t>& found,
                 uint32_t part) {
  found.clear();
  visit_inside(tree, centre, radius, [&](uint32_t i) { found.push_back(i); }, part);
  std::sort(found.begin(), found.end());
}

double nearest_distance(const CurveBvh& tree, const Eigen::Vector3d& from, double most, uint32_t part) {
  // A ball that grows to no side is one around the place.
  const Eigen::Vector3d nowhere = Eigen::Vector3d::Zero();
  double radius = most, nearest = most * most;
  ShrinkingBall<true> region{from, nowhere, radius};
  tree.walk(part, region, [&](uint32_t run) {
    const CurveBvh::Points& p = tree.lanes(run);
    Double2 least = both(nearest);
    for (size_t k = 0; k < CurveBvh::kRun; k += 2) {
      const Double2 x = load<Double2>(p.x + k) - both(from.x()), y = load<Double2>(p.y + k) - both(from.y()),
                    z = load<Double2>(p.z + k) - both(from.z());
      const Double2 squared = x * x + y * y + z * z;
      least = squared < least ? squared : least;
    }
    const double before = nearest;
    nearest = std::min(least[0], least[1]);
    if (nearest < before) radius = std::sqrt(nearest);
    return nearest < before;
  });
  return radius;
}

}  // namespace meander
