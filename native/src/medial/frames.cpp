// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/frames.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "base/tuning.h"
#include "geodesic/geodesic_trace.h"

namespace meander {
namespace {

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const double n = v.norm();
  return n > 0 ? Vec3(v / n) : otherwise;
}

/// What otherwise() would have to fetch is left alone where it is not wanted, which is nearly always.
template <class Otherwise>
Vec3 unit_or_else(const Vec3& v, const Otherwise& otherwise) {
  const double n = v.norm();
  return n > 0 ? Vec3(v / n) : otherwise();
}

/// The bisector of a node's two segments.
Vec2 flat_tangent(const Curve& curve, uint32_t i) {
  const uint32_t before = curve.previous(i), after = curve.next(i);
  const Vec2 in = before != kNone ? curve.shapes[before].arriving : curve.shapes[i].leaving;
  const Vec2 out = after != kNone ? curve.shapes[i].leaving : curve.shapes[before].arriving;
  const Vec2 t = unit(in + out);
  return dot(t, t) > 0 ? t : Vec2{0, 1} * in;  // a full turn back has no bisector
}

/// Tangents in space of nodes one after another: they span both segments, so that one small face does not
/// decide them.
class Tangents {
 public:
  Tangents(const Surface& surface, const Curve& curve, const Frames& frames)
      : surface_(surface), curve_(curve), frames_(frames) {}

  Vec3 operator()(uint32_t i) {
    const uint32_t before = curve_.previous(i), after = curve_.next(i);
    Vec3 tangent = Vec3::Zero();
    if (before != kNone) tangent += before == before_ ? ahead_ : way(before, i);
    before_ = i;
    ahead_ = after != kNone ? way(i, after) : Vec3::Zero();
    tangent += ahead_;
    return unit_or_else(tangent, [&] { return surface_.to_space(curve_.nodes[i].face, frames_.tangent[i]); });
  }

 private:
  Vec3 way(uint32_t i, uint32_t j) const { return unit_or(frames_.position[j] - frames_.position[i], Vec3::Zero()); }

  const Surface& surface_;
  const Curve& curve_;
  const Frames& frames_;
  uint32_t before_ = kNone;
  Vec3 ahead_ = Vec3::Zero();
};

/// Looks where `look` did, turned with the strand; false if it has moved too far.
bool reuse_directions(const CachedDirections& look, uint32_t i, const Vec3& tangent, double r, Frames& frames) {
  if (!(std::abs(static_cast<double>(look.radius) - r) <= tuning::kRest * r)) return false;
  if (!((frames.position[i] - look.from).squaredNorm() <= tuning::kRest * r * tuning::kRest * r)) return false;
  for (uint32_t side = 0; side < 2; ++side) {
    const Vec3 outward = look.outward[side].cast<double>();
    const double turned = outward.dot(tangent);
    if (!(std::abs(turned) <= tuning::kTurn)) return false;
    frames.outward[i][side] = (outward - turned * tangent).normalized();
    frames.to_boundary[i][side] = -1;
    frames.radius_slope[i][side] = static_cast<double>(look.radius_slope[side]);
  }
  return true;
}

}  // namespace

void compute_frames(const Surface& surface, const Curve& curve, const LocalMetric& metric, const RadiusField& radius,
                    ThreadPool& pool, Frames& frames,
                    const NodeData<CachedDirections>* looks) {
  const uint32_t n = curve.size();
  frames.position.resize(n);
  frames.tangent.resize(n);
  frames.bitangent2.resize(n);
  frames.outward.resize(n);
  frames.to_boundary.resize(n);
  frames.radius_slope.resize(n);
  frames.walked.assign(n, 1);
  constexpr size_t kBlock = 512;
  pool.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) frames.position[i] = position(surface, curve.nodes[i]);
  });
  pool.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
    Tangents tangent_in_space(surface, curve, frames);
    std::vector<GeodesicWalk> walks;
    walks.reserve(2 * kTogether);
    std::array<uint32_t, kTogether> walking;
    std::array<Vec3, kTogether> tangents;
    std::array<SurfacePoint, 2 * kTogether> ends;
    std::array<Triangle, 2 * kTogether> corners;
    std::array<Vec3, 2 * kTogether> arrived;
    std::array<double, 2 * kTogether> arrived_radius;
    for (uint32_t i = static_cast<uint32_t>(begin); i < end;) {
      walks.clear();
      uint32_t count = 0;
      for (; i < end && count < kTogether; ++i) {
        if (i + kTogether < end) surface.fetch_face(curve.nodes[i + kTogether].face);
        const Vec2 t = flat_tangent(curve, i);
        frames.tangent[i] = t;
        frames.bitangent2[i] = Vec2{0, -1} * t;
        const Vec3 tangent = tangent_in_space(i);
        if (looks && reuse_directions((*looks)[i], i, tangent, metric.radius[i], frames)) {
          frames.walked[i] = 0;
          continue;
        }
        const double look = tuning::kChord * metric.radius[i];
        walks.emplace_back(surface, curve.nodes[i], look * frames.bitangent2[i]);
        walks.emplace_back(surface, curve.nodes[i], -look * frames.bitangent2[i]);
        walking[count] = i;
        tangents[count++] = tangent;
      }
      lead_together(walks, [](size_t) {});
      // On a fine mesh these wait for memory; in loops of their own they do so together.
      for (size_t w = 0; w < walks.size(); ++w) {
        ends[w] = walks[w].end();
        corners[w] = surface.face(ends[w].face);
      }
      for (size_t w = 0; w < walks.size(); ++w) {
        arrived[w] = position(surface, corners[w], ends[w]);
        arrived_radius[w] = radius.at(corners[w], ends[w]);
      }
      for (uint32_t k = 0; k < count; ++k) {
        const uint32_t at = walking[k], face = curve.nodes[at].face;
        const Vec3 &x = frames.position[at], &tangent = tangents[k];
        for (uint32_t side = 0; side < 2; ++side) {
          const GeodesicWalk& walk = walks[2 * k + side];
          const double length = walk.length();
          const auto face_direction = [&]() -> Vec3 {
            return surface.to_space(face, (side == 0 ? 1.0 : -1.0) * frames.bitangent2[at]);
          };
          Vec3 chord =
              walk.crossed() ? unit_or_else(arrived[2 * k + side] - x, face_direction) : face_direction();
          chord -= chord.dot(tangent) * tangent;
          frames.outward[at][side] = unit_or_else(chord, face_direction);
          frames.to_boundary[at][side] = walk.hit_boundary() ? length : -1;
          frames.radius_slope[at][side] = length > 0 ? (arrived_radius[2 * k + side] - metric.radius[at]) / length : 0;
        }
      }
    }
  });
}

void remember_directions(const Frames& frames, const LocalMetric& metric, ThreadPool& pool,
                         NodeData<CachedDirections>& looks) {
  looks.resize(frames.position.size());
  pool.for_blocks(looks.size(), 2048, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      if (!frames.walked[i]) continue;
      CachedDirections& look = looks[i];
      look.from = frames.position[i];
      look.radius = static_cast<float>(metric.radius[i]);
      for (size_t side = 0; side < 2; ++side) {
        look.outward[side] = frames.outward[i][side].cast<float>();
        look.radius_slope[side] = static_cast<float>(frames.radius_slope[i][side]);
        if (frames.to_boundary[i][side] >= 0) look.radius = 0;
      }
    }
  });
}

}  // namespace meander
