// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/measured_ball.h"

#include "medial/constants.h"
#include "medial/empty_balls.h"

namespace meander {
namespace {

/// Nodes, and samples of the boundary, that have been measured.
class Measured {
 public:
  explicit Measured(const Curve& curve) : curve_(curve) {}

  /// Takes in a point and its neighbours on the strand. Samples of the boundary have neighbours by their numbers only.
  void take_in(uint32_t p) {
    constexpr uint32_t kMost = kMeasuredNeighbours;
    const uint32_t nodes = curve_.size();
    if (p >= nodes) return add(std::max(nodes, p - kMost), p + kMost);
    const auto after = std::ranges::upper_bound(curve_.strands, p, {}, &Strand::first);
    const Strand& strand = *(after - 1);
    const uint32_t last = strand.end() - 1;
    const uint32_t back = std::min(kMost, p - strand.first), ahead = std::min(kMost, last - p);
    add(p - back, p + ahead);
    if (!strand.closed) return;
    // Those beyond its first node are its last ones, and those beyond its last node the first.
    if (back < kMost) add(last - std::min(kMost - back - 1, strand.count - 1), last);
    if (ahead < kMost) add(strand.first, strand.first + std::min(kMost - ahead, strand.count) - 1);
  }
  bool has(uint32_t j) const {
    for (uint32_t k = 0; k < count_; ++k) {
      if (j >= ranges_[k][0] && j <= ranges_[k][1]) return true;
    }
    return false;
  }

 private:
  void add(uint32_t first, uint32_t last) { ranges_[count_++] = {first, last}; }

  const Curve& curve_;
  uint32_t count_ = 0;
  std::array<std::array<uint32_t, 2>, 3 * kMostStrandsOfBall> ranges_;  // first and last
};

/// What the neighbours of a node on its strand leave of a ball, seen from where the node is seen.
double limited_by_neighbours(const SoughtBall& ball, const StrandNeighbours& own, uint32_t p, const Chart& seen,
                             double radius) {
  const Curve& curve = ball.scene.curve;
  const Surface& s = ball.scene.surface;
  if (p >= curve.size()) return radius;
  for (const bool forward : {false, true}) {
    Chart chart = seen;
    uint32_t q = p;
    for (uint32_t k = 0; k < kMeasuredNeighbours; ++k) {
      q = forward ? curve.next(q) : curve.previous(q);
      if (q == kNone || q == ball.node) break;
      if (own.has(q)) continue;
      const double before = radius;
      const SurfacePoint& at = curve.nodes[q];
      const Vec3& position = ball.scene.frames.position[q];
      if (s.face_normal(at.face).dot(s.face_normal(chart.point.face)) >= kNearlyFlat) {
        radius = ball.limited(radius,
                              chart.place + chart.turn * s.to_plane(chart.point.face, position - chart.position));
      } else if (chart.advance_to(s, at, position, ball.r)) {
        radius = ball.limited(radius, chart.place);
      } else {
        break;
      }
      if (!(radius < before)) break;
    }
  }
  return radius;
}

}  // namespace

MeasuredRadius measured_ball(const SoughtBall& ball, const StrandNeighbours& own) {
  const GeodesicScene& scene = ball.scene;
  double radius = own.radius;
  BallLimit straight = ball.straight;
  Measured measured(scene.curve);
  for (uint32_t k = 0; k < kMostStrandsOfBall; ++k) {
    Chart chart = ball.here();
    const uint32_t p = straight.touched;
    const Vec3& goal = scene.obstacles.positions()[p];
    if (!chart.advance_to(scene.surface, scene.obstacles.point(p), goal, kLongestLine * ball.r)) return {radius, false};
    radius = limited_by_neighbours(ball, own, p, chart, ball.limited(radius, chart.place));
    if (radius <= kSameBall * straight.radius || k + 1 == kMostStrandsOfBall) break;
    measured.take_in(p);
    const auto counts = [&](uint32_t j) { return !measured.has(j) && scene.sees(ball.node, j); };
    straight = largest_ball(scene.tree, ball.start(), std::min(ball.most, kNextBall * radius), count_where(counts),
                            ball.part());
    if (straight.touched == kNone) break;
    if (ball.alike(straight.touched)) return {std::min(radius, straight.radius), true};
  }
  return {radius, true};
}

}  // namespace meander
