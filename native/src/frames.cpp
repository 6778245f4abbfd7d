// SPDX-License-Identifier: GPL-3.0-or-later
#include "frames.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "geodesic_trace.h"

namespace meander {
namespace {

/// Averaging passes over the one-ring; a pass spreads by about one edge length.
constexpr double kMostPasses = 40;

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const double n = v.norm();
  return n > 0 ? Vec3(v / n) : otherwise;
}

/// From the nearest edge of the point's face.
double distance_to_edges(const Surface& surface, const SurfacePoint& p) {
  return std::min({p.weight(0) * surface.height(p.face, 0), p.weight(1) * surface.height(p.face, 1),
                   p.weight(2) * surface.height(p.face, 2)});
}

}  // namespace

NormalField::NormalField(const Surface& surface, double radius) : surface_(surface) {
  normals_.assign(surface.vertex_count(), Vec3::Zero());
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    for (uint32_t k = 0; k < 3; ++k) {
      normals_[surface.face(f)[k]] += surface.corner_angle(f, k) * surface.face_normal(f);
    }
  }
  for (Vec3& n : normals_) n = unit_or(n, Vec3::Zero());

  const double edges = 0.5 * radius / surface.mean_edge_length();
  const int passes = static_cast<int>(std::min(kMostPasses, std::floor(edges * edges)));
  for (int pass = 0; pass < passes; ++pass) {
    std::vector<Vec3> sum(normals_);
    for (uint32_t f = 0; f < surface.face_count(); ++f) {
      const Triangle& t = surface.face(f);
      const Vec3 all = normals_[t[0]] + normals_[t[1]] + normals_[t[2]];
      // Each neighbour is met in two faces, so it counts half of each time.
      for (uint32_t k = 0; k < 3; ++k) sum[t[k]] += 0.5 * (all - normals_[t[k]]);
    }
    for (size_t v = 0; v < sum.size(); ++v) normals_[v] = unit_or(sum[v], normals_[v]);
  }
}

Vec3 NormalField::blended(uint32_t f, double w0, double w1, double w2) const {
  const Triangle& t = surface_.face(f);
  return unit_or(w0 * normals_[t[0]] + w1 * normals_[t[1]] + w2 * normals_[t[2]], surface_.face_normal(f));
}

void compute_frames(const Surface& surface, const Curve& curve, const std::vector<double>& local_radius,
                    const std::vector<double>& vertex_radius, Team& team, Frames& frames) {
  const uint32_t n = curve.size();
  frames.position.resize(n);
  frames.tangent.resize(n);
  frames.bitangent2.resize(n);
  frames.outward.resize(n);
  frames.to_boundary.resize(n);
  frames.radius_slope.resize(n);
  constexpr size_t kBlock = 512;
  team.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) frames.position[i] = position(surface, curve.nodes[i]);
  });
  team.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
    Path scratch;
    for (uint32_t i = static_cast<uint32_t>(begin); i < end; ++i) {
      const uint32_t before = curve.previous(i), after = curve.next(i);
      const Vec2 in = before != kNone ? curve.shapes[before].arriving : curve.shapes[i].leaving;
      const Vec2 out = after != kNone ? curve.shapes[i].leaving : curve.shapes[before].arriving;
      Vec2 t = unit(in + out);
      if (!(dot(t, t) > 0)) t = Vec2{0, 1} * in;  // a full turn back has no bisector
      frames.tangent[i] = t;
      frames.bitangent2[i] = Vec2{0, -1} * t;
      // In space the tangent spans both segments, so that one small face does not decide it.
      const uint32_t face = curve.nodes[i].face;
      const Vec3& x = frames.position[i];
      Vec3 tangent = Vec3::Zero();
      if (before != kNone) tangent += unit_or(x - frames.position[before], Vec3::Zero());
      if (after != kNone) tangent += unit_or(frames.position[after] - x, Vec3::Zero());
      const Vec3 face_tangent = surface.to_space(face, t);
      tangent = unit_or(tangent, face_tangent);
      // Far enough from all edges of its face a node needs no walk.
      const bool inside = distance_to_edges(surface, curve.nodes[i]) > local_radius[i];
      for (int side = 0; side < 2; ++side) {
        const Vec2 flat_direction = (side == 0 ? 1.0 : -1.0) * frames.bitangent2[i];
        scratch.clear();
        const Vec2 way = local_radius[i] * flat_direction;
        Trace trace;
        if (inside) {
          trace.end = point_at(surface, face, flat(surface, curve.nodes[i]) + way);
          trace.length = local_radius[i];
        } else {
          trace = trace_geodesic(surface, curve.nodes[i], way, scratch);
        }
        const Vec3 face_direction = surface.to_space(face, flat_direction);
        Vec3 chord = scratch.empty() ? face_direction : unit_or(position(surface, trace.end) - x, face_direction);
        chord -= chord.dot(tangent) * tangent;
        frames.outward[i][side] = unit_or(chord, face_direction);
        frames.to_boundary[i][side] = trace.hit_boundary ? trace.length : -1;
        frames.radius_slope[i][side] =
            trace.length > 0 ? (radius_at(surface, vertex_radius, trace.end) - local_radius[i]) / trace.length : 0;
      }
    }
  });
}

}  // namespace meander
