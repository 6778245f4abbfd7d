// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/geodesic_medial_axis.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geodesic/chart.h"

namespace meander {
namespace {

/// Near a crease what limits the straight ball is believed if the normals at both ends differ by less than this (a
/// cosine), and the line between them leaves either plane by less than this (a sine).
constexpr double kAlike = 0.7, kRise = 0.36;

/// And if the ball grows in the direction of the surface (a cosine): beside an edge, where it grows towards what lies
/// behind the edge, it is another ball.
constexpr double kAhead = 0.98;

/// Where the two directions differ more than this (a cosine), as round the edge of a blade, what limits the straight
/// ball is no help in finding what limits the ball along the surface.
constexpr double kStraightOn = 0.7;

/// Beside a sharp edge larger balls, in r, are not believed: what is round the edge may not be ahead at all.
constexpr double kWide = 1.4;

/// What is measured along the surface and found this near to the straight distance is what limits the ball.
constexpr double kSame = 1.04;

/// Else the next is measured, as long as the straight ball that it limits is less than so many times the least.
constexpr double kMargin = 1.12;
constexpr uint32_t kMostStrands = 3;

/// The neighbours on the strand of what limits a ball that are measured with it, on both sides.
constexpr uint32_t kNeighbours = 7;

/// Lines to what limits a ball are no longer than this many r, and rays than twice as many: however wide the clamp, a
/// ball is then found in bounded time.
constexpr double kLongest = 8;

/// Where normals differ by more than this (a cosine) no line that aims through space leads there.
constexpr double kOpposite = -0.3;

/// Points this much inside of a ball, as its centre sees them, make it smaller (a share of the radius), and balls of up
/// to so many r are seen from there, at most so often.
constexpr double kInside = 0.02, kSeenFromCentre = 2;
constexpr int kMostRounds = 3;

/// Rays go ahead, and at 0.7 and 1.25 radians to either side.
constexpr std::array<Vec2, 5> kRays{{{1, 0},
                                     {0.7648421872844885, 0.644217687237691},
                                     {0.7648421872844885, -0.644217687237691},
                                     {0.3153223623952687, 0.9489846193555862},
                                     {0.3153223623952687, -0.9489846193555862}}};

/// The search looks around points this far apart on rays, as far around, in r.
constexpr double kStep = 0.6, kAround = 0.6;

/// A point is seen in the plane of another face if their normals differ by less than this cosine.
constexpr double kNearlyFlat = 0.9;

/// Everything that balls may touch, and the patches that it lies in.
class Obstacles {
 public:
  Obstacles(const Surface& surface, const SurfacePatches& patches, const Curve& curve, const Frames& frames,
            const BoundaryObstacle& boundary, BoundaryRule rule, ThreadPool& pool)
      : curve_(curve) {
    if (rule == BoundaryRule::kObstacle && !boundary.empty()) add_walls(surface, frames, boundary);
    const std::vector<Vec3>& at = with_walls_.empty() ? frames.position.values() : with_walls_;
    positions_ = at;
    patch_.resize(at.size());
    pool.for_blocks(at.size(), 512, [&](size_t, size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) patch_[i] = patches.patch_of(surface, point(static_cast<uint32_t>(i)));
    });
  }
  Obstacles(const Obstacles&) = delete;
  Obstacles& operator=(const Obstacles&) = delete;

  /// The nodes, and samples of the boundary after them.
  std::span<const Vec3> positions() const { return positions_; }
  const SurfacePoint& point(uint32_t i) const {
    return i < curve_.size() ? curve_.nodes[i] : walls_[i - curve_.size()];
  }
  uint32_t patch(size_t i) const { return patch_[i]; }
  std::span<const uint32_t> patches() const { return patch_; }

 private:
  void add_walls(const Surface& surface, const Frames& frames, const BoundaryObstacle& boundary) {
    with_walls_ = frames.position.values();
    with_walls_.insert(with_walls_.end(), boundary.samples().begin(), boundary.samples().end());
    for (size_t k = 0; k < boundary.samples().size(); ++k) {
      const uint32_t f = face_of(boundary.edges()[k]);
      const Vec3 from_corner = boundary.samples()[k] - surface.position(surface.face(f)[0]);
      walls_.push_back(point_at(surface, f, surface.to_plane(f, from_corner)));
    }
  }

