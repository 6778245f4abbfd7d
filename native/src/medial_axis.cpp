// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial_axis.h"

#include <algorithm>

#include "run_tree.h"

namespace meander {
namespace {

/// A ball may start this much larger than the node's last one before it is known to be large enough.
constexpr double kWarmth = 1.2;

/// The largest empty ball, found sooner where the last radius still is a good guess.
double largest_ball(const RunTree& tree, const Vec3& x, const Vec3& outward, double most, double last) {
  const double start = last > 0 ? std::min(most, kWarmth * last) : most;
  const double radius = tree.largest_ball(x, outward, start);
  // An empty ball that no point limits is only a lower bound: start again from the clamp.
  return radius < start || start == most ? radius : tree.largest_ball(x, outward, most);
}

}  // namespace

void compute_medial_axis(const Frames& frames, const BoundaryObstacle& boundary, BoundaryRule rule,
                         const std::vector<Reach>& reach, Team& team, std::vector<Radii>& radii) {
  const size_t n = frames.position.size();
  radii.resize(n, Radii{0, 0});
  std::vector<Vec3> obstacles = frames.position;
  const bool walls = rule == BoundaryRule::kObstacle;
  if (walls) obstacles.insert(obstacles.end(), boundary.samples().begin(), boundary.samples().end());
  const RunTree tree(obstacles, team);

  constexpr size_t kBlock = 256;
  team.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      for (size_t side = 0; side < 2; ++side) {
        const double most = reach[i][side].radius;
        radii[i][side] =
            most > 0 ? largest_ball(tree, frames.position[i], frames.outward[i][side], most, radii[i][side]) : 0;
      }
    }
  });
}

}  // namespace meander
