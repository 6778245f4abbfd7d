// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "geodesic/geodesic_trace.h"
#include "geodesic_distance.h"
#include "medial/curve_bvh.h"

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
/// expensive: there straight paths that a shot finds are all that counts.
constexpr double kLarge = 3;

/// A ball in space that holds this many nodes is hardly ever empty on the surface.
constexpr size_t kCrowd = 4;

/// In space, the search for a ball starts from this many times the node's last radius.
constexpr double kWarmth = 1.2;

/// In a large ball no more is looked for after this many points that no shot hit.
constexpr int kMostMissed = 8;

/// A straight path that is longer than the chord by no more than this share counts as the shortest.
constexpr double kDirect = 0.005;

constexpr int kMostRounds = 30;

/// Everything that balls may touch.
struct Obstacles {
  std::vector<FlatPoint> points;  // nodes first
  std::vector<Vec3> positions;
};

/// The balls of one node after the other, and the scratch memory of one thread.
class Balls {
 public:
  Balls(const Surface& surface, const Obstacles& obstacles, const CurveBvh& tree)
      : surface_(surface), obstacles_(obstacles), tree_(tree), distance_(surface) {}

  /// The radius of the largest empty ball that starts at a node along `direction` (unit, in the plane
  /// of its face). `outward` is about the direction of its centre in space, `usual` about the radius to be
  /// expected where that misleads, `last` that of an earlier state, or 0.
  double largest(uint32_t node, Vec2 direction, const Vec3& outward, const ReachOfSide& reach, double usual,
                 double last) {
    node_ = node;
    direction_ = direction;
    ray_.reset(surface_, obstacles_.points[node], direction);
    large_ = kLarge * usual * (1 + kEmpty);
    const double most = std::min(reach.radius, distance_to_boundary(reach.radius));
    const double radius = largest_on_surface(outward, most, usual, last);
    return radius < most || reach.radius <= most ? radius : largest_beyond(most, reach.radius);
  }

 private:
  /// Where the centre of a ball is, and in which direction (unit, in the plane of its face) the geodesic
  /// from the node arrives there.
  struct Centre {
    FlatPoint point;
    Vec2 arriving;
  };
  /// A path from a centre to a point: its length and the direction in which it leaves.
  struct Sight {
    double distance;
    Vec2 direction;
  };

  /// Along the ray, at most `most`: a centre may come no farther on the surface.
  double distance_to_boundary(double most) const {
    Path path;
    const FlatPoint& from = obstacles_.points[node_];
    return trace_geodesic(surface_, point_at(surface_, from.face, from.place), most * direction_, path).length;
  }

  Centre centre(double radius) {
    const Landing landing = ray_.at(radius);
    return {landing.end, conj(landing.turn) * direction_};
  }

  double largest_on_surface(const Vec3& outward, double most, double usual, double last) {
    uint32_t touched = kNone;
    const double guess = largest_in_space(outward, most, last, touched);
    if (touched == kNone) return shrink(most);
    const double radius = through(touched, guess, most);
    if (radius < most) return shrink(radius, touched);
    // Another sheet, most likely. The right ball is larger, but hardly as large as it may be.
    return grow(std::min(most, std::max(2 * guess, 1.25 * usual)), most);
  }

