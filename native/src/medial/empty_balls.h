// SPDX-License-Identifier: GPL-3.0-or-later
//
// The largest empty balls tangent at points of a curve, one by one and for neighbours together.
//
// Ma, Bae and Choi (2012) find it by repeated nearest-point queries, about 2.2 of them a side here even from a warm
// start. Tangent balls at a point are nested, so a tree that prunes with the ball itself, and shrinks it at every point
// it meets inside, needs one walk. Measured against nanoflann queries inside the flow, single-threaded: 1.32 times
// faster in whole runs of four models. One walk for eight neighbours at a time: another 2.7 times.
#pragma once

#include "medial/ball_limit.h"
#include "medial/ball_region.h"
#include "medial/run_candidates.h"

namespace meander {

/// The largest ball that begins somewhere and holds none of the points that count; its radius is at most `most`, and
/// exactly
///   min(most, min over points p ahead that count of |p - x|^2 / (2 (p - x) . b)):
/// the tree only skips points that cannot be the least.
///
/// `count`  one of medial/ball_limit.h
/// `part`   whose points are meant; of no account where there is one part
template <class Count>
BallLimit largest_ball(const CurveBvh& tree, const BallStart& start, double most, const Count& count,
                       uint32_t part = 0) {
  BallLimit limit{most};
  ShrinkingBall<false> region{start.x, start.b, limit.radius};
  tree.walk(part, region, [&](uint32_t run) { return shrink(tree, run, run, start, limit, count); });
  return limit;
}

/// The same among a few runs. `limiting` is a candidate to look at first, the one that limited the ball beside this
/// one, and receives the one that limits this; UINT32_MAX for none.
template <class Count>
BallLimit largest_ball(const CurveBvh& tree, const RunCandidates& near, const BallStart& start, double most,
                       const Count& count, uint32_t& limiting) {
  BallLimit limit{most};
  const uint32_t first = limiting;
  if (first != UINT32_MAX) shrink(tree, near.run[first], first, start, limit, count);
  RoundedBall ball(start.x, start.b, limit.radius);
  for (uint32_t at = 0; at < near.count; at += 4) {
    // Balls are nested: what misses a larger one misses this one.
    for (uint32_t met = lanes_of(ball.distances(near, at) < all(ball.squared)); met != 0; met &= met - 1) {
      const uint32_t candidate = at + static_cast<uint32_t>(std::countr_zero(met));
      if (candidate == first || !shrink(tree, near.run[candidate], candidate, start, limit, count)) continue;
      limiting = candidate;
      ball = RoundedBall(start.x, start.b, limit.radius);
    }
  }
  return limit;
}

/// Balls at some points of the tree, and where their results go.
struct BallsAtPoints {
  size_t first, last;                                  ///< of the points first .. last - 1
  std::span<const std::array<Eigen::Vector3d, 2>> b;   ///< per point, directions of its two balls
  std::span<std::array<double, 2>> radii;              ///< per point, in: most, 0 where none is sought; out: the radii
  /// If not empty, one entry for each of first .. last - 1: receives per side the index of a point that limits the
  /// ball, UINT32_MAX if none does; unchanged where none is sought.
  std::span<std::array<uint32_t, 2>> touched = {};
};

/// Everybody sees all points.
struct SeeAll {
  static uint32_t kind(size_t) { return 0; }
  static RunShare share(size_t, size_t, uint32_t) { return RunShare::kAll; }
  static CountAll among(const RunCandidates&, uint32_t, SeenLanes&) { return {}; }
  static CountAll alone(uint32_t) { return {}; }
};

/// Points of one kind see the same.
///
/// `kind(i)`                  of a point
/// `seen(kind, run)`          a bit for each point of a run: whether it counts for points of a kind
/// `share(first, last, run)`  how many points of a run count for the points first .. last - 1, kRun at most; what is
///                            known of all of them saves asking for each
template <class Kind, class Seen, class Share>
struct SeeByKind {
  Kind kind;
  Seen seen;
  Share share;

  auto among(const RunCandidates& near, uint32_t of, SeenLanes& lanes) const {
    lanes.begin(near);
    return CountSome{[&](uint32_t at) { return lanes.known_blind(at); },
                     [this, of, &near, &lanes](uint32_t at) {
                       return lanes.get(at, [&] { return seen(of, near.run[at]); });
                     },
                     [](uint32_t) { return true; }};
  }
  auto alone(uint32_t of) const {
    return count_lanes([this, of](uint32_t run) { return seen(of, run); });
  }
};

template <class Kind, class Seen, class Share>
SeeByKind(Kind, Seen, Share) -> SeeByKind<Kind, Seen, Share>;

/// largest_ball for points of the tree themselves, on both sides of each, in a third of the time: neighbours on the
/// curve find what limits them among the same few runs, which one walk finds for all of them.
///
/// `sight`  SeeAll, or a SeeByKind
template <class Sight>
void largest_balls(const CurveBvh& tree, const BallsAtPoints& balls, const Sight& sight) {
  RunCandidates near;
  SeenLanes lanes;
  for (size_t begin = balls.first; begin < balls.last; begin += CurveBvh::kRun) {
    const size_t end = std::min<size_t>(begin + CurveBvh::kRun, balls.last);
    const bool few = find_candidates(tree, begin, end, balls.b, balls.radii,
                                     [&](uint32_t run) { return sight.share(begin, end, run); }, near);
    for (size_t from = begin, to = begin; from < end; from = to) {
      const uint32_t kind = sight.kind(from);
      while (to < end && sight.kind(to) == kind) ++to;
      const auto among = sight.among(near, kind, lanes);
      for (size_t side = 0; side < 2; ++side) {
        uint32_t limiting = UINT32_MAX;
        for (size_t i = from; i < to; ++i) {
          double& radius = balls.radii[i][side];
          if (!(radius > 0)) continue;
          const BallStart start{tree.points()[i], balls.b[i][side]};
          const BallLimit limit = few ? largest_ball(tree, near, start, radius, among, limiting)
                                      : largest_ball(tree, start, radius, sight.alone(kind), tree.part(i));
          radius = limit.radius;
          if (!balls.touched.empty()) balls.touched[i - balls.first][side] = limit.touched;
        }
      }
    }
  }
}

}  // namespace meander
