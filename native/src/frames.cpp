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

/// The medial balls look to where a geodesic arrives after this much of the local r: the middle of the
/// way to a ball's centre and a little beyond. Farther, and strands on thin limbs come to lie too far
/// apart; nearer, and those at creases come too close.
constexpr double kLook = 0.75;

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const double n = v.norm();
  return n > 0 ? Vec3(v / n) : otherwise;
}

/// Walks that are led in turns, so that they wait for memory together.
constexpr uint32_t kTogether = 8;

/// The bisector of a node's two segments.
Vec2 flat_tangent(const Curve& curve, uint32_t i) {
  const uint32_t before = curve.previous(i), after = curve.next(i);
  const Vec2 in = before != kNone ? curve.shapes[before].arriving : curve.shapes[i].leaving;
  const Vec2 out = after != kNone ? curve.shapes[i].leaving : curve.shapes[before].arriving;
  const Vec2 t = unit(in + out);
  return dot(t, t) > 0 ? t : Vec2{0, 1} * in;  // a full turn back has no bisector
}

}  // namespace

void NormalField::find() const {
  const Surface& surface = surface_;
  normals_.assign(surface.vertex_count(), Vec3::Zero());
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    for (uint32_t k = 0; k < 3; ++k) {
      normals_[surface.face(f)[k]] += surface.corner_angle(f, k) * surface.face_normal(f);
    }
  }
  for (Vec3& n : normals_) n = unit_or(n, Vec3::Zero());

  const double edges = 0.5 * radius_ / surface.mean_edge_length();
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
  std::call_once(found_, [this] { find(); });
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
    std::vector<GeodesicWalk> walks;
    walks.reserve(2 * kTogether);
    for (uint32_t first = static_cast<uint32_t>(begin); first < end; first += kTogether) {
      const uint32_t last = std::min(first + kTogether, static_cast<uint32_t>(end));
      walks.clear();
      for (uint32_t i = first; i < last; ++i) {
        const Vec2 t = flat_tangent(curve, i);
        frames.tangent[i] = t;
        frames.bitangent2[i] = Vec2{0, -1} * t;
        const double look = kLook * local_radius[i];
        walks.emplace_back(surface, curve.nodes[i], look * frames.bitangent2[i]);
        walks.emplace_back(surface, curve.nodes[i], -look * frames.bitangent2[i]);
      }
      lead_together(walks, [](size_t) {});
      for (uint32_t i = first; i < last; ++i) {
        // In space the tangent spans both segments, so that one small face does not decide it.
        const uint32_t before = curve.previous(i), after = curve.next(i), face = curve.nodes[i].face;
        const Vec3& x = frames.position[i];
        Vec3 tangent = Vec3::Zero();
        if (before != kNone) tangent += unit_or(x - frames.position[before], Vec3::Zero());
        if (after != kNone) tangent += unit_or(frames.position[after] - x, Vec3::Zero());
        tangent = unit_or(tangent, surface.to_space(face, frames.tangent[i]));
        for (uint32_t side = 0; side < 2; ++side) {
          const GeodesicWalk& walk = walks[2 * (i - first) + side];
          const SurfacePoint arrived = walk.end();
          const double length = walk.length();
          const Vec3 face_direction = surface.to_space(face, (side == 0 ? 1.0 : -1.0) * frames.bitangent2[i]);
          Vec3 chord = walk.crossed() ? unit_or(position(surface, arrived) - x, face_direction) : face_direction;
          chord -= chord.dot(tangent) * tangent;
          frames.outward[i][side] = unit_or(chord, face_direction);
          frames.to_boundary[i][side] = walk.hit_boundary() ? length : -1;
          frames.radius_slope[i][side] =
              length > 0 ? (radius_at(surface, vertex_radius, arrived) - local_radius[i]) / length : 0;
        }
      }
    }
  });
}

}  // namespace meander
