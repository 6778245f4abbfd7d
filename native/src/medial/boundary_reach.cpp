// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/boundary_reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/eigen.h"
#include "geodesic/geodesic_trace.h"
#include "medial/constants.h"
#include "medial/empty_balls.h"
#include "medial/near_points.h"

namespace meander {
namespace {

/// The boundary edges, those of a loop one after the other.
std::vector<HalfEdge> along_loops(const Surface& surface) {
  const std::vector<HalfEdge>& boundary = surface.boundary();
  if (boundary.empty()) return {};
  std::vector<HalfEdge> leaving(surface.vertex_count(), kNone), ordered;  // one at most leaves a vertex
  const auto start = [&](HalfEdge e) { return surface.face(face_of(e))[corner_of(e)]; };
  const auto end = [&](HalfEdge e) { return surface.face(face_of(e))[next_corner(corner_of(e))]; };
  for (const HalfEdge e : boundary) leaving[start(e)] = e;
  ordered.reserve(boundary.size());
  for (const HalfEdge first : boundary) {
    uint32_t v = start(first);
    for (HalfEdge e; (e = std::exchange(leaving[v], kNone)) != kNone; v = end(e)) ordered.push_back(e);
  }
  return ordered;
}

std::vector<Vec3> sample_boundary(const Surface& surface, double step, std::vector<HalfEdge>& edges,
                                  std::vector<Vec3>& inward) {
  struct BoundaryEdge {
    uint32_t from, to;
    Vec3 inward;
  };
  const auto side_of = [&](HalfEdge e) {
    const uint32_t f = face_of(e), k = corner_of(e);
    const Triangle& t = surface.face(f);
    const Vec3 along = surface.position(t[next_corner(k)]) - surface.position(t[k]);
    return BoundaryEdge{t[k], t[next_corner(k)], surface.face_normal(f).cross(along).normalized()};
  };
  std::vector<Vec3> at_vertex(surface.boundary().empty() ? 0 : surface.vertex_count(), Vec3::Zero());
  for (const HalfEdge e : surface.boundary()) {
    const BoundaryEdge side = side_of(e);
    at_vertex[side.from] += side.inward;
    at_vertex[side.to] += side.inward;
  }
  std::vector<Vec3> samples;
  for (const HalfEdge e : along_loops(surface)) {
    const BoundaryEdge side = side_of(e);
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
  explicit Clearance(const CurveBvh& boundary) : boundary_(boundary) {}

  /// No point of the boundary is nearer than this.
  double at(const Vec3& x) const { return nearest_ - (x - asked_at_).norm(); }

  /// Whether one of a part of it may be nearer than `far`; false only where none is.
  bool may_be_within(const Vec3& x, uint32_t part, double far) {
    if (part != part_) nearest_ = 0;
    if (at(x) >= far) return false;
    if (part == part_ && (x - asked_at_).norm() < kBelievedNear * far) return true;
    asked_at_ = x;
    part_ = part;
    nearest_ = nearest_distance(boundary_, x, std::min(kLookedFarther * far, kMostRadius), part);
    return nearest_ < far;
  }

 private:
  const CurveBvh& boundary_;
  Vec3 asked_at_ = Vec3::Constant(std::numeric_limits<double>::infinity());
  uint32_t part_ = kNone;
  double nearest_ = 0;  // to there, at least
};

/// Nodes whose reach is found together. Only some lie beside the boundary: larger blocks leave a thread without work.
constexpr size_t kNodesPerBlock = 128;

/// The reach of some nodes after another, with the scratch memory of one thread.
class ReachFinder {
 public:
  explicit ReachFinder(const ReachScene& scene) : scene_(scene), clearance_(scene.boundary.bvh()) {}

  /// See compute_reach.
  void find(uint32_t begin, uint32_t end, const NodeData<Radii>& likely, NodeData<Reach>& reach) {
    sides_.clear();
    for (uint32_t i = begin; i < end; ++i) add(i, wanted(i, likely), reach[i]);
    walk_to_boundary();
    for (const SideOfNode& side : sides_) reach[side.node][side.side] = reach_of(side);
  }

  /// See complete_reach. Corners need no second look: they count where the boundary was sought in any case.
  void complete(uint32_t begin, uint32_t end, NodeData<Reach>& reach, NodeData<Radii>& radii) {
    sides_.clear();
    for (uint32_t i = begin; i < end; ++i) {
      for (uint32_t side = 0; side < 2; ++side) {
        if (!(radii[i][side] > reach[i][side].sought)) continue;
        const double most = reach[i][side].sought = scene_.metric.max_radius[i];
        if (may_be_within(i, most)) sides_.push_back({i, side, false, most, kUnknown});
      }
    }
    walk_to_boundary();
    for (const SideOfNode& side : sides_) {
      ReachOfSide& known = reach[side.node][side.side];
      double& radius = radii[side.node][side.side];
      known.radius = std::min(known.radius, reach_of(side).radius);
      known.driving = std::min(known.driving, known.radius);
      radius = std::min(radius, known.radius);
    }
  }

 private:
  struct SideOfNode {
    uint32_t node, side;
    bool corners;     // some sample of the boundary may be nearer than the rest of the node
    double sought;    // radii for which the boundary matters
    double distance;  // to the boundary; infinite where it is too far to matter, negative until it is known
  };
  static constexpr double kUnknown = -1;

  double beyond(uint32_t i) const { return scene_.rule == BoundaryRule::kCentre ? scene_.metric.overhang[i] : 0; }
  double rest(uint32_t i) const { return scene_.rule == BoundaryRule::kCentre ? scene_.metric.least_rest[i] : 0; }
  /// The boundary matters to a ball of this radius up to this distance.
  double farthest(uint32_t i, double radius) const { return radius + std::max(0.0, -beyond(i)); }
  /// Whether the boundary may limit balls of a node that are no larger than this; false only if it does not. A geodesic
  /// that ends at the boundary is no shorter than the straight line to there, and leaves a sample beside it.
  bool may_be_within(uint32_t i, double radius) {
    return clearance_.may_be_within(scene_.frames.position[i], part(i), farthest(i, radius) + scene_.boundary.step());
  }
  uint32_t part(uint32_t i) const { return scene_.surface.component(scene_.curve.nodes[i].face); }

  /// For what radii the boundary is looked for.
  Radii wanted(uint32_t i, const NodeData<Radii>& likely) const {
    const double most = scene_.metric.max_radius[i];
    Radii radii{most, most};
    if (likely.empty() || scene_.boundary.empty() || is_measured(i)) return radii;
    for (size_t side = 0; side < 2; ++side) {
      const double last = likely[i][side];
      if (last > 0) {
        radii[side] = std::max({kWarmth * last, scene_.plan.boundary_within * scene_.metric.radius[i], rest(i)});
      }
      radii[side] = std::min(most, radii[side]);
    }
    return radii;
  }
  /// Whether balls of a node are measured along the surface: what limits them is looked for in all that the boundary
  /// leaves of them.
  bool is_measured(uint32_t i) const {
    const SurfacePatches* const patches = scene_.plan.measure ? scene_.patches : nullptr;
    return patches && patches->creased(patches->patch_of(scene_.surface, scene_.curve.nodes[i]));
  }

  /// Takes note of the sides of a node that the boundary may be near to, and says of others that it is not.
  void add(uint32_t i, const Radii& sought, Reach& reach) {
    const double most = scene_.metric.max_radius[i];
    reach.fill({most, most, most});
    if (scene_.boundary.empty()) return;
    const bool near = may_be_within(i, std::max(sought[0], sought[1]));
    const double clear = clearance_.at(scene_.frames.position[i]);
    for (uint32_t side = 0; side < 2; ++side) {
      if (near) {
        sides_.push_back({i, side, clear < rest(i), sought[side], scene_.frames.to_boundary[i][side]});
      } else {
        reach[side].sought = std::min(most, clear - farthest(i, 0) - scene_.boundary.step());
      }
    }
  }

  /// Leads the geodesics whose distances are not known yet, in turns.
  void walk_to_boundary() {
    std::vector<GeodesicWalk> walks;
    std::array<SideOfNode*, kTogether> walking;
    walks.reserve(kTogether);
    for (auto side = sides_.begin(); side != sides_.end();) {
      walks.clear();
      for (; side != sides_.end() && walks.size() < kTogether; ++side) {
        if (side->distance >= 0) continue;
        const uint32_t i = side->node;
        const Vec2 direction = (side->side == 0 ? 1.0 : -1.0) * scene_.frames.bitangent2[i];
        walking[walks.size()] = &*side;
        // What is found must not depend on how far it was sought, not even in its rounding.
        walks.emplace_back(scene_.surface, scene_.curve.nodes[i], farthest(i, scene_.metric.max_radius[i]) * direction);
        walks.back().shorten(farthest(i, side->sought));
      }
      lead_together(walks, [](size_t) {});
      for (size_t k = 0; k < walks.size(); ++k) {
        walking[k]->distance = walks[k].hit_boundary() ? walks[k].length() : std::numeric_limits<double>::infinity();
      }
    }
  }

  ReachOfSide reach_of(const SideOfNode& side) {
    const uint32_t i = side.node;
    const double most = scene_.metric.max_radius[i], least = rest(i);
    double distance = side.distance;
    if (side.corners) {
      // Only those matter that are nearer than what is straight ahead.
      const double corner = distance_to_corner(i, side.side, std::min(least, distance));
      if (corner < least) distance = std::min(distance, corner);
    }
    ReachOfSide r;
    r.radius = std::clamp(distance + beyond(i), 0.0, most);
    r.sought = std::isfinite(side.distance) ? most : side.sought;
    r.driving = r.radius;
    // Nearer than is wanted the boundary pushes harder than strands do: two strands that are squeezed between
    // boundaries would else settle at half of their distance from each other. And harder yet where
    // they are very near, as at a corner, which pushes a few nodes only.
    const double lacking = least - (distance + beyond(i));
    if (least > 0 && lacking > 0) {
      const double far_short = std::max(0.0, lacking - (1 - scene_.plan.very_near) * least);
      r.driving = least - std::lerp(kPush, kEasedPush, scene_.plan.boundary_ease) * lacking - kVeryNearPush * far_short;
    }
    return r;
  }

  /// Twice the radius of the largest ball on this side that holds no point of a boundary which faces it,
  /// where that is less than `most`. Straight ahead it is the distance; a corner that juts out beside the
  /// path to the boundary is nearer than its end.
  double distance_to_corner(uint32_t i, uint32_t side, double most) {
    const Vec3& outward = scene_.frames.outward[i][side];
    const auto counts = [&](uint32_t k) {
      return -scene_.boundary.inward()[k].dot(outward) >= kFacing && !hidden(i, k);
    };
    const BallStart start{scene_.frames.position[i], outward};
    return 2 * largest_ball(scene_.boundary.bvh(), start, most / 2, count_where(counts), part(i)).radius;
  }

  bool hidden(uint32_t i, uint32_t sample) const {
    if (!scene_.patches) return false;
    const Surface& surface = scene_.surface;
    const uint32_t f = face_of(scene_.boundary.edges()[sample]);
    const Vec3 from_corner = scene_.boundary.samples()[sample] - surface.position(surface.face(f)[0]);
    const SurfacePoint there = point_at(surface, f, surface.to_plane(f, from_corner));
    return scene_.patches->hidden(scene_.patches->patch_of(surface, scene_.curve.nodes[i]),
                                  scene_.patches->patch_of(surface, there));
  }

  const ReachScene& scene_;
  Clearance clearance_;
  std::vector<SideOfNode> sides_;  // that the boundary may be near to
};

}  // namespace

BoundaryObstacle::BoundaryObstacle(const Surface& surface, double step, bool apart)
    : step_(step), tree_(sample_boundary(surface, step, edges_, inward_)) {
  if (apart && surface.component_count() > 1) {
    for (const HalfEdge e : edges_) parts_.push_back(surface.component(face_of(e)));
  }
  ThreadPool alone(1);
  bvh_.build(tree_.points(), alone, parts_);
}

void compute_reach(const ReachScene& scene, const NodeData<Radii>& likely, ThreadPool& pool, NodeData<Reach>& reach) {
  reach.resize(scene.curve.size());
  pool.for_blocks(scene.curve.size(), kNodesPerBlock, [&](size_t, size_t begin, size_t end) {
    ReachFinder(scene).find(static_cast<uint32_t>(begin), static_cast<uint32_t>(end), likely, reach);
  });
}

void complete_reach(const ReachScene& scene, ThreadPool& pool, NodeData<Reach>& reach, NodeData<Radii>& radii) {
  if (scene.boundary.empty()) return;
  pool.for_blocks(radii.size(), kNodesPerBlock, [&](size_t, size_t begin, size_t end) {
    ReachFinder(scene).complete(static_cast<uint32_t>(begin), static_cast<uint32_t>(end), reach, radii);
  });
}

}  // namespace meander