  /// The largest empty ball in space and the point that it touches; `last` only saves time.
  double largest_in_space(const Vec3& outward, double most, double last, uint32_t& touched) const {
    const double start = last > 0 ? std::min(most, kWarmth * last) : most;
    const double radius = tree_.largest_ball(obstacles_.positions[node_], outward, start, &touched);
    if (touched != kNone || start == most) return radius;
    return tree_.largest_ball(obstacles_.positions[node_], outward, most, &touched);
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

  /// Measures what was found along the surface: all of it, or only the nearest, and then others as far as
  /// they come to light in between. A shot does for a point that is reached on hardly more than the
  /// chord: no path is shorter.
  void measure_inside(const Centre& c, double reach, bool nearest_only) {
    const bool large = reach > large_;
    const Vec3 from = position(surface_, c.point);
    if (large) {
      std::ranges::sort(inside_, {}, [&](uint32_t p) { return (obstacles_.positions[p] - from).squaredNorm(); });
    }
    targets_.clear();
    for (const uint32_t p : inside_) {
      targets_.push_back({obstacles_.points[p], obstacles_.positions[p], reach, {}, false});
    }
    double least = reach;
    int missed = 0;
    for (size_t k = 0; k < inside_.size() && missed < kMostMissed; ++k) {
      const double chord = (targets_[k].position - from).norm();
      if (large && nearest_only && !(chord < least)) break;
      const std::optional<Sight> sight = shoot(c.point, inside_[k]);
      if (!large && !(sight && sight->distance <= (1 + kDirect) * chord)) {
        for (GeodesicDistance::Target& t : targets_) t.distance = reach;
        distance_.measure(c.point, targets_, nearest_only);
        break;
      }
      missed += !sight;
      if (!sight || !(sight->distance < reach)) continue;
      targets_[k].distance = sight->distance;
      targets_[k].direction = sight->direction;
      targets_[k].reached = true;
      least = std::min(least, sight->distance);
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

  /// The largest empty ball that is not larger than `radius`, at which the ball touches `touched`.
  double shrink(double radius, uint32_t touched = kNone) {
    for (int round = 0; round < kMostRounds; ++round) {
      const Centre c = centre(radius);
      const double reach = radius * (1 - kEmpty);
      find_inside(c, reach);
      if (touched != kNone) std::erase(inside_, touched);
      if (inside_.empty()) return radius;
      if (inside_.size() >= kCrowd) {
        // Much too large, most likely: a shot is enough to know.
        const uint32_t near = nearest_inside(position(surface_, c.point));
        const std::optional<Sight> sight = shoot(c.point, near);
        if (sight && sight->distance < reach) {
          radius = std::min(reach, through(near, in_plane(radius, *sight, c.arriving), radius));
          touched = near;
          continue;
        }
      }
      measure_inside(c, reach, true);
      double least = radius;
      uint32_t nearest = kNone;
      for (size_t k = 0; k < inside_.size(); ++k) {
        if (!targets_[k].reached) continue;
        const double r = in_plane(radius, {targets_[k].distance, targets_[k].direction}, c.arriving);
        if (r < least) {
          least = r;
          nearest = inside_[k];
        }
      }
      if (nearest == kNone) return radius;
      touched = nearest;
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
    Vec2 line = chord.norm() * unit(surface_.to_plane(from.face, chord));
    for (int shot = 0; shot < kMostShots; ++shot) {
      const Landing landing = walk_straight(surface_, from, line);
      if (landing.hit_boundary) return std::nullopt;
      const FlatPoint& end = landing.end;
      const Vec2 missing = end.face == aim.face ? aim.place - end.place
                                                : surface_.to_plane(end.face, goal - position(surface_, end));
      const double length = norm(line), left = norm(missing);
      if (!(left <= kLost * length)) return std::nullopt;
      line = line + landing.turn * missing;
      if (left > kClose * length) continue;
      if (end.face == aim.face) return Sight{norm(line), unit(line)};
      // Near in space is not yet near on the surface.
      const FlatPoint rest = walk_straight(surface_, end, missing).end;
      if (rest.face == aim.face && norm(aim.place - rest.place) <= kClose * left) return Sight{norm(line), unit(line)};
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
  const CurveBvh& tree_;
  GeodesicDistance distance_;
  StraightRay ray_;
  uint32_t node_ = 0;
  Vec2 direction_;
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

void compute_geodesic_reference(const Surface& surface, const Curve& curve, const Frames& frames,
                                  const BoundaryObstacle& boundary, BoundaryRule rule,
                                  const LocalMetric& metric, const NodeData<Reach>& reach,
                                  ThreadPool& pool, NodeData<Radii>& radii) {
  const uint32_t n = curve.size();
  radii.resize(n, Radii{0, 0});
  Obstacles obstacles{{}, frames.position.values()};
  for (const SurfacePoint& p : curve.nodes) obstacles.points.push_back({p.face, flat(surface, p)});
  const bool walls = rule == BoundaryRule::kObstacle;
  if (walls) add_boundary(surface, boundary, obstacles);
  const CurveBvh tree(obstacles.positions, pool);

  constexpr size_t kBlock = 64;
  pool.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
    Balls balls(surface, obstacles, tree);
    for (uint32_t i = static_cast<uint32_t>(begin); i < end; ++i) {
      for (size_t side = 0; side < 2; ++side) {
        const Vec2 direction = (side == 0 ? 1.0 : -1.0) * frames.bitangent2[i];
        double& radius = radii[i][side];
        radius = reach[i][side].radius > 0
                     ? balls.largest(i, direction, frames.outward[i][side], reach[i][side], metric.radius[i], radius)
                     : 0;
      }
    }
  });
}

}  // namespace meander
