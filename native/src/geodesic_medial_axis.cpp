// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic_medial_axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "geodesic_distance.h"
#include "run_tree.h"

namespace meander {
namespace {

/// A node this much (relative) inside of a ball is not told from one on it.
constexpr double kEmpty = 1e-9;

/// What the plane's formulas say is taken as it is for changes up to this share: the curvature of the
/// surface makes a small part of the change wrong.
constexpr double kClose = 0.03;

/// Paths up to this many radii long are looked for where a ball is expected to touch.
constexpr double kNearlyTouching = 1.2;

/// Shots at a point are given up after this many, or when one misses it by this share of its length.
constexpr int kMostShots = 6;
constexpr double kLost = 0.7;

/// Balls larger than this many r are seen only while a curve grows, and fine faces make the search in them
/// dear: there straight paths that a shot finds are all that counts.
constexpr double kLarge = 3;

/// A ball in space that holds this many nodes is hardly ever empty on the surface.
constexpr size_t kCrowd = 4;

constexpr int kMostRounds = 30;

/// Everything that balls may touch.
struct Obstacles {
  std::vector<FlatPoint> points;  // nodes first
  std::vector<Vec3> positions;
};

/// The balls of one node after the other, and the scratch memory of one thread.
class Balls {
 public:
  Balls(const Surface& surface, const Obstacles& obstacles, const RunTree& tree)
      : surface_(surface), obstacles_(obstacles), tree_(tree), distance_(surface) {}

  /// The radius of the largest empty ball that starts at a node towards `way` (unit, in the plane of its
  /// face). `outward` is about the direction of its centre in space, `usual` about the radius to be
  /// expected where that misleads.
  double largest(uint32_t node, Vec2 way, const Vec3& outward, const Reach& reach, double usual) {
    node_ = node;
    way_ = way;
    large_ = kLarge * usual * (1 + kEmpty);
    const double most = std::min(reach.radius, reach.centre);
    const double radius = largest_on_surface(outward, most, usual);
    return radius < most || reach.radius <= most ? radius : largest_beyond(most, reach.radius);
  }

 private:
  /// Where the centre of a ball is, and in which direction (unit, in the plane of its face) the way from
  /// the node arrives there.
  struct Centre {
    FlatPoint point;
    Vec2 arriving;
  };
  /// A path from a centre to a point: its length and the direction in which it leaves.
  struct Sight {
    double distance;
    Vec2 direction;
  };

  Centre centre(double radius) const {
    const Landing landing = walk_straight(surface_, obstacles_.points[node_], radius * way_);
    return {landing.end, conj(landing.turn) * way_};
  }

  double largest_on_surface(const Vec3& outward, double most, double usual) {
    uint32_t touched = kNone;
    const double guess = tree_.largest_ball(obstacles_.positions[node_], outward, most, &touched);
    if (touched == kNone) return shrink(most);
    const double radius = through(touched, guess, most);
    if (radius < most) return shrink(radius);
    // Another sheet, most likely. The right ball is larger, but hardly as large as it may be.
    return grow(std::min(most, std::max(2 * guess, 1.25 * usual)), most);
  }

  /// The largest empty ball whose centre may pass the boundary, which it reaches after `edge`.
  double largest_beyond(double edge, double most) {
    const Centre c = centre(edge);
    // Around the centre of such a ball lie all its points within this distance of where it left.
    find_inside(c, 2 * most - edge);
    measure_inside(c, 2 * most - edge, false);
    double radius = most;
    for (const GeodesicDistance::Target& t : targets_) {
      if (t.reached) radius = std::min(radius, in_plane(edge, {t.distance, t.direction}, c.arriving));
    }
    return radius;
  }

  /// Finds the nodes within `reach` of a centre, straight through space.
  void find_inside(const Centre& c, double reach) {
    tree_.inside(position(surface_, c.point), reach, inside_);
    std::erase(inside_, node_);
  }

