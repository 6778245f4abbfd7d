// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/geodesic_medial_axis.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geodesic/chart.h"

namespace meander {
namespace {

/// A ball may start this much larger than the node's last one before it is known to be large enough.
constexpr double kWarmth = 1.2;

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

/// The search looks around points this far apart on rays, as far around, in r.
constexpr double kStep = 0.6, kAround = 0.6;

/// A point is seen in the plane of another face if their normals differ by less than this cosine.
constexpr double kNearlyFlat = 0.9;

/// Everything that balls may touch, patch by patch.
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
    sort(patches.count());
  }
  Obstacles(const Obstacles&) = delete;
  Obstacles& operator=(const Obstacles&) = delete;

  /// The nodes, and samples of the boundary after them.
  std::span<const Vec3> positions() const { return positions_; }
  const SurfacePoint& point(uint32_t i) const {
    return i < curve_.size() ? curve_.nodes[i] : walls_[i - curve_.size()];
  }
  uint32_t patch(size_t i) const { return patch_[i]; }

  struct Place {
    Vec3 position;
    uint32_t index;
  };
  std::span<const Place> in_patch(uint32_t patch) const {
    return std::span(sorted_).subspan(first_[patch], first_[patch + 1] - first_[patch]);
  }

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

  void sort(uint32_t patches) {
    first_.assign(patches + 1, 0);
    for (const uint32_t p : patch_) ++first_[p + 1];
    for (uint32_t p = 0; p < patches; ++p) first_[p + 1] += first_[p];
    sorted_.resize(patch_.size());
    std::vector<uint32_t> at(first_.begin(), first_.end() - 1);
    for (uint32_t i = 0; i < patch_.size(); ++i) sorted_[at[patch_[i]]++] = {positions_[i], i};
  }

  const Curve& curve_;
  std::vector<Vec3> with_walls_;
  std::vector<SurfacePoint> walls_;
  std::span<const Vec3> positions_;
  std::vector<uint32_t> patch_;
  std::vector<uint32_t> first_;
  std::vector<Place> sorted_;
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
};

/// One ball after the other, and the scratch memory of one thread.
class GeodesicBall {
 public:
  explicit GeodesicBall(const Scene& scene) : scene_(scene) {}