  const Curve& curve_;
  std::vector<Vec3> with_walls_;
  std::vector<SurfacePoint> walls_;
  std::span<const Vec3> positions_;
  std::vector<uint32_t> patch_;
};

/// What balls are measured in.
struct Scene {
  const Surface& surface;
  const SurfacePatches& patches;
  const Curve& curve;
  const Frames& frames;
  const Obstacles& obstacles;
  const CurveBvh& tree;

  bool sees(size_t i, uint32_t j) const { return !patches.hidden(obstacles.patch(i), obstacles.patch(j)); }
  /// Does a point face away from a patch?
  bool opposite(uint32_t patch, uint32_t p) const {
    return patches.normal(patch).dot(patches.normal(obstacles.patch(p))) < kOpposite;
  }
  /// A bit for each point of a run of the tree that is not hidden from a patch.
  uint32_t seen_of(uint32_t patch, uint32_t run) const {
    const std::span<const uint32_t> there = obstacles.patches();
    const size_t first = size_t{run} * CurveBvh::kRun, end = std::min(first + CurveBvh::kRun, there.size());
    uint32_t lanes = 0;
    bool hidden = false;
    for (size_t j = first; j < end; ++j) {
      if (j == first || there[j] != there[j - 1]) hidden = patches.hidden(patch, there[j]);
      lanes |= (hidden ? 0u : 1u) << (j - first);
    }
    return lanes;
  }
};

/// One ball after the other, and the scratch memory of one thread.
class GeodesicBall {
 public:
  explicit GeodesicBall(const Scene& scene) : scene_(scene) {}

  /// The radius of the largest empty ball on one side of a node.
  ///
  /// `straight`, `touched`  the ball through space among what the node sees, and the index of what limits it
  /// `likely`               what it is probably less than, which only saves time; at most `most`
  /// `r`                    the local one
  double largest(uint32_t node, size_t side, double straight, uint32_t touched, double likely, double most, double r) {
    node_ = node;
    outward_ = scene_.frames.outward[node][side];
    ahead_ = (side == 0 ? 1.0 : -1.0) * scene_.frames.bitangent2[node];
    r_ = r;
    least_ = most;
    excluded_count_ = 0;
    const SurfacePatches& patches = scene_.patches;
    const uint32_t patch = scene_.obstacles.patch(node);
    bool certain = touched != kNone;  // that it is met through space as well
    const double along = outward_.dot(scene_.surface.to_space(face(), ahead_));
    straight_on_ = along >= kStraightOn;
    certain = certain && straight_on_ && (straight <= kWide * r || !patches.sharp(patch));
    if (certain && alike(touched) && (along >= kAhead || !holds_crease(straight))) return straight;
    if (!certain || scene_.opposite(patch, touched) || !measure(straight, touched, most)) search_below(likely);
    if (patches.sharp(patch)) look_from_centre();
    return least_;
  }

 private:
  uint32_t face() const { return scene_.curve.nodes[node_].face; }
  Chart here() const { return Chart::at(scene_.curve.nodes[node_], scene_.obstacles.positions()[node_]); }

  /// That of the patch, where it is of one face of a crease only.
  const Vec3& normal_at(uint32_t p, uint32_t patch) const {
    return scene_.patches.at_crease(patch) ? scene_.surface.face_normal(scene_.obstacles.point(p).face)
                                           : scene_.patches.normal(patch);
  }

  /// Does the straight line to a point lie along the surface?
  bool alike(uint32_t p) const {
    const uint32_t from = scene_.obstacles.patch(node_), to = scene_.obstacles.patch(p);
    if (scene_.patches.bent(from) || scene_.patches.bent(to)) return false;
    const Vec3 &a = normal_at(node_, from), &b = normal_at(p, to);
    if (a.dot(b) < kAlike) return false;
    const Vec3 d = scene_.obstacles.positions()[p] - scene_.obstacles.positions()[node_];
    const double rise = kRise * d.norm();
    return std::abs(d.dot(a)) <= rise && std::abs(d.dot(b)) <= rise;
  }