  /// Measures what was found along the surface.
  void measure_inside(const Centre& c, double reach, bool nearest_only) {
    targets_.clear();
    for (const uint32_t p : inside_) {
      targets_.push_back({obstacles_.points[p], obstacles_.positions[p], reach, {}, false});
    }
    if (reach <= large_) return distance_.measure(c.point, targets_, nearest_only);
    for (size_t k = 0; k < inside_.size(); ++k) {
      const std::optional<Sight> sight = shoot(c.point, inside_[k]);
      if (!sight || !(sight->distance < reach)) continue;
      targets_[k].distance = sight->distance;
      targets_[k].direction = sight->direction;
      targets_[k].reached = true;
    }
  }

  /// Tries larger and larger balls until one is not empty.
  double grow(double radius, double most) {
    while (true) {
      const double smaller = shrink(radius);
      if (smaller < radius || radius >= most) return smaller;
      radius = std::min(most, 2 * radius);
    }
  }

  /// The largest empty ball that is not larger than `radius`.
  double shrink(double radius) {
    for (int round = 0; round < kMostRounds; ++round) {
      const Centre c = centre(radius);
      const double reach = radius * (1 - kEmpty);
      find_inside(c, reach);
      if (inside_.empty()) return radius;
      if (inside_.size() >= kCrowd) {
        // Much too large, most likely: a shot is enough to know.
        const uint32_t near = nearest_inside(position(surface_, c.point));
        const std::optional<Sight> sight = shoot(c.point, near);
        if (sight && sight->distance < reach) {
          radius = std::min(reach, through(near, in_plane(radius, *sight, c.arriving), radius));
          continue;
        }
      }
      measure_inside(c, reach, true);
      double least = radius;
      uint32_t touched = kNone;
      for (size_t k = 0; k < inside_.size(); ++k) {
        if (!targets_[k].reached) continue;
        const double r = in_plane(radius, {targets_[k].distance, targets_[k].direction}, c.arriving);
        if (r < least) {
          least = r;
          touched = inside_[k];
        }
      }
      if (touched == kNone) return radius;
      radius = radius - least > kClose * radius ? std::min(radius, through(touched, least, radius)) : least;
    }
    return radius;
  }

  uint32_t nearest_inside(const Vec3& centre) const {
    return *std::min_element(inside_.begin(), inside_.end(), [&](uint32_t p, uint32_t q) {
      return (obstacles_.positions[p] - centre).squaredNorm() < (obstacles_.positions[q] - centre).squaredNorm();
    });
  }

  /// The radius of the ball through a point, if it is below `most`; else `most`.
  double through(uint32_t point, double guess, double most) {
    double low = 0, high = most, radius = guess;
    for (int round = 0; round < kMostRounds && high - low > kEmpty * high; ++round) {
      const Centre c = centre(radius);
      std::optional<Sight> sight = shoot(c.point, point);
      if (!sight && radius <= large_) sight = search(c.point, point, kNearlyTouching * radius);
      if (!sight && round == 0) return most;
      (sight && sight->distance < radius ? high : low) = radius;
      double next = sight ? in_plane(radius, *sight, c.arriving) : high;
      if (std::abs(next - radius) <= kClose * radius) return std::min(next, most);
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      radius = next;
    }
    return high;
  }

  /// The shortest path from a centre to a point, if it is shorter than `most`.
  std::optional<Sight> search(const FlatPoint& from, uint32_t point, double most) {
    GeodesicDistance::Target target{obstacles_.points[point], obstacles_.positions[point], most, {}, false};
    distance_.measure(from, {&target, 1});
    if (!target.reached) return std::nullopt;
    return Sight{target.distance, target.direction};
  }

