// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/polylines.h"

#include <algorithm>

namespace meander {

std::array<double, 3> crossing_weights(const Crossing& c) {
  std::array<double, 3> w{0, 0, 0};
  w[corner_of(c.e)] = 1 - c.t;
  w[next_corner(corner_of(c.e))] = c.t;
  return w;
}

Vec3 caller_point(const Surface& surface, uint32_t face, const std::array<double, 3>& w) {
  const Triangle& t = surface.face(face);
  return w[0] * surface.caller_position(t[0]) + w[1] * surface.caller_position(t[1]) +
         w[2] * surface.caller_position(t[2]);
}

size_t polyline_point_count(const Curve& curve) {
  size_t points = curve.size();
  for (const Path& path : curve.paths) points += path.size();
  return points;
}

void Polylines::copy_from(const Surface& surface, const Curve& curve) {
  positions.clear();
  positions.reserve(polyline_point_count(curve));
  offsets.clear();
  closed.clear();
  guides.clear();
  for (const Strand& strand : curve.strands) {
    offsets.push_back(positions.size());
    closed.push_back(strand.closed);
    guides.push_back(strand.guide);
    for (uint32_t i = strand.first; i < strand.end(); ++i) {
      const SurfacePoint& node = curve.nodes[i];
      positions.push_back(caller_point(surface, node.face, {node.weight(0), node.b.x, node.b.y}));
      for (const Crossing& c : curve.paths[i]) {
        positions.push_back(caller_point(surface, face_of(c.e), crossing_weights(c)));
      }
    }
  }
  offsets.push_back(positions.size());
}

}  // namespace meander
