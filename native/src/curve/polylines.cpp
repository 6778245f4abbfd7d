// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/polylines.h"

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

double polyline_length(const Surface& surface, const Curve& curve) {
  double length = 0;
  for (uint32_t i = 0; i < curve.size(); ++i) {
    if (!curve.has_segment(i)) continue;
    Vec3 from = position(surface, curve.nodes[i]);
    const auto go_to = [&](const Vec3& to) {
      length += (to - from).norm();
      from = to;
    };
    for (const Crossing& c : curve.paths[i]) go_to(position(surface, c));
    go_to(position(surface, curve.nodes[curve.next(i)]));
  }
  return length;
}

void write_polylines(const Surface& surface, const Curve& curve, const NormalField& field, double* positions,
                     double* normals, uint64_t* offsets, uint8_t* closed) {
  size_t p = 0;
  const auto put = [&](uint32_t face, const std::array<double, 3>& w) {
    const Vec3 x = caller_point(surface, face, w);
    std::copy(x.data(), x.data() + 3, positions + 3 * p);
    if (normals) {
      const Vec3 normal = field.blended(face, w[0], w[1], w[2]);
      std::copy(normal.data(), normal.data() + 3, normals + 3 * p);
    }
    ++p;
  };
  for (size_t s = 0; s < curve.strands.size(); ++s) {
    const Strand& strand = curve.strands[s];
    offsets[s] = p;
    closed[s] = strand.closed;
    for (uint32_t i = strand.first; i < strand.end(); ++i) {
      const SurfacePoint& node = curve.nodes[i];
      put(node.face, {node.weight(0), node.b.x, node.b.y});
      for (const Crossing& c : curve.paths[i]) put(face_of(c.e), crossing_weights(c));
    }
  }
  offsets[curve.strands.size()] = p;
}

void Polylines::copy_from(const Surface& surface, const Curve& curve, const NormalField& field) {
  const size_t points = polyline_point_count(curve);
  const size_t strands = curve.strands.size();
  positions.resize(3 * points);
  normals.resize(3 * points);
  offsets.resize(strands + 1);
  closed.resize(strands);
  write_polylines(surface, curve, field, positions.data(), normals.data(), offsets.data(), closed.data());
}

}  // namespace meander
