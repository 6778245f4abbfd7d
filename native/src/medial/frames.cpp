// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/frames.h"

#include <array>
#include <cmath>

#include "base/eigen.h"
#include "geodesic/geodesic_trace.h"
#include "medial/constants.h"

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
    if (before != kNone) tangent += before == before_ ? ahead_ : direction(before, i);
    before_ = i;
    ahead_ = after != kNone ? direction(i, after) : Vec3::Zero();
    tangent += ahead_;
    return unit_or_else(tangent, [&] { return surface_.to_space(curve_.nodes[i].face, frames_.tangent[i]); });
  }

 private:
  Vec3 direction(uint32_t i, uint32_t j) const {
    return unit_or(frames_.position[j] - frames_.position[i], Vec3::Zero());
  }

  const Surface& surface_;
  const Curve& curve_;
  const Frames& frames_;
  uint32_t before_ = kNone;
  Vec3 ahead_ = Vec3::Zero();
};

/// Turns cached directions with the strand; false if the node has moved, or the strand has turned, too far.
bool reuse_directions(const CachedDirections& cached, uint32_t i, const Vec3& tangent, double r, Frames& frames) {
  if (!(std::abs(static_cast<double>(cached.radius) - r) <= kFrameRest * r)) return false;
  const double rest = kFrameRest * r;
  if (!((frames.position[i] - cached.from.cast<double>()).squaredNorm() <= rest * rest)) return false;
  for (uint32_t side = 0; side < 2; ++side) {
    const Vec3 outward = cached.outward[side].cast<double>();
    const double turned = outward.dot(tangent);
    if (!(std::abs(turned) <= kFrameTurn)) return false;
    frames.outward[i][side] = (outward - turned * tangent).normalized();
    frames.to_boundary[i][side] = -1;
    frames.radius_slope[i][side] = static_cast<double>(cached.radius_slope[side]);
  }
  return true;
}

/// Leads the geodesics to both sides of some nodes together, and finds the directions of their medial balls.
class DirectionWalks {
 public:
  DirectionWalks(const Surface& surface, const Curve& curve, const LocalMetric& metric, const RadiusField& radius,
                 Frames& frames)
      : surface_(surface), curve_(curve), metric_(metric), radius_(radius), frames_(frames) {
    walks_.reserve(2 * kTogether);
  }

  bool full() const { return count_ == kTogether; }
  void add(uint32_t node, const Vec3& tangent) {
    const double length = kChord * metric_.radius[node];
    walks_.emplace_back(surface_, curve_.nodes[node], length * frames_.bitangent2[node]);
    walks_.push_back(walks_.back().other_way());
    nodes_[count_] = node;
    tangents_[count_++] = tangent;
  }

  /// Fills the frames of the nodes that were added, and forgets them.
  void finish() {
    lead_together(walks_, [](size_t) {});
    // On a fine mesh these wait for memory; in loops of their own they do so together.
    for (size_t w = 0; w < walks_.size(); ++w) {
      ends_[w] = walks_[w].end();
      corners_[w] = surface_.face(ends_[w].face);
    }
    for (size_t w = 0; w < walks_.size(); ++w) {
      arrived_[w] = position(surface_, corners_[w], ends_[w]);
      arrived_radius_[w] = radius_.at(corners_[w], ends_[w]);
    }
    for (uint32_t k = 0; k < count_; ++k) {
      for (uint32_t side = 0; side < 2; ++side) find_direction(k, side);
    }
    walks_.clear();
    count_ = 0;
  }

 private:
  void find_direction(uint32_t k, uint32_t side) {
    const uint32_t node = nodes_[k], w = 2 * k + side;
    const GeodesicWalk& walk = walks_[w];
    const double length = walk.length();
    const auto face_direction = [&]() -> Vec3 {
      return surface_.to_space(curve_.nodes[node].face, (side == 0 ? 1.0 : -1.0) * frames_.bitangent2[node]);
    };
    Vec3 chord =
        walk.crossed() ? unit_or_else(arrived_[w] - frames_.position[node], face_direction) : face_direction();
    chord -= chord.dot(tangents_[k]) * tangents_[k];
    frames_.outward[node][side] = unit_or_else(chord, face_direction);
    frames_.to_boundary[node][side] = walk.hit_boundary() ? length : -1;
    frames_.radius_slope[node][side] = length > 0 ? (arrived_radius_[w] - metric_.radius[node]) / length : 0;
  }

  const Surface& surface_;
  const Curve& curve_;
  const LocalMetric& metric_;
  const RadiusField& radius_;
  Frames& frames_;
  uint32_t count_ = 0;
  std::vector<GeodesicWalk> walks_;  // two for every node
  std::array<uint32_t, kTogether> nodes_;
  std::array<Vec3, kTogether> tangents_;
  std::array<SurfacePoint, 2 * kTogether> ends_;
  std::array<Triangle, 2 * kTogether> corners_;
  std::array<Vec3, 2 * kTogether> arrived_;
  std::array<double, 2 * kTogether> arrived_radius_;
};

}  // namespace

void Frames::hand_on() noexcept {
  meander::hand_on(position, tangent, bitangent2, outward, to_boundary, radius_slope, walked);
}

void compute_frames(const Surface& surface, const Curve& curve, const LocalMetric& metric, const RadiusField& radius,
                    ThreadPool& pool, Frames& frames, const NodeData<CachedDirections>* cached) {
  const uint32_t n = curve.size();
  frames.position.resize(n);
  frames.tangent.resize(n);
  frames.bitangent2.resize(n);
  frames.outward.resize(n);
  frames.to_boundary.resize(n);
  frames.radius_slope.resize(n);
  frames.walked.assign(n, 1);
  constexpr size_t kBlock = 512;
  pool.for_each(n, kBlock, [&](uint32_t i) { frames.position[i] = position(surface, curve.nodes[i]); });
  pool.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
    Tangents tangent_in_space(surface, curve, frames);
    DirectionWalks walks(surface, curve, metric, radius, frames);
    for (auto i = static_cast<uint32_t>(begin); i < end; ++i) {
      if (i + kTogether < end) surface.fetch_face(curve.nodes[i + kTogether].face);
      const Vec2 t = flat_tangent(curve, i);
      frames.tangent[i] = t;
      frames.bitangent2[i] = Vec2{0, -1} * t;
      const Vec3 tangent = tangent_in_space(i);
      if (cached && reuse_directions((*cached)[i], i, tangent, metric.radius[i], frames)) {
        frames.walked[i] = 0;
      } else {
        walks.add(i, tangent);
        if (walks.full()) walks.finish();
      }
    }
    walks.finish();
  });
}

void remember_directions(const Frames& frames, const LocalMetric& metric, ThreadPool& pool,
                         NodeData<CachedDirections>& cached) {
  cached.resize(frames.position.size());
  pool.for_each(cached.size(), 2048, [&](uint32_t i) {
    if (!frames.walked[i]) return;
    CachedDirections& known = cached[i];
    known.from = frames.position[i].cast<float>();
    known.radius = static_cast<float>(metric.radius[i]);
    for (size_t side = 0; side < 2; ++side) {
      known.outward[side] = frames.outward[i][side].cast<float>();
      known.radius_slope[side] = static_cast<float>(frames.radius_slope[i][side]);
      if (frames.to_boundary[i][side] >= 0) known.radius = 0;
    }
  });
}

}  // namespace meander