  /// Measures what limits the straight ball, and then what limits it next. False if that is not to be had, as where
  /// no straight path leads to it.
  bool measure(double straight, uint32_t touched, double most) {
    for (uint32_t k = 0; k < kMostStrands; ++k) {
      Chart chart = here();
      const Vec3& goal = scene_.obstacles.positions()[touched];
      if (!chart.advance_to(scene_.surface, scene_.obstacles.point(touched), goal, kLongest * r_)) return false;
      note(chart.place);
      note_neighbours(touched, chart);
      if (least_ <= kSame * straight || k + 1 == kMostStrands) return true;
      excluded_[excluded_count_++] = {touched < kNeighbours ? 0 : touched - kNeighbours, touched + kNeighbours};
      const double next = std::min(most, kMargin * least_);
      straight = scene_.tree.largest_ball_seen(scene_.frames.position[node_], outward_, next,
                                               [&](uint32_t j) { return counts(j); }, touched);
      if (touched == kNone) return true;
      if (!alike(touched)) continue;
      least_ = std::min(least_, straight);
      return true;
    }
    return true;
  }

  bool counts(uint32_t j) const {
    for (uint32_t k = 0; k < excluded_count_; ++k) {
      if (j >= excluded_[k][0] && j <= excluded_[k][1]) return false;
    }
    return scene_.sees(node_, j);
  }

  void note(Vec2 place) {
    const double ahead = dot(place, ahead_);
    if (ahead > 0) least_ = std::min(least_, dot(place, place) / (2 * ahead));
  }

  /// Notes the neighbours of a node on its strand, from where the node is seen.
  void note_neighbours(uint32_t p, const Chart& seen) {
    const Curve& curve = scene_.curve;
    const Surface& s = scene_.surface;
    if (p >= curve.size()) return;
    for (const bool forward : {false, true}) {
      Chart chart = seen;
      uint32_t q = p;
      for (uint32_t k = 0; k < kNeighbours; ++k) {
        q = forward ? curve.next(q) : curve.previous(q);
        if (q == kNone || q == node_) break;
        const double before = least_;
        const SurfacePoint& at = curve.nodes[q];
        const Vec3& position = scene_.frames.position[q];
        if (s.face_normal(at.face).dot(s.face_normal(chart.point.face)) >= kNearlyFlat) {
          note(chart.place + chart.turn * s.to_plane(chart.point.face, position - chart.position));
        } else if (chart.advance_to(s, at, position, r_)) {
          note(chart.place);
        } else {
          break;
        }
        if (!(least_ < before)) break;
      }
    }
  }

  /// Whether a straight ball of this radius reaches a crease: a little more than it, as on a surface that bends a
  /// little its centre is not quite known.
  bool holds_crease(double radius) const {
    constexpr double kMore = 1.05;
    return scene_.patches.crease_within(scene_.frames.position[node_] + radius * outward_, kMore * radius);
  }

  /// Makes the ball smaller until its centre sees nothing in it. Beside a corner, as that of a cube, what the node sees
  /// along one straight path is nearer to the centre along another, on the other side of the corner.
  void look_from_centre() {
    for (int round = 0; round < kMostRounds; ++round) {
      const double radius = least_;
      if (radius > kSeenFromCentre * r_ || (straight_on_ && !holds_crease(radius))) return;
      Chart way = here();
      way.advance(scene_.surface, radius * ahead_);
      if (way.at_boundary) return;
      const Vec2 arriving = conj(way.turn) * ahead_;
      const double inside = (1 - kInside) * radius;
      scene_.tree.inside(way.position, inside, near_centre_);
      for (const uint32_t p : near_centre_) {
        if (p == node_ || !scene_.sees(node_, p)) continue;
        Chart seen = Chart::at(way.point, way.position);
        if (!seen.advance_to(scene_.surface, scene_.obstacles.point(p), scene_.obstacles.positions()[p], 2 * radius)) {
          continue;
        }
        if (dot(seen.place, seen.place) >= inside * inside) continue;
        // From the node, if the surface between were flat.
        const Vec2 from_node = seen.place + radius * arriving;
        const double ahead = dot(from_node, arriving);
        if (ahead > 0) least_ = std::min(least_, dot(from_node, from_node) / (2 * ahead));
      }
      if (least_ >= (1 - kInside) * radius) return;
    }
  }

  /// Looks for what limits the ball, first among balls of less than `likely`: a ball that is known to be small reaches
  /// little. What the measuring has noted is true, even where it has not come to an end.
  void search_below(double likely) {
    const double noted = least_;
    least_ = std::min(noted, likely);
    search();
    if (least_ < likely || noted <= likely) return;
    least_ = noted;
    search();
  }