  /// The radius of the largest empty ball on one side of a node.
  ///
  /// `straight`, `touched`  the ball through space among what the node sees, and the index of what limits it
  /// `r`                    the local one
  double largest(uint32_t node, size_t side, double straight, uint32_t touched, double most, double r) {
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
    if (certain && along >= kAhead && alike(touched)) return straight;
    if (!certain || opposite(touched) || !measure(straight, touched, most)) search();
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

  bool opposite(uint32_t p) const {
    return scene_.patches.normal(scene_.obstacles.patch(node_)).dot(scene_.patches.normal(scene_.obstacles.patch(p))) <
           kOpposite;
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

  /// Makes the ball smaller until its centre sees nothing in it. Beside a corner, as that of a cube, what the node sees
  /// along one straight path is nearer to the centre along another, on the other side of the corner.
  void look_from_centre() {
    for (int round = 0; round < kMostRounds; ++round) {
      const double radius = least_;
      if (radius > kSeenFromCentre * r_) return;
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
    for (const double angle : {0.0, 0.7, -0.7, 1.25, -1.25}) {
      const Vec2 turned{std::cos(angle), std::sin(angle)};
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
    Chart centre = here();
    centre.advance(scene_.surface, radius * ahead_);
    return !centre.at_boundary &&
           scene_.patches.to_crease(scene_.patches.patch_of(scene_.surface, centre.point)) > radius;
  }

  /// `flat_known`  what lies in about the plane of the node is known already
  void look_around(const Chart& chart, bool flat_known) {
    const uint32_t patch = scene_.patches.patch_of(scene_.surface, chart.point);
    if (flat_known && !scene_.patches.at_crease(patch) &&
        scene_.patches.normal(patch).dot(scene_.patches.normal(scene_.obstacles.patch(node_))) >= kAlike) {
      return;
    }
    look_in(chart, patch);
    for (const uint32_t beside : scene_.patches.beside(patch)) look_in(chart, beside);
  }

  void look_in(const Chart& chart, uint32_t patch) {
    const Surface& s = scene_.surface;
    for (const Obstacles::Place& place : scene_.obstacles.in_patch(patch)) {
      const Vec3 d = place.position - chart.position;
      if (d.squaredNorm() > kAround * kAround * r_ * r_ || place.index == node_) continue;
      const SurfacePoint& p = scene_.obstacles.point(place.index);
      if (p.face == chart.point.face) {
        note(chart.place + chart.turn * (flat(s, p) - flat(s, chart.point)));
      } else if (s.face_normal(p.face).dot(s.face_normal(chart.point.face)) >= kNearlyFlat) {
        note(chart.place + chart.turn * s.to_plane(chart.point.face, d));
      } else if (Chart there = chart; there.advance_to(s, p, place.position, r_)) {
        note(there.place);
      }
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
             NodeData<Radii>& radii, NodeData<std::array<uint32_t, 2>>& touched)
      : scene_(scene), measure_(measure), metric_(metric), reach_(reach), radii_(radii), touched_(touched),
        ball_(scene) {}

  void find(uint32_t begin, uint32_t end) {
    bool plain = true, thin = false;
    for (uint32_t i = begin; i < end; ++i) {
      const uint32_t patch = scene_.obstacles.patch(i);
      plain = plain && !scene_.patches.hides(patch) && !(measure_ && scene_.patches.creased(patch));
      thin = thin || scene_.patches.thin(patch);
      for (size_t side = 0; side < 2; ++side) {
        const double most = std::max(0.0, reach_[i][side].radius), last = radii_[i][side];
        start_[i - begin][side] = radii_[i][side] = last > 0 ? std::min(most, kWarmth * last) : most;
      }
    }
    const auto sees = [&](size_t i, uint32_t j) { return scene_.sees(i, j); };
    if (plain) {
      scene_.tree.largest_balls(begin, end, scene_.frames.outward, radii_);
    } else if (thin) {
      scene_.tree.largest_balls_seen(begin, end, scene_.frames.outward, sees, radii_, touched_);
    } else {
      scene_.tree.largest_balls(begin, end, scene_.frames.outward, radii_, touched_);
    }
    for (uint32_t i = begin; i < end; ++i) {
      for (size_t side = 0; side < 2; ++side) {
        if (reach_[i][side].radius > 0) finish(i, side, start_[i - begin][side], plain, thin);
      }
    }
  }

 private:
  void finish(uint32_t i, size_t side, double start, bool plain, bool thin) {
    double& radius = radii_[i][side];
    uint32_t& touched = touched_[i][side];
    const double most = reach_[i][side].radius;
    if (!plain && !thin && touched != kNone && !scene_.sees(i, touched)) radius = straight(i, side, start);
    // An empty ball that no point limits is only a lower bound: start again from the clamp.
    if (!(radius < start) && radius < most) {
      radius = plain ? scene_.tree.largest_ball(scene_.frames.position[i], scene_.frames.outward[i][side], most)
                     : straight(i, side, most);
    }
    if (!measure_ || !scene_.patches.creased(scene_.obstacles.patch(i))) return;
    radius = ball_.largest(i, side, radius, touched, most, metric_.radius[i]);
  }

  double straight(uint32_t i, size_t side, double most) {
    return scene_.tree.largest_ball_seen(scene_.frames.position[i], scene_.frames.outward[i][side], most,
                                         [&](uint32_t j) { return scene_.sees(i, j); }, touched_[i][side]);
  }

  const Scene& scene_;
  bool measure_;
  const LocalMetric& metric_;
  const NodeData<Reach>& reach_;
  NodeData<Radii>& radii_;
  NodeData<std::array<uint32_t, 2>>& touched_;
  GeodesicBall ball_;
  std::array<Radii, CurveBvh::kRun> start_;
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
  NodeData<std::array<uint32_t, 2>> touched(n, {kNone, kNone});
  constexpr size_t kBlock = 256;
  pool.for_blocks(n, kBlock, [&](size_t, size_t begin, size_t end) {
    BallsOfRun balls(scene, measure, metric, reach, radii, touched);
    for (auto first = static_cast<uint32_t>(begin); first < end; first += CurveBvh::kRun) {
      balls.find(first, std::min(first + CurveBvh::kRun, static_cast<uint32_t>(end)));
    }
  });
}

}  // namespace meander
