// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/gaps.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "base/elementary.h"
#include "base/point_tree.h"
#include "geodesic/geodesic_trace.h"
#include "outputs/constants.h"

namespace meander {
namespace {

/// Places that are compared, or looked at, between two asks whether to go on.
constexpr uint32_t kComparedPerPoll = 4096;
constexpr uint32_t kPlacesPerPoll = 256;

SurfacePoint trace_end(const Surface& surface, const SurfacePoint& start, Vec2 displacement) {
  GeodesicWalk walk(surface, start, displacement);
  while (walk.step()) {
  }
  return walk.end();
}

/// Next to where a half-edge begins.
SurfacePoint beside_corner(HalfEdge e) {
  std::array<double, 3> weights{kBesideCorner, kBesideCorner, kBesideCorner};
  weights[corner_of(e)] = 1 - 2 * kBesideCorner;
  return make_point(face_of(e), weights[0], weights[1], weights[2]);
}

/// Climbs to a local maximum of the size by a pattern search: the distance has creases where the
/// nearest strand changes, so it has no gradient just where the maxima are.
Gap climb(const Emptiness& emptiness, Gap gap) {
  const double finest = kFinestClimb * emptiness.local_radius(gap.centre);
  const double eighth = 2 * std::numbers::pi / kClimbDirections;
  const Vec2 turn{elementary::cos(eighth), elementary::sin(eighth)};
  // Other directions after every failure, so that neither a crease nor the boundary hides where the size grows.
  const Vec2 offset{elementary::cos(0.382 * eighth), elementary::sin(0.382 * eighth)};
  Vec2 direction{1, 0};
  double step = 0.25 * gap.radius;
  EmptinessNearby nearby(emptiness);
  for (int round = 0; round < kMostClimbSteps && step > finest; ++round) {
    Gap best = gap;
    const double gain = kLeastGain * step / emptiness.local_radius(gap.centre);
    for (int k = 0; k < kClimbDirections; ++k) {
      direction = direction * turn;
      if (nearby.surely_below(gap.centre, step * direction, best.size)) continue;
      const SurfacePoint end = trace_end(emptiness.surface(), gap.centre, step * direction);
      const std::optional<Gap> other = nearby.above(end, best.size);
      if (other && other->size > std::max(best.size, gap.size + gain)) best = *other;
    }
    if (best.size > gap.size) {
      gap = best;
      step = std::min(2 * step, gap.radius);
    } else {
      step *= 0.5;
      direction = unit(direction * offset);
    }
  }
  return gap;
}

/// The largest first, without those whose centre is within `share` radii of a larger one, and
/// with `along_surface` on a face that is turned to the same side.
std::vector<Gap> apart(const Surface& surface, const std::vector<Gap>& gaps, double share, bool along_surface,
                       CancelToken poll) {
  const auto face_each_other = [&](const Gap& a, const Gap& b) {
    return surface.face_normal(a.centre.face).dot(surface.face_normal(b.centre.face)) < 0;
  };
  std::vector<Vec3> centres;
  for (const Gap& gap : gaps) centres.push_back(position(surface, gap.centre));
  poll.now();
  const PointTree tree(std::move(centres), poll);
  std::vector<uint32_t> order(gaps.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    poll();
    return gaps[a].size != gaps[b].size ? gaps[a].size > gaps[b].size : a < b;
  });
  std::vector<uint8_t> taken(gaps.size(), 0);
  std::vector<uint32_t> near;
  std::vector<Gap> kept;
  for (const uint32_t i : order) {
    if (taken[i]) continue;
    kept.push_back(gaps[i]);
    const double reach = share * gaps[i].radius;
    tree.within(tree.points()[i], reach * reach, near);
    poll(1 + near.size());
    for (const uint32_t k : near) {
      if (!along_surface || k == i || !face_each_other(gaps[i], gaps[k])) taken[k] = 1;
    }
  }
  return kept;
}

/// How far a search is, for whoever watches; any thread tells.
class Told {
 public:
  explicit Told(WatchedPart part) : part_(part) { at(0); }
  void at(double share) const { part_.at(share); }
  /// The loops that follow go over `blocks` blocks, while the share that is done rises from one to the other.
  void begin(double from, double to, size_t blocks) {
    from_ = from;
    step_ = (to - from) / static_cast<double>(std::max<size_t>(1, blocks));
    done_ = 0;
  }
  void block() { at(from_ + step_ * static_cast<double>(++done_)); }

