// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/medial_axis.h"

#include <algorithm>

#include "medial/constants.h"
#include "medial/empty_balls.h"

namespace meander {

void compute_medial_axis(const Frames& frames, const BoundaryObstacle& boundary, BoundaryRule rule,
                         const NodeData<Reach>& reach, ThreadPool& pool, CurveBvh& tree,
                         NodeData<Radii>& radii) {
  const size_t n = frames.position.size();
  radii.resize(n, Radii{0, 0});
  Table<Vec3> with_walls;
  if (rule == BoundaryRule::kObstacle && !boundary.empty()) {
    with_walls = frames.position.values();
    with_walls.insert(with_walls.end(), boundary.samples().begin(), boundary.samples().end());
  }
  tree.build(with_walls.empty() ? frames.position.values() : with_walls, pool);

  constexpr size_t kBlock = 256;
  pool.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
    std::array<Radii, kBlock> start;
    for (size_t i = begin; i < end; ++i) {
      for (size_t side = 0; side < 2; ++side) {
        const double most = std::max(0.0, reach[i][side].radius), last = radii[i][side];
        start[i - begin][side] = radii[i][side] = last > 0 ? std::min(most, kWarmth * last) : most;
      }
    }
    largest_balls(tree, {begin, end, frames.outward, radii}, SeeAll{});
    for (size_t i = begin; i < end; ++i) {
      for (size_t side = 0; side < 2; ++side) {
        const double most = reach[i][side].radius;
        // An empty ball that no point limits is only a lower bound: start again from the clamp.
        if (radii[i][side] < start[i - begin][side] || !(radii[i][side] < most)) continue;
        const BallStart from{frames.position[i], frames.outward[i][side]};
        radii[i][side] = largest_ball(tree, from, most, CountAll{}).radius;
      }
    }
  });
}

}  // namespace meander
