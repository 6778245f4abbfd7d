// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/geodesic_ball.h"

#include <algorithm>
#include <cmath>

namespace meander {
namespace {

/// Near a crease what limits the straight ball is believed if the normals at both ends differ by less than this (a
/// cosine), and the line between them leaves either plane by less than this (a sine).
constexpr double kAlike = 0.7, kRise = 0.36;

/// And if the ball grows in the direction of the surface (a cosine): beside an edge, where it grows towards what lies
/// behind the edge, it is another ball.
constexpr double kAhead = 0.98;

/// And if its radius differs by no more than this share in the plane of the node's face.
constexpr double kAgrees = 0.04;

/// Where the two directions differ more than this (a cosine), as round the edge of a blade, what limits the straight
/// ball is no help in finding what limits the ball along the surface.
constexpr double kStraightOn = 0.7;

/// Beside a sharp edge larger balls, in r, are not believed: what is round the edge may not be ahead at all.
constexpr double kWide = 1.4;

/// What is measured along the surface and found this near to the straight distance is what limits the ball.
constexpr double kSame = 1.04;

/// Else the next is measured, as long as the straight ball that it limits is less than so many times the least.
constexpr double kMargin = 1.12;

/// The neighbours on the strand of what limits a ball that are measured with it, on both sides.
constexpr uint32_t kNeighbours = 7;

/// Lines to what limits a ball are no longer than this many r, and rays than twice as many: however wide the clamp, a
/// ball is then found in bounded time.
constexpr double kLongest = 8;

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

/// What rays of one node come across is believed by others of the same run that are no farther from it than this, in r,
/// and whose balls are no larger than so many times its own.
constexpr double kBeside = 0.6, kAsLarge = 1.1;

/// A point is seen in the plane of another face if their normals differ by less than this cosine.
constexpr double kNearlyFlat = 0.95;

}  // namespace

double GeodesicBall::largest(uint32_t node, size_t side, double straight, uint32_t touched, double likely, double most,
                             double r) {
  node_ = node;
  outward_ = scene_.frames.outward[node][side];
  ahead_ = (side == 0 ? 1.0 : -1.0) * scene_.frames.bitangent2[node];
  r_ = r;
  least_ = most;
  excluded_count_ = 0;
  searched_ = false;
  const SurfacePatches& patches = scene_.patches;
  const uint32_t patch = scene_.obstacles.patch(node);
  bool certain = touched != kNone;  // that it is met through space as well
  const double along = outward_.dot(scene_.surface.to_space(face(), ahead_));
  straight_on_ = along >= kStraightOn;
  certain = certain && straight_on_ && (straight <= kWide * r || !patches.sharp(patch));
  // On a limb about r thick straight balls are off by up to an eighth, however alike the normals are.
  const bool flat =
      certain && patches.to_bend(patch) > 1.5 * straight &&
      ((along >= kAhead && agrees(straight, touched)) || !holds_crease(straight));
  if (flat && alike(touched)) return straight;
  if (!patches.coarse(patch) || !look_through_windows(likely, most, touched)) {
    note_own();
    const bool opposite = certain && patches.opposite(patch, scene_.obstacles.patch(touched));
    searched_ = !certain || opposite || !measure(straight, touched, most);
    if (searched_) search_below(likely);
  }
  if (patches.sharp(patch)) look_from_centre();
  return least_;
}

/// The ball by windows, which look first for one of less than `likely`; false if it reaches too many faces.
bool GeodesicBall::look_through_windows(double likely, double most, uint32_t touched) {
  const SurfacePoint& from = scene_.curve.nodes[node_];
  std::optional<double> radius = windows_.largest(from, node_, ahead_, std::min(likely, most));
  if (radius && windows_.touched() == kNone && likely < most) radius = windows_.largest(from, node_, ahead_, most);
  if (!radius) return false;
  least_ = *radius;
  searched_ = windows_.touched() != touched;
  return true;
}

/// That of the patch, where it is of one face of a crease only.
const Vec3& GeodesicBall::normal_at(uint32_t p, uint32_t patch) const {
  return scene_.patches.at_crease(patch) ? scene_.surface.face_normal(scene_.obstacles.point(p).face)
                                         : scene_.patches.normal(patch);
}

/// Does the straight line to a point lie along the surface?
bool GeodesicBall::alike(uint32_t p) const {
  const uint32_t from = scene_.obstacles.patch(node_), to = scene_.obstacles.patch(p);
  if (scene_.patches.bent(from) || scene_.patches.bent(to)) return false;
  const Vec3 &a = normal_at(node_, from), &b = normal_at(p, to);
  if (a.dot(b) < kAlike) return false;
  const Vec3 d = scene_.obstacles.positions()[p] - scene_.obstacles.positions()[node_];
  const double rise = kRise * d.norm();
  return std::abs(d.dot(a)) <= rise && std::abs(d.dot(b)) <= rise;
}

/// Whether what limits the straight ball limits one of about that size in the plane of the node's face as well. Beside
/// an edge the two directions differ a little, which makes another ball of a point that lies almost to the side.
bool GeodesicBall::agrees(double straight, uint32_t p) const {
  const Vec3 d = scene_.obstacles.positions()[p] - scene_.obstacles.positions()[node_];
  const double ahead = d.dot(scene_.surface.to_space(face(), ahead_));
  return std::abs(d.squaredNorm() - 2 * ahead * straight) <= kAgrees * d.squaredNorm();
}

/// Measures what limits the straight ball, and then what limits it next. False if that is not to be had, as where
/// no straight path leads to it.
bool GeodesicBall::measure(double straight, uint32_t touched, double most) {
  for (uint32_t k = 0; k < kMostStrands; ++k) {
    Chart chart = here();
    const Vec3& goal = scene_.obstacles.positions()[touched];
    if (!chart.advance_to(scene_.surface, scene_.obstacles.point(touched), goal, kLongest * r_)) return false;
    note(chart.place);
    note_neighbours(touched, chart);
    if (least_ <= kSame * straight || k + 1 == kMostStrands) return true;
    pass_over(touched);
    const double next = std::min(most, kMargin * least_);
    straight = scene_.tree.largest_ball_seen(scene_.frames.position[node_], outward_, next,
                                             [&](uint32_t j) { return counts(j); }, touched, part());
    if (touched == kNone) return true;
    if (!alike(touched)) continue;
    least_ = std::min(least_, straight);
    return true;
  }
  return true;
}

/// Takes a point, and its neighbours on the strand, out of what counts. Samples of the boundary have neighbours by
/// their numbers only.
void GeodesicBall::pass_over(uint32_t p) {
  const auto add = [&](uint32_t first, uint32_t last) { excluded_[excluded_count_++] = {first, last}; };
  const uint32_t nodes = scene_.curve.size();
  if (p >= nodes) return add(std::max(nodes, p - kNeighbours), p + kNeighbours);
  const auto after = std::ranges::upper_bound(scene_.curve.strands, p, {}, &Strand::first);
  const Strand& strand = *(after - 1);
  const uint32_t last = strand.end() - 1;
  const uint32_t back = std::min(kNeighbours, p - strand.first), ahead = std::min(kNeighbours, last - p);
  add(p - back, p + ahead);
  if (!strand.closed) return;
  // Those beyond its first node are its last ones, and those beyond its last node the first.
  if (back < kNeighbours) add(last - std::min(kNeighbours - back - 1, strand.count - 1), last);
  if (ahead < kNeighbours) add(strand.first, strand.first + std::min(kNeighbours - ahead, strand.count) - 1);
}

bool GeodesicBall::counts(uint32_t j) const {
  for (uint32_t k = 0; k < excluded_count_; ++k) {
    if (j >= excluded_[k][0] && j <= excluded_[k][1]) return false;
  }
  return scene_.sees(node_, j);
}

/// Notes the neighbours of the node on its strand, each by a line of its own: they lie almost to the side, where a
/// small error of a place, or of a direction, makes another ball of them.
void GeodesicBall::note_own() {
  const Curve& curve = scene_.curve;
  own_ = {curve.previous(node_), curve.next(node_)};
  for (uint32_t& q : own_) {
    if (q == kNone) continue;
    Chart chart = here();
    if (chart.advance_to(scene_.surface, curve.nodes[q], scene_.frames.position[q], r_)) {
      note(chart.place);
    } else {
      q = kNone;
    }
  }
}

void GeodesicBall::note(Vec2 place) {
  const double ahead = dot(place, ahead_);
  if (ahead > 0) least_ = std::min(least_, dot(place, place) / (2 * ahead));
}

/// Notes the neighbours of a node on its strand, from where the node is seen.
void GeodesicBall::note_neighbours(uint32_t p, const Chart& seen) {
  const Curve& curve = scene_.curve;
  const Surface& s = scene_.surface;
  if (p >= curve.size()) return;
  for (const bool forward : {false, true}) {
    Chart chart = seen;
    uint32_t q = p;
    for (uint32_t k = 0; k < kNeighbours; ++k) {
      q = forward ? curve.next(q) : curve.previous(q);
      if (q == kNone || q == node_) break;
      if (is_own(q)) continue;
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
bool GeodesicBall::holds_crease(double radius) const {
  constexpr double kMore = 1.05;
  return scene_.patches.crease_within(scene_.frames.position[node_] + radius * outward_, kMore * radius);
}

/// Makes the ball smaller until its centre sees nothing in it. Beside a corner, as that of a cube, what the node sees
/// along one straight path is nearer to the centre along another, on the other side of the corner.
void GeodesicBall::look_from_centre() {
  for (int round = 0; round < kMostRounds; ++round) {
    const double radius = least_;
    if (radius > kSeenFromCentre * r_ || (straight_on_ && !holds_crease(radius))) return;
    Chart way = here();
    way.advance(scene_.surface, radius * ahead_);
    if (way.at_boundary) return;
    const Vec2 arriving = conj(way.turn) * ahead_;
    const uint32_t there = scene_.patches.patch_of(scene_.surface, way.point);
    const double inside = (1 - kInside) * radius;
    scene_.tree.inside(way.position, inside, near_centre_, part());
    for (const uint32_t p : near_centre_) {
      if (p == node_ || !scene_.sees(node_, p)) continue;
      if (scene_.patches.opposite(there, scene_.obstacles.patch(p))) continue;
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
void GeodesicBall::search_below(double likely) {
  const double noted = least_;
  least_ = std::min(noted, likely);
  search();
  if (least_ < likely || noted <= likely) return;
  least_ = noted;
  search();
}

/// Looks for what limits the ball along rays, as far as the ball reaches.
void GeodesicBall::search() {
  const bool flat_known = straight_on_ && !scene_.patches.bent(scene_.obstacles.patch(node_));
  if (flat_known) {
    uint32_t touched;
    const auto counts = [&](uint32_t j) { return !is_own(j) && scene_.sees(node_, j) && alike(j); };
    least_ = scene_.tree.largest_ball_seen(scene_.frames.position[node_], outward_, least_, counts, touched, part());
  }
  // Where no crease is within reach of the ball, or in it, that was all.
  const double to_crease = flat_known ? scene_.patches.to_crease(scene_.obstacles.patch(node_)) : 0;
  if (to_crease > 2 * least_ || (flat_known && is_flat(least_))) return;
  if (seen_from_beside(flat_known)) return;
  Sighting& own = sightings_[node_ % CurveBvh::kRun];
  own.points.clear();
  lead_rays(to_crease, flat_known);
  own = {true, flat_known, least_, std::move(own.points)};
}

/// What limits the ball among what rays of its neighbours have come across; false if that may not be all.
bool GeodesicBall::seen_from_beside(bool flat_known) {
  const Curve& curve = scene_.curve;
  double known = 0;
  for (const bool forward : {false, true}) {
    uint32_t n = node_;
    for (int k = 0; k < 2; ++k) {
      n = forward ? curve.next(n) : curve.previous(n);
      if (n == kNone || n / CurveBvh::kRun != node_ / CurveBvh::kRun) break;
      const Sighting& there = sightings_[n % CurveBvh::kRun];
      if (!there.whole || (there.flat_known && !flat_known)) continue;
      Chart chart = Chart::at(curve.nodes[n], scene_.frames.position[n]);
      if (!chart.advance_to(scene_.surface, curve.nodes[node_], scene_.frames.position[node_], r_)) continue;
      if (dot(chart.place, chart.place) > kBeside * kBeside * r_ * r_) continue;
      for (const auto& [index, place] : there.points) {
        if (index != node_ && !is_own(index)) note(conj(chart.turn) * (place - chart.place));
      }
      known = std::max(known, there.least);
    }
  }
  return least_ <= kAsLarge * known;
}

void GeodesicBall::lead_rays(double to_crease, bool flat_known) {
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
bool GeodesicBall::is_flat(double radius) const {
  const SurfacePatches& patches = scene_.patches;
  if (holds_crease(radius)) return false;
  if (patches.to_bend(scene_.obstacles.patch(node_)) > 2 * radius) return true;
  Chart centre = here();
  centre.advance(scene_.surface, radius * ahead_);
  return !centre.at_boundary && patches.to_bend(patches.patch_of(scene_.surface, centre.point)) > radius;
}

/// `flat_known`  what lies in about the plane of the node is known already
void GeodesicBall::look_around(const Chart& chart, bool flat_known) {
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
    constexpr double kFar = 2 * kAsLarge;
    if (index == node_ || (position - x).squaredNorm() >= kFar * kFar * least_ * least_) return;
    if (known_already(index)) return;
    const uint32_t there = scene_.obstacles.patch(index);
    if (there == patch || std::ranges::find(beside, there) != beside.end()) look_at(chart, index, position);
  }, part());
}

void GeodesicBall::look_at(const Chart& chart, uint32_t index, const Vec3& position) {
  const Surface& s = scene_.surface;
  const SurfacePoint& p = scene_.obstacles.point(index);
  if (p.face == chart.point.face) {
    come_across(index, chart.place + chart.turn * (flat(s, p) - flat(s, chart.point)));
  } else if (s.face_normal(p.face).dot(s.face_normal(chart.point.face)) >= kNearlyFlat) {
    come_across(index, chart.place + chart.turn * s.to_plane(chart.point.face, position - chart.position));
  } else if (Chart there = chart; there.advance_to(s, p, position, r_)) {
    come_across(index, there.place);
  }
}

/// Whether an earlier look has come across a point: looks overlap, and see it in the same place.
bool GeodesicBall::known_already(uint32_t index) const {
  return std::ranges::find(sightings_[node_ % CurveBvh::kRun].points, index, &Sighting::Point::index) !=
         sightings_[node_ % CurveBvh::kRun].points.end();
}

void GeodesicBall::come_across(uint32_t index, Vec2 place) {
  if (!is_own(index)) note(place);
  sightings_[node_ % CurveBvh::kRun].points.push_back({index, place});
}

}  // namespace meander
