// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of a tree that are near a place.
#pragma once

#include <vector>

#include "medial/ball_region.h"

namespace meander {

/// Calls visit(i) for the indices of all points of a part nearer to `centre` than `radius`, in the order of the tree.
template <class Visit>
void visit_inside(const CurveBvh& tree, const Eigen::Vector3d& centre, double radius, const Visit& visit,
                  uint32_t part = 0) {
  StillBall region{RoundedBall(centre, Eigen::Vector3d::Zero(), radius)};
  tree.walk(part, region, [&](uint32_t run) {
    const size_t first = size_t{run} * CurveBvh::kRun, end = std::min(first + CurveBvh::kRun, tree.points().size());
    for (size_t i = first; i < end; ++i) {
      if ((tree.points()[i] - centre).squaredNorm() < radius * radius) visit(static_cast<uint32_t>(i));
    }
    return false;
  });
}

/// The same indices in rising order.
void find_inside(const CurveBvh& tree, const Eigen::Vector3d& centre, double radius, std::vector<uint32_t>& found,
                 uint32_t part = 0);

/// The distance of a place from the nearest point of a part, at most `most`.
double nearest_distance(const CurveBvh& tree, const Eigen::Vector3d& from, double most, uint32_t part = 0);

/// The point that is nearest to a place, of a tree of one part; where none is nearer than the `likely` one, that.
uint32_t nearest_point(const CurveBvh& tree, const Eigen::Vector3d& from, uint32_t likely);

}  // namespace meander