  /// Looks for what limits the ball along rays, as far as the ball reaches.
  void search() {
    const bool flat_known = straight_on_ && !scene_.patches.bent(scene_.obstacles.patch(node_));
    if (flat_known) {
      uint32_t touched;
      least_ = scene_.tree.largest_ball_seen(scene_.frames.position[node_], outward_, least_,
                                             [&](uint32_t j) { return scene_.sees(node_, j) && alike(j); }, touched);
    }
    // Where no crease is within reach of the ball, or in it, that was all.
    const double to_crease = flat_known ? scene_.patches.to_crease(scene_.obstacles.patch(node_)) : 0;
    if (to_crease > 2 * least_ || (flat_known && is_flat(least_))) return;
    look_around(here(), flat_known);
    for (const Vec2 turned : kRays) {
      const Vec2 direction = ahead_ * turned;
      const double half = 0.5 * kStep * r_;
      double from = 0, to = std::max(2 * half, to_crease - half);
      const auto within = [&] { return to - half <= 2 * std::min(least_, kLongest * r_) * turned.x; };
      if (!within()) continue;
      for (Chart chart = here(); within(); to += 2 * half) {
        chart.advance(scene_.surface, (to - from) * (conj(chart.turn) * direction));
        if (chart.at_boundary) break;
        look_around(chart, flat_known);
        from = to;
      }
    }
  }

  /// Does a ball of this radius hold no crease?
  bool is_flat(double radius) const {
    const SurfacePatches& patches = scene_.patches;
    if (holds_crease(radius)) return false;
    if (patches.to_bend(scene_.obstacles.patch(node_)) > 2 * radius) return true;
    Chart centre = here();
    centre.advance(scene_.surface, radius * ahead_);
    return !centre.at_boundary && patches.to_bend(patches.patch_of(scene_.surface, centre.point)) > radius;
  }

  /// `flat_known`  what lies in about the plane of the node is known already
  void look_around(const Chart& chart, bool flat_known) {
    const uint32_t patch = scene_.patches.patch_of(scene_.surface, chart.point);
    if (flat_known && !scene_.patches.at_crease(patch) &&
        scene_.patches.normal(patch).dot(scene_.patches.normal(scene_.obstacles.patch(node_))) >= kAlike) {
      return;
    }
    const std::span<const uint32_t> beside = scene_.patches.beside(patch);
    const Vec3& x = scene_.obstacles.positions()[node_];
    scene_.tree.visit_inside(chart.position, kAround * r_, [&](uint32_t index) {
      const Vec3& position = scene_.obstacles.positions()[index];
      // No path is shorter than the straight line, and no ball that a path limits is smaller than half of it.
      if (index == node_ || (position - x).squaredNorm() >= 4 * least_ * least_) return;
      const uint32_t there = scene_.obstacles.patch(index);
      if (there == patch || std::ranges::find(beside, there) != beside.end()) look_at(chart, index, position);
    });
  }

  void look_at(const Chart& chart, uint32_t index, const Vec3& position) {
    const Surface& s = scene_.surface;
    const SurfacePoint& p = scene_.obstacles.point(index);
    if (p.face == chart.point.face) {
      note(chart.place + chart.turn * (flat(s, p) - flat(s, chart.point)));
    } else if (s.face_normal(p.face).dot(s.face_normal(chart.point.face)) >= kNearlyFlat) {
      note(chart.place + chart.turn * s.to_plane(chart.point.face, position - chart.position));
    } else if (Chart there = chart; there.advance_to(s, p, position, r_)) {
      note(there.place);
    }
  }

  const Scene& scene_;
  // The ball that is looked for.
  uint32_t node_ = 0;
  Vec3 outward_;
  Vec2 ahead_;  // its direction in the plane of the node's face
  double r_ = 0, least_ = 0;
  bool straight_on_ = true;  // whether that is also about its direction in space
  uint32_t excluded_count_ = 0;
  std::array<std::array<uint32_t, 2>, kMostStrands> excluded_;
  std::vector<uint32_t> near_centre_;
};

/// The balls of nodes begin .. end - 1, a run of the tree or less.
class BallsOfRun {
 public:
  BallsOfRun(const Scene& scene, bool measure, const LocalMetric& metric, const NodeData<Reach>& reach,
             const CurveBvh::Sight& sight, NodeData<Radii>& radii)
      : scene_(scene), measure_(measure), metric_(metric), reach_(reach), sight_(sight), radii_(radii), ball_(scene) {}

