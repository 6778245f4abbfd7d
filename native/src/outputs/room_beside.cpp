// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/room_beside.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/point_grid.h"
#include "base/segment_distance.h"
#include "outputs/constants.h"

namespace meander {
namespace {

/// Arc length up to every node of a strand, and of the whole of it.
struct ArcLengths {
  NodeData<double> at;
  NodeData<double> whole;
  NodeData<uint32_t> strand;

  explicit ArcLengths(const Curve& curve) : at(curve.size()), whole(curve.size()), strand(curve.size()) {
    for (uint32_t s = 0; s < curve.strands.size(); ++s) {
      double sum = 0;
      const Strand& strand_of = curve.strands[s];
      for (uint32_t i = strand_of.first; i < strand_of.end(); ++i) {
        at[i] = sum;
        strand[i] = s;
        if (curve.has_segment(i)) sum += curve.shapes[i].length;
      }
      for (uint32_t i = strand_of.first; i < strand_of.end(); ++i) whole[i] = strand_of.closed ? sum : 0;
    }
  }

  bool within(uint32_t i, uint32_t j, double reach) const {
    if (strand[i] != strand[j]) return false;
    const double away = std::abs(at[i] - at[j]);
    return away < reach || (whole[i] > 0 && whole[i] - away < reach);
  }
};

}  // namespace

NodeData<std::array<double, 2>> find_room(const Domain& domain, const Curve& curve, const NodeData<uint8_t>& movable,
                                          const NodeData<double>& radius, double most, double clearance,
                                          ThreadPool& pool) {
  const Surface& surface = *domain.surface;
  const SurfacePatches* const patches = domain.patches.get();
  std::vector<Vec3> places(curve.size());
  std::vector<uint32_t> patch(patches ? curve.size() : 0);
  pool.for_each(curve.size(), kNodeGrain, [&](uint32_t i) {
    places[i] = position(surface, curve.nodes[i]);
    if (patches) patch[i] = patches->patch_of(surface, curve.nodes[i]);
  });
  const ArcLengths arcs(curve);
  const double reach = 2 * clearance + 4 * most + kLongestSegment;
  NodeData<std::array<double, 2>> room(curve.size(), {0, 0});
  if (curve.size() == 0) return room;
  const auto [least, largest] = std::minmax_element(radius.begin(), radius.end());
  const PointGrid grid(places, reach * *least, reach * *largest, pool.poll(kNodeGrain));
  pool.for_each(curve.size(), kNodeGrain / 8, [&](uint32_t i) {
    if (!movable[i]) return;
    const double r = radius[i];
    const Vec2 tangent = unit(curve.shapes[curve.previous(i)].arriving + curve.shapes[i].leaving);
    const Vec3 left = surface.to_space(curve.nodes[i].face, Vec2{0, 1} * tangent);
    room[i] = {2 * most * r, 2 * most * r};
    grid.near(places[i], reach * r, [&](uint32_t j, double) {
      if (arcs.within(i, j, kSameTurn * r)) return;
      if (patches && patches->hidden(patch[i], patch[j])) return;
      Vec3 nearest = places[j];
      if (curve.has_segment(j)) {
        const Vec3 along = places[curve.next(j)] - places[j];
        const double squared = along.squaredNorm();
        if (squared > 0) nearest += std::clamp((places[i] - places[j]).dot(along) / squared, 0.0, 1.0) * along;
      }
      const Vec3 way = nearest - places[i];
      const double distance = way.norm();
      const double spare = std::max(0.0, 0.5 * (distance - 2 * clearance * std::max(r, radius[j])));
      const double side = distance > 0 ? way.dot(left) / distance : 0;
      double& there = room[i][side > 0 ? 0 : 1];
      if (std::abs(side) > kAcross) there = std::min(there, spare / std::abs(side));
    });
  });
  return room;
}

}  // namespace meander