 private:
  WatchedPart part_;
  double from_ = 0, step_ = 0;
  std::atomic<size_t> done_ = 0;
};

/// What a block of starts has given.
struct Found {
  std::vector<Gap> starts;
  EmptyArea empty;
};

/// Looks at the centres of all balls, the middles of all faces and beside all corners of the boundary: starts whose
/// size is at least `promising`; and how much of the faces is empty.
Found look_everywhere(const Flow::Present& present, const Emptiness& emptiness, const EmptyStrip& strip,
                      double promising, Told& told) {
  const Domain& domain = present.state.domain;
  const Surface& surface = emptiness.surface();
  const Curve& curve = present.state.curve;
  const Frames& frames = present.medial.frames;
  const NodeData<Radii>& radii = present.medial.radii;
  ThreadPool& pool = present.pool;
  const double surely_small = (1 - kRoundedEnd) * promising * domain.judged_radius().least();
  const size_t balls = 2 * size_t{curve.size()};
  const size_t middles = balls + surface.face_count(), count = middles + surface.boundary().size();
  constexpr size_t kBlock = 512;
  std::vector<Found> blocks(ThreadPool::block_count(count, kBlock));
  told.begin(0, kProgressLooked, blocks.size());
  pool.for_blocks(count, kBlock, [&](size_t block, size_t begin, size_t end) {
    Found& found = blocks[block];
    EmptyFaces faces(emptiness, strip, pool.poll(kPlacesPerPoll));
    for (size_t k = begin; k < end; ++k) {
      SurfacePoint start;
      if (k < balls) {
        const size_t i = k / 2, side = k % 2;
        // The node that the ball touches is no farther than along the surface: most balls are too small.
        if (radii[i][side] < surely_small) continue;
        const double along = side == 0 ? radii[i][0] : -radii[i][1];
        start = trace_end(surface, curve.nodes[i], along * frames.bitangent2[i]);
      } else if (k < middles) {
        start = make_point(static_cast<uint32_t>(k - balls), 1.0 / 3, 1.0 / 3, 1.0 / 3);
      } else {
        start = beside_corner(surface.boundary()[k - middles]);
      }
      const bool close = emptiness.closer_than(start, promising);
      if (k >= balls && k < middles) faces.add(start.face, close ? promising : 0);
      if (close) continue;
      const Gap gap = emptiness.at(start);
      if (gap.size >= promising) found.starts.push_back(gap);
    }
    found.empty = faces.area();
    told.block();
  });
  Found all;
  for (const Found& found : blocks) {
    all.starts.insert(all.starts.end(), found.starts.begin(), found.starts.end());
    all.empty += found.empty;
  }
  return all;
}

/// On the surface that the flow runs on.
Gaps emptiest_places(const Flow::Present& present, double least_size, Told& told) {
  const Domain& domain = present.state.domain;
  const Surface& surface = *domain.surface;
  ThreadPool& pool = present.pool;
  const RadiusField judged = domain.judged_radius();
  const Emptiness emptiness(surface, present.state.curve, present.medial.frames.position.values(), judged,
                            domain.patches.get());
  const bool along_surface = domain.patches != nullptr;
  const EmptyStrip strip{*domain.boundary, present.state.settings.boundary_distance};
  const Found found = look_everywhere(present, emptiness, strip, kPromisingStart * least_size, told);

  std::vector<Gap> gaps = apart(surface, found.starts, kSameStart, along_surface, pool.poll(kComparedPerPoll));
  constexpr size_t kClimbs = 2;
  told.begin(kProgressLooked, kProgressClimbed, ThreadPool::block_count(gaps.size(), kClimbs));
  pool.for_blocks(gaps.size(), kClimbs, [&](size_t, size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) gaps[k] = climb(emptiness, gaps[k]);
    told.block();
  });
  gaps = apart(surface, gaps, 1, along_surface, pool.poll(kComparedPerPoll));
  std::erase_if(gaps, [&](const Gap& gap) {
    const double r = gap.radius / gap.size;
    return gap.radius - strip.wanted_at(position(surface, gap.centre), r) < least_size * r;
  });
  pool.for_blocks(gaps.size(), 2, [&](size_t, size_t begin, size_t end) {
    CancelToken poll = pool.poll(kPlacesPerPoll);
    for (size_t k = begin; k < end; ++k) gaps[k].narrow = is_narrow(emptiness, gaps[k].centre, poll);
  });
  const double area = surface.area();
  return {std::move(gaps), {found.empty.wide / area, found.empty.narrow / area}};
}

}  // namespace

Gaps find_gaps(Flow& flow, double least_size, const CancelToken& cancel, WatchedPart told) {
  told.at(0);
  return flow.ask([&](const Flow::Present& present) { return find_gaps(present, least_size, told); }, cancel);
}

Gaps find_gaps(const Flow::Present& present, double least_size, WatchedPart told) {
  Told search(told);
  Gaps found = emptiest_places(present, least_size, search);
  search.at(1);
  for (Gap& gap : found.gaps) gap.radius *= present.state.domain.stretch_at(gap.centre);
  return found;
}

}  // namespace meander