  void find(uint32_t begin, uint32_t end) {
    bool hides = false, creased = false;
    for (uint32_t i = begin; i < end; ++i) {
      const uint32_t patch = scene_.obstacles.patch(i);
      hides = hides || scene_.patches.hides(patch);
      creased = creased || scene_.patches.creased(patch);
      for (size_t side = 0; side < 2; ++side) {
        const double most = std::max(0.0, reach_[i][side].radius), last = radii_[i][side];
        start_[i - begin][side] = radii_[i][side] = last > 0 ? std::min(most, kWarmth * last) : most;
      }
    }
    if (hides) {
      scene_.tree.largest_balls_seen(begin, end, scene_.frames.outward, sight_, radii_, touched_);
    } else if (creased) {
      scene_.tree.largest_balls(begin, end, scene_.frames.outward, radii_, touched_);
    } else {
      scene_.tree.largest_balls(begin, end, scene_.frames.outward, radii_);
    }
    for (uint32_t i = begin; i < end; ++i) {
      for (size_t side = 0; side < 2; ++side) {
        if (reach_[i][side].radius > 0) finish(i, side, start_[i - begin][side], touched_[i - begin][side]);
      }
    }
  }

 private:
  void finish(uint32_t i, size_t side, double start, uint32_t touched) {
    const uint32_t patch = scene_.obstacles.patch(i);
    const bool creased = scene_.patches.creased(patch);
    double& radius = radii_[i][side];
    const double most = reach_[i][side].radius;
    // An empty ball that no point limits is only a lower bound: start again from the clamp.
    if (!(radius < start) && radius < most) {
      const Vec3 &x = scene_.frames.position[i], &outward = scene_.frames.outward[i][side];
      radius = scene_.patches.hides(patch)
                   ? scene_.tree.largest_ball_seen(x, outward, most,
                                                   [&](uint32_t j) { return scene_.sees(i, j); }, touched)
                   : scene_.tree.largest_ball(x, outward, most, creased ? &touched : nullptr);
    }
    if (!creased) return;
    if (measure_) {
      radius = ball_.largest(i, side, radius, touched, start, most, metric_.radius[i]);
    } else if (touched != kNone && opposite(i, touched)) {
      radius = largest_but_opposite(i, side, start);
      if (!(radius < start) && radius < most) radius = largest_but_opposite(i, side, most);
    }
  }

  bool opposite(uint32_t i, uint32_t p) const { return scene_.opposite(scene_.obstacles.patch(i), p); }

  /// The straight ball that what faces the other way does not limit. That lies round an edge, as on the other side of a
  /// plate, and is farther along the surface than through space; believed, it keeps strands on both sides away from
  /// the edge that a growing curve has to get round.
  double largest_but_opposite(uint32_t i, size_t side, double most) const {
    uint32_t touched;
    return scene_.tree.largest_ball_seen(scene_.frames.position[i], scene_.frames.outward[i][side], most,
                                         [&](uint32_t j) { return scene_.sees(i, j) && !opposite(i, j); }, touched);
  }

  const Scene& scene_;
  bool measure_;
  const LocalMetric& metric_;
  const NodeData<Reach>& reach_;
  const CurveBvh::Sight& sight_;
  NodeData<Radii>& radii_;
  GeodesicBall ball_;
  std::array<Radii, CurveBvh::kRun> start_;
  std::array<std::array<uint32_t, 2>, CurveBvh::kRun> touched_;
};

}  // namespace

void compute_geodesic_medial_axis(const Surface& surface, const SurfacePatches& patches, const Curve& curve,
                                  const Frames& frames, const BoundaryObstacle& boundary, BoundaryRule rule,
                                  bool measure, const LocalMetric& metric, const NodeData<Reach>& reach,
                                  ThreadPool& pool, CurveBvh& tree, NodeData<Radii>& radii) {
  const uint32_t n = curve.size();
  radii.resize(n, Radii{0, 0});
  const Obstacles obstacles(surface, patches, curve, frames, boundary, rule, pool);
  tree.build(obstacles.positions(), pool);
  const Scene scene{surface, patches, curve, frames, obstacles, tree};
  const CurveBvh::Sight sight{obstacles.patches(),
                              [&](uint32_t patch, uint32_t run) { return scene.seen_of(patch, run); }};
  constexpr size_t kBlock = 256;
  pool.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
    BallsOfRun balls(scene, measure, metric, reach, sight, radii);
    for (auto first = static_cast<uint32_t>(begin); first < end; first += CurveBvh::kRun) {
      balls.find(first, std::min(first + CurveBvh::kRun, static_cast<uint32_t>(end)));
    }
  });
}

}  // namespace meander
