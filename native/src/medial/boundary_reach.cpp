// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/boundary_reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "base/tuning.h"
#include "geodesic/geodesic_trace.h"

namespace meander {
namespace {

std::vector<Vec3> sample_boundary(const Surface& surface, double step, std::vector<HalfEdge>& edges,
                                  std::vector<Vec3>& inward) {
  struct Side {
    uint32_t from, to;
    Vec3 inward;
  };
  const auto side_of = [&](HalfEdge e) {
    const uint32_t f = face_of(e), k = corner_of(e);
    const Triangle& t = surface.face(f);
    const Vec3 along = surface.position(t[next_corner(k)]) - surface.position(t[k]);
    return Side{t[k], t[next_corner(k)], surface.face_normal(f).cross(along).normalized()};
  };
  std::vector<Vec3> at_vertex(surface.boundary().empty() ? 0 : surface.vertex_count(), Vec3::Zero());
  for (const HalfEdge e : surface.boundary()) {
    const Side side = side_of(e);
    at_vertex[side.from] += side.inward;
    at_vertex[side.to] += side.inward;
  }
  std::vector<Vec3> samples;
  for (const HalfEdge e : surface.boundary()) {
    const Side side = side_of(e);
    const Vec3 &a = surface.position(side.from), &b = surface.position(side.to);
    const int pieces = std::max(1, static_cast<int>(std::min(1e6, std::ceil((b - a).norm() / step))));
    for (int k = 0; k < pieces; ++k) {
      samples.push_back(a + (b - a) * (double(k) / pieces));
      edges.push_back(e);
      inward.push_back(k == 0 ? at_vertex[side.from].normalized() : side.inward);
    }
  }
  return samples;
}

/// How far the boundary is at least from one place after another: what is known of a place answers for others near it,
/// as those of neighbours on the curve.
class Clearance {
 public:
  explicit Clearance(const PointTree& boundary) : boundary_(boundary) {}

  /// No point of the boundary is nearer than this.
  double at(const Vec3& x) const { return nearest_ - (x - asked_at_).norm(); }

  /// Whether one may be nearer than `far`; false only where none is.
  bool may_be_within(const Vec3& x, double far) {
    if (at(x) >= far) return false;
    if ((x - asked_at_).norm() < kBelieved * far) return true;
    const double bound = kFarther * far;
    const auto hit = boundary_.nearest(x, bound * bound);
    asked_at_ = x;
    nearest_ = hit ? std::sqrt(hit->squared_distance) : bound;
    return nearest_ < far;
  }

 private:
  /// It is looked for so many times as far as asked: farther costs more, but answers for more places. Where it may be
  /// near, places this near to where it was asked for, in `far`, are not asked for again.
  static constexpr double kFarther = 2, kBelieved = 0.5;

  const PointTree& boundary_;
  Vec3 asked_at_ = Vec3::Constant(std::numeric_limits<double>::infinity());
  double nearest_ = 0;  // to there, at least
};

/// The reach of some nodes after another, with the scratch memory of one thread.
class ReachFinder {
 public:
  ReachFinder(const Surface& surface, const Curve& curve, const Frames& frames, const BoundaryObstacle& boundary,
              BoundaryRule rule, const SurfacePatches* patches, const LocalMetric& metric)
      : surface_(surface), curve_(curve), frames_(frames), boundary_(boundary), rule_(rule), patches_(patches),
        metric_(metric), clearance_(boundary.tree()) {}

  void find(uint32_t begin, uint32_t end, NodeData<Reach>& reach) {
    sides_.clear();
    for (uint32_t i = begin; i < end; ++i) {
      const double most = metric_.max_radius[i];
      reach[i].fill({most, most, most});
      // A geodesic that ends at the boundary is no shorter than the straight line to there, and leaves a sample
      // beside it.
      const double far = std::max(farthest(i), rest(i)) + boundary_.step();
      if (boundary_.empty() || !clearance_.may_be_within(frames_.position[i], far)) continue;
      const bool corners = rest(i) > 0 && clearance_.at(frames_.position[i]) < rest(i);
      for (uint32_t side = 0; side < 2; ++side) sides_.push_back({i, side, corners, frames_.to_boundary[i][side]});
    }
    walk_to_boundary();
    for (const Side& side : sides_) reach[side.node][side.side] = reach_of(side);
  }

 private:
  struct Side {
    uint32_t node, side;
    bool corners;     // some sample of the boundary may be nearer than the rest of the node
    double distance;  // to the boundary; infinite where it is too far to matter, negative until it is known
  };

  double beyond(uint32_t i) const { return rule_ == BoundaryRule::kCentre ? metric_.overhang[i] : 0; }
  double rest(uint32_t i) const { return rule_ == BoundaryRule::kCentre ? metric_.least_rest[i] : 0; }
  /// The boundary matters up to this distance.
  double farthest(uint32_t i) const { return metric_.max_radius[i] + std::max(0.0, -beyond(i)); }