  /// A straight path from a centre to a point, if aiming at it finds one: where the surface is simple it
  /// is the shortest, and costs a fraction of the search. It leaves towards the point as that is seen
  /// through space, and is corrected by what is missing at its end, seen in the plane of the face
  /// there.
  std::optional<Sight> shoot(const FlatPoint& from, uint32_t point) const {
    const FlatPoint& aim = obstacles_.points[point];
    const Vec3& goal = obstacles_.positions[point];
    const Vec3 chord = goal - position(surface_, from);
    Vec2 way = chord.norm() * unit(surface_.to_plane(from.face, chord));
    for (int shot = 0; shot < kMostShots; ++shot) {
      const Landing landing = walk_straight(surface_, from, way);
      if (landing.hit_boundary) return std::nullopt;
      const FlatPoint& end = landing.end;
      const Vec2 missing = end.face == aim.face ? aim.place - end.place
                                                : surface_.to_plane(end.face, goal - position(surface_, end));
      const double length = norm(way), left = norm(missing);
      if (!(left <= kLost * length)) return std::nullopt;
      way = way + landing.turn * missing;
      if (left > kClose * length) continue;
      if (end.face == aim.face) return Sight{norm(way), unit(way)};
      // Near in space is not yet near on the surface.
      const FlatPoint rest = walk_straight(surface_, end, missing).end;
      if (rest.face == aim.face && norm(aim.place - rest.place) <= kClose * left) return Sight{norm(way), unit(way)};
    }
    return std::nullopt;
  }

  /// The radius of the circle that touches the curve at the node and passes through a point which is seen
  /// like this from the centre of the circle of radius `radius`, if the surface between is flat.
  static double in_plane(double radius, const Sight& sight, Vec2 arriving) {
    const double cosine = dot(sight.direction, arriving), d = sight.distance;
    const double ahead = radius + d * cosine;
    if (!(ahead > 0)) return std::numeric_limits<double>::infinity();
    return (radius * radius + d * d + 2 * radius * d * cosine) / (2 * ahead);
  }

  const Surface& surface_;
  const Obstacles& obstacles_;
  const RunTree& tree_;
  GeodesicDistance distance_;
  uint32_t node_ = 0;
  Vec2 way_;
  double large_ = 0;
  std::vector<uint32_t> inside_;
  std::vector<GeodesicDistance::Target> targets_;
};

void add_boundary(const Surface& surface, const BoundaryObstacle& boundary, Obstacles& obstacles) {
  for (size_t k = 0; k < boundary.samples().size(); ++k) {
    const uint32_t f = face_of(boundary.edges()[k]);
    const Vec3& p = boundary.samples()[k];
    obstacles.points.push_back({f, surface.to_plane(f, p - surface.position(surface.face(f)[0]))});
    obstacles.positions.push_back(p);
  }
}

}  // namespace

void compute_geodesic_medial_axis(const Surface& surface, const Curve& curve, const Frames& frames,
                                  const BoundaryObstacle& boundary, BoundaryRule rule,
                                  const std::vector<double>& local_radius, const std::vector<double>& max_radius,
                                  const std::vector<double>& overhang, const std::vector<double>& least_rest,
                                  Team& team, std::vector<Radii>& radii) {
  const uint32_t n = curve.size();
  radii.resize(n);
  Obstacles obstacles{{}, frames.position};
  for (const SurfacePoint& p : curve.nodes) obstacles.points.push_back({p.face, flat(surface, p)});
  const bool walls = rule == BoundaryRule::kObstacle;
  if (walls) add_boundary(surface, boundary, obstacles);
  const RunTree tree(obstacles.positions, team);

  constexpr size_t kBlock = 64;
  team.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
    Balls balls(surface, obstacles, tree);
    std::vector<Crossing> scratch;
    for (uint32_t i = static_cast<uint32_t>(begin); i < end; ++i) {
      // Whatever else a ball may not pass, its centre is a point of the surface.
      const std::array<Reach, 2> reach = reach_of_balls(surface, curve, frames, boundary, i, max_radius[i],
                                                        walls ? 0 : overhang[i], walls ? 0 : least_rest[i], scratch);
      for (int side = 0; side < 2; ++side) {
        const Vec2 way = (side == 0 ? 1.0 : -1.0) * frames.bitangent2[i];
        radii[i][side] = reach[side].radius > 0
                             ? balls.largest(i, way, frames.outward[i][side], reach[side], local_radius[i])
                             : 0;
      }
    }
  });
}

}  // namespace meander
