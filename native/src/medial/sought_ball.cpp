// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/sought_ball.h"

#include "medial/constants.h"

namespace meander {

bool SoughtBall::alike(uint32_t p) const {
  const SurfacePatches& patches = scene.patches;
  const Obstacles& obstacles = scene.obstacles;
  const uint32_t to = obstacles.patch(p);
  if (patches.bent(patch) || patches.bent(to)) return false;
  // That of the patch, where it is of one face of a crease only.
  const auto normal_at = [&](uint32_t i, uint32_t of) -> const Vec3& {
    return patches.at_crease(of) ? scene.surface.face_normal(obstacles.point(i).face) : patches.normal(of);
  };
  const Vec3 &a = normal_at(node, patch), &b = normal_at(p, to);
  if (a.dot(b) < kAlikeNormals) return false;
  const Vec3 d = obstacles.positions()[p] - position();
  const double rise = kMostRise * d.norm();
  return std::abs(d.dot(a)) <= rise && std::abs(d.dot(b)) <= rise;
}

StrandNeighbours::StrandNeighbours(const SoughtBall& ball)
    : nodes{ball.scene.curve.previous(ball.node), ball.scene.curve.next(ball.node)}, radius(ball.most) {
  const GeodesicScene& scene = ball.scene;
  for (uint32_t& q : nodes) {
    if (q == kNone) continue;
    Chart chart = ball.here();
    if (chart.advance_to(scene.surface, scene.curve.nodes[q], scene.frames.position[q], ball.r)) {
      radius = ball.limited(radius, chart.place);
    } else {
      q = kNone;
    }
  }
}

}  // namespace meander