  /// Leads the geodesics whose distances are not known yet, in turns.
  void walk_to_boundary() {
    std::vector<GeodesicWalk> walks;
    std::array<Side*, kTogether> walking;
    walks.reserve(kTogether);
    for (auto side = sides_.begin(); side != sides_.end();) {
      walks.clear();
      for (; side != sides_.end() && walks.size() < kTogether; ++side) {
        if (side->distance >= 0) continue;
        const Vec2 direction = (side->side == 0 ? 1.0 : -1.0) * frames_.bitangent2[side->node];
        walking[walks.size()] = &*side;
        walks.emplace_back(surface_, curve_.nodes[side->node], farthest(side->node) * direction);
      }
      lead_together(walks, [](size_t) {});
      for (size_t k = 0; k < walks.size(); ++k) {
        walking[k]->distance = walks[k].hit_boundary() ? walks[k].length() : std::numeric_limits<double>::infinity();
      }
    }
  }

  ReachOfSide reach_of(const Side& side) {
    const uint32_t i = side.node;
    const double most = metric_.max_radius[i], least = rest(i);
    double distance = side.distance;
    if (side.corners) {
      const double corner = distance_to_corner(i, side.side, least);
      if (corner < least) distance = std::min(distance, corner);
    }
    ReachOfSide r;
    r.radius = std::clamp(distance + beyond(i), 0.0, most);
    r.centre = std::min(most, distance);
    r.driving = r.radius;
    // Nearer than is wanted the boundary pushes twice as hard: two strands that are squeezed between
    // boundaries would else settle at half of their distance from each other. And harder yet where
    // they are very near, as at a corner, which pushes a few nodes only.
    const double lacking = least - (distance + beyond(i));
    if (least > 0 && lacking > 0) {
      const double far_short = std::max(0.0, lacking - (1 - tuning::kVeryNear) * least);
      r.driving = least - 2 * lacking - tuning::kVeryNearPush * far_short;
    }
    return r;
  }

  /// Twice the radius of the largest ball on this side that holds no point of a boundary which faces it,
  /// where that is less than `most`. Straight ahead it is the distance; a corner that juts out beside the
  /// path to the boundary is nearer than its end.
  double distance_to_corner(uint32_t i, uint32_t side, double most) {
    const Vec3 &x = frames_.position[i], &outward = frames_.outward[i][side];
    double distance = most;
    if (near_of_ != i) {  // the same for both sides
      boundary_.tree().within(x, most * most, near_);
      near_of_ = i;
    }
    for (const uint32_t k : near_) {
      const Vec3 d = boundary_.samples()[k] - x;
      const double ahead = d.dot(outward);
      const bool faces = -boundary_.inward()[k].dot(outward) >= tuning::kFacing;
      if (!(ahead > 0 && faces && d.squaredNorm() < distance * ahead) || hidden(i, k)) continue;
      distance = d.squaredNorm() / ahead;
    }
    return distance;
  }

  bool hidden(uint32_t i, uint32_t sample) const {
    if (!patches_) return false;
    const uint32_t f = face_of(boundary_.edges()[sample]);
    const Vec3 from_corner = boundary_.samples()[sample] - surface_.position(surface_.face(f)[0]);
    return patches_->hidden(patches_->patch_of(surface_, curve_.nodes[i]),
                            patches_->patch_of(surface_, point_at(surface_, f, surface_.to_plane(f, from_corner))));
  }

  const Surface& surface_;
  const Curve& curve_;
  const Frames& frames_;
  const BoundaryObstacle& boundary_;
  BoundaryRule rule_;
  const SurfacePatches* patches_;
  const LocalMetric& metric_;
  Clearance clearance_;
  std::vector<Side> sides_;  // that the boundary may be near to
  uint32_t near_of_ = kNone;
  std::vector<uint32_t> near_;  // samples near the node near_of_
};

}  // namespace

BoundaryObstacle::BoundaryObstacle(const Surface& surface, double step)
    : step_(step), tree_(sample_boundary(surface, step, edges_, inward_)) {}

void compute_reach(const Surface& surface, const Curve& curve, const Frames& frames,
                   const BoundaryObstacle& boundary, BoundaryRule rule, const SurfacePatches* patches,
                   const LocalMetric& metric, ThreadPool& pool, NodeData<Reach>& reach) {
  reach.resize(curve.size());
  constexpr size_t kBlock = 512;
  pool.for_blocks(curve.size(), kBlock, [&](size_t, size_t begin, size_t end) {
    ReachFinder(surface, curve, frames, boundary, rule, patches, metric)
        .find(static_cast<uint32_t>(begin), static_cast<uint32_t>(end), reach);
  });
}

}  // namespace meander
