// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/near_points.h"

#include <cmath>

namespace meander {
namespace {

/// The run that holds the nearest point of a part, where one is nearer than `radius`; else UINT32_MAX. And how far
/// that is.
struct NearestRun {
  uint32_t run = UINT32_MAX;
  double radius;
};

NearestRun nearest_run(const CurveBvh& tree, const Eigen::Vector3d& from, double squared, double radius,
                       uint32_t part) {
  // A ball that grows to no side is one around the place.
  const Eigen::Vector3d nowhere = Eigen::Vector3d::Zero();
  NearestRun nearest{UINT32_MAX, radius};
  ShrinkingBall<true> region{from, nowhere, nearest.radius};
  tree.walk(part, region, [&](uint32_t run) {
    const CurveBvh::Points& p = tree.lanes(run);
    Double2 least = both(squared);
    for (size_t k = 0; k < CurveBvh::kRun; k += 2) {
      const Double2 x = load<Double2>(p.x + k) - both(from.x()), y = load<Double2>(p.y + k) - both(from.y()),
                    z = load<Double2>(p.z + k) - both(from.z());
      const Double2 here = x * x + y * y + z * z;
      least = here < least ? here : least;
    }
    const double before = squared;
    squared = std::min(least[0], least[1]);
    if (squared < before) nearest = {run, std::sqrt(squared)};
    return squared < before;
  });
  return nearest;
}

}  // namespace

void find_inside(const CurveBvh& tree, const Eigen::Vector3d& centre, double radius, std::vector<uint32_t>& found,
                 uint32_t part) {
  found.clear();
  visit_inside(tree, centre, radius, [&](uint32_t i) { found.push_back(i); }, part);
  std::sort(found.begin(), found.end());
}

double nearest_distance(const CurveBvh& tree, const Eigen::Vector3d& from, double most, uint32_t part) {
  return nearest_run(tree, from, most * most, most, part).radius;
}

uint32_t nearest_point(const CurveBvh& tree, const Eigen::Vector3d& from, uint32_t likely) {
  const auto squared = [&](uint32_t i) { return (tree.points()[i] - from).squaredNorm(); };
  const double most = squared(likely);
  const uint32_t run = nearest_run(tree, from, most, std::sqrt(most), 0).run;
  if (run == UINT32_MAX) return likely;
  const auto first = run * CurveBvh::kRun;
  const auto end = static_cast<uint32_t>(std::min<size_t>(first + CurveBvh::kRun, tree.points().size()));
  uint32_t nearest = first;
  for (uint32_t i = first + 1; i < end; ++i) {
    if (squared(i) < squared(nearest)) nearest = i;
  }
  return nearest;
}

}  // namespace meander
