// SPDX-License-Identifier: GPL-3.0-or-later
//
// What limits a ball that grows from a point, among the points of a run, and which of them count.
#pragma once

#include "medial/constants.h"
#include "medial/curve_bvh.h"

namespace meander {

/// Where a ball begins: it passes through x, and its centre lies in direction b (unit) from there. A point p ahead
/// limits it to |p - x|^2 / (2 (p - x) . b).
struct BallStart {
  const Eigen::Vector3d &x, &b;
};

/// The radius of a ball, and the index of the point that limits it to that.
struct BallLimit {
  double radius;
  uint32_t touched = UINT32_MAX;  ///< if none does
};

/// All points count. Of several that limit a ball alike any is found.
struct CountAll {};

/// All points count. Of several that limit a ball alike the first is found.
struct CountAllInOrder {};

/// Some points count: a run is asked for only when a ball reaches into it, and a point when it would limit the ball. Of
/// several that limit a ball alike the first is found.
///
/// `blind(key)`  whether it is known already that nothing of a run counts; the key is what its run is called by whom it
///               is asked among, a tree or a few candidates
/// `lanes(key)`  a bit for each point of the run that counts
/// `counts(i)`   whether point i does, which takes more time
template <class Blind, class Lanes, class Counts>
struct CountSome {
  Blind blind;
  Lanes lanes;
  Counts counts;
};
template <class Blind, class Lanes, class Counts>
CountSome(Blind, Lanes, Counts) -> CountSome<Blind, Lanes, Counts>;

/// The points i of which counts(i) is true.
template <class Counts>
auto count_where(const Counts& counts) {
  return CountSome{[](uint32_t) { return false; }, [](uint32_t) { return ~0u; }, counts};
}

/// The points whose bits a run gives when it is asked for.
template <class Lanes>
auto count_lanes(const Lanes& lanes) {
  return CountSome{[](uint32_t) { return false; }, lanes, [](uint32_t) { return true; }};
}

/// What two points of a run, from `k` on, say of a ball: the squares of their distances, and how far ahead they are.
inline void measure_pair(const CurveBvh::Points& p, size_t k, const BallStart& start, Double2& squared,
                         Double2& ahead) {
  const Double2 ux = load<Double2>(p.x + k) - both(start.x.x()), uy = load<Double2>(p.y + k) - both(start.x.y()),
                uz = load<Double2>(p.z + k) - both(start.x.z());
  squared = ux * ux + uy * uy + uz * uz;
  ahead = ux * both(start.b.x()) + uy * both(start.b.y()) + uz * both(start.b.z());
}

/// The points of a run inside of a ball, or as good as on it: a bit each. What is not ahead fails as well: its product
/// is not above a square.
inline uint32_t lanes_inside(const CurveBvh& tree, uint32_t run, const BallStart& start, double radius) {
  const Double2 twice = both(2 * radius * kAlikeRounded);
  Long2 lanes{0, 0}, bits{1, 2};
#pragma GCC unroll 4
  for (size_t k = 0; k < CurveBvh::kRun; k += 2, bits <<= 2) {
    Double2 squared, ahead;
    measure_pair(tree.lanes(run), k, start, squared, ahead);
    lanes |= (squared < twice * ahead) & bits;
  }
  return static_cast<uint32_t>(lanes[0] | lanes[1]);
}

/// Whether a ball that point i would limit is smaller, or as large and i comes first: then it is the limit.
inline bool take(BallLimit& limit, double radius, size_t i) {
  if (!(radius < limit.radius || (radius == limit.radius && limit.touched != UINT32_MAX && i < limit.touched))) {
    return false;
  }
  limit = {radius, static_cast<uint32_t>(i)};
  return true;
}

/// Shrinks a ball until no point of a run that counts is in it; true if it had to.
inline bool shrink(const CurveBvh& tree, uint32_t run, uint32_t, const BallStart& start, BallLimit& limit,
                   const CountAll&) {
  bool smaller = false;
  for (uint32_t k = 0; k < CurveBvh::kRun; k += 2) {
    Double2 squared, ahead;
    measure_pair(tree.lanes(run), k, start, squared, ahead);
    const auto inside = squared < both(2 * limit.radius) * ahead;
    if (!(inside[0] | inside[1])) continue;
    for (uint32_t lane = 0; lane < 2; ++lane) {
      if (!(squared[lane] < 2 * limit.radius * ahead[lane])) continue;
      const size_t last = tree.points().size() - 1;
      const size_t i = std::min<size_t>(run * CurveBvh::kRun + k + lane, last);
      limit = {squared[lane] / (2 * ahead[lane]), static_cast<uint32_t>(i)};
      smaller = true;
    }
  }
  return smaller;
}

inline bool shrink(const CurveBvh& tree, uint32_t run, uint32_t, const BallStart& start, BallLimit& limit,
                   const CountAllInOrder&) {
  bool smaller = false;
  for (uint32_t lanes = lanes_inside(tree, run, start, limit.radius); lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<uint32_t>(std::countr_zero(lanes));
    const size_t i = size_t{run} * CurveBvh::kRun + lane;
    if (i >= tree.points().size()) break;
    Double2 squared, ahead;
    measure_pair(tree.lanes(run), lane & ~1u, start, squared, ahead);
    if (take(limit, squared[lane & 1] / (2 * ahead[lane & 1]), i)) smaller = true;
  }
  return smaller;
}

template <class Blind, class Lanes, class Counts>
bool shrink(const CurveBvh& tree, uint32_t run, uint32_t key, const BallStart& start, BallLimit& limit,
            const CountSome<Blind, Lanes, Counts>& count) {
  if (count.blind(key)) return false;
  uint32_t lanes = lanes_inside(tree, run, start, limit.radius);
  if (lanes != 0) lanes &= count.lanes(key);
  bool smaller = false;
  for (; lanes != 0; lanes &= lanes - 1) {
    const size_t i = size_t{run} * CurveBvh::kRun + static_cast<size_t>(std::countr_zero(lanes));
    if (i >= tree.points().size()) break;
    const Eigen::Vector3d d = tree.points()[i] - start.x;
    BallLimit next = limit;
    if (!take(next, d.squaredNorm() / (2 * d.dot(start.b)), i) || !count.counts(static_cast<uint32_t>(i))) continue;
    limit = next;
    smaller = true;
  }
  return smaller;
}

}  // namespace meander
