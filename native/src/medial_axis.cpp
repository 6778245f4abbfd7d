// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geodesic_trace.h"
#include "run_tree.h"

namespace meander {
namespace {

/// A ball may start this much larger than the node's last one before it is known to be large enough.
constexpr double kWarmth = 1.2;

std::vector<Vec3> sample_boundary(const Surface& surface, double step, std::vector<HalfEdge>& edges) {
  std::vector<Vec3> samples;
  for (const HalfEdge e : surface.boundary()) {
    const Triangle& t = surface.face(face_of(e));
    const Vec3& a = surface.position(t[corner_of(e)]);
    const Vec3& b = surface.position(t[next_corner(corner_of(e))]);
    const int pieces = std::max(1, static_cast<int>(std::min(1e6, std::ceil((b - a).norm() / step))));
    for (int k = 0; k < pieces; ++k) {
      samples.push_back(a + (b - a) * (double(k) / pieces));
      edges.push_back(e);
    }
  }
  return samples;
}

/// The largest empty ball, found sooner where the last radius still is a good guess.
double largest_ball(const RunTree& tree, const Vec3& x, const Vec3& outward, double most, double last) {
  const double start = last > 0 ? std::min(most, kWarmth * last) : most;
  const double radius = tree.largest_ball(x, outward, start);
  // An empty ball that no point limits is only a lower bound: start again from the clamp.
  return radius < start || start == most ? radius : tree.largest_ball(x, outward, most);
}

}  // namespace

BoundaryObstacle::BoundaryObstacle(const Surface& surface, double step)
    : tree_(sample_boundary(surface, step, edges_)) {}

std::array<Reach, 2> reach_of_balls(const Surface& surface, const Curve& curve, const Frames& frames,
                                    const BoundaryObstacle& boundary, uint32_t node, double max_radius,
                                    double overhang, double least_rest, std::vector<Crossing>& scratch) {
  std::array<Reach, 2> reach{Reach{max_radius, max_radius}, Reach{max_radius, max_radius}};
  if (boundary.empty()) return reach;
  // From here on the boundary is too far to end a ball; never less than twice the clamp, so that a
  // winding way to it counts as well.
  const double far = std::max(2 * max_radius, max_radius - 2 * overhang);
  if (!boundary.tree().nearest(frames.position[node], far * far)) return reach;
  for (int side = 0; side < 2; ++side) {
    double& radius = reach[side].radius;
    double length = frames.to_boundary[node][side];
    if (length < 0) {
      scratch.clear();
      const double way = max_radius + std::max(0.0, -overhang);
      const Vec2 direction = (side == 0 ? 1.0 : -1.0) * frames.bitangent2[node];
      const Trace trace = trace_geodesic(surface, curve.nodes[node], way * direction, scratch);
      length = trace.hit_boundary ? trace.length : std::numeric_limits<double>::infinity();
    }
    radius = std::min(max_radius, length + overhang);
    reach[side].centre = std::min(max_radius, length);
    // Nearer than is wanted the boundary pushes twice as hard: two strands that are squeezed between
    // boundaries would else settle at half of their distance from each other.
    if (radius < least_rest) radius -= least_rest - radius;
  }
  return reach;
}

void compute_medial_axis(const Surface& surface, const Curve& curve, const Frames& frames,
                         const BoundaryObstacle& boundary, BoundaryRule rule,
                         const std::vector<double>& max_radius, const std::vector<double>& overhang,
                         const std::vector<double>& least_rest, Team& team, std::vector<Radii>& radii) {
  const uint32_t n = curve.size();
  radii.resize(n, Radii{0, 0});
  std::vector<Vec3> obstacles = frames.position;
  const bool walls = rule == BoundaryRule::kObstacle;
  if (walls) obstacles.insert(obstacles.end(), boundary.samples().begin(), boundary.samples().end());
  const RunTree tree(obstacles, team);

  constexpr size_t kBlock = 256;
  team.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
    std::vector<Crossing> scratch;
    for (uint32_t i = static_cast<uint32_t>(begin); i < end; ++i) {
      const Vec3& x = frames.position[i];
      std::array<Reach, 2> reach{Reach{max_radius[i], max_radius[i]}, Reach{max_radius[i], max_radius[i]}};
      if (!walls) reach = reach_of_balls(surface, curve, frames, boundary, i, max_radius[i], overhang[i], least_rest[i],
                                          scratch);
      for (int side = 0; side < 2; ++side) {
        const double most = reach[side].radius;
        radii[i][side] = most > 0 ? largest_ball(tree, x, frames.outward[i][side], most, radii[i][side]) : 0;
      }
    }
  });
}

}  // namespace meander
