// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/retraction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/close_growth.h"
#include "base/stopwatch.h"
#include "curve/constants.h"
#include "geodesic/geodesic_trace.h"

namespace meander {
namespace {

/// Segments that a thread joins at a time.
constexpr size_t kJoinedPerBlock = CrossingTest::kSegmentsPerBlock;

/// And of those that have to be joined again, which are few.
constexpr size_t kRejoinedPerBlock = 32;

/// All numbers below a count, as a list.
struct All {
  size_t count;
  size_t size() const { return count; }
  uint32_t operator[](size_t k) const { return static_cast<uint32_t>(k); }
};

}  // namespace

const NodeData<double>& Retraction::move(const Surface& surface, const Curve& curve,
                                         const NodeData<Vec2>& displacement, Curve& next, ThreadPool& pool,
                                         MoveSeconds& seconds) {
  const uint32_t n = curve.size();
  resize_closely(share_, n);
  pool.for_each(n, kNodeGrain, [&](uint32_t i) { share_[i] = curve.fixed[i] ? 0 : 1; });
  resolve(surface, curve, displacement, next, pool, seconds);
  return moved_;
}

void Retraction::hand_on() noexcept {
  meander::hand_on(share_, moved_, node_changed_);
  test_->hand_on();
}

void Retraction::straighten(const Surface& surface, Curve& curve, Curve& spare, ThreadPool& pool,
                            MoveSeconds& seconds) {
  // None of the nodes moves, and a share of 0 means that a path is kept: guides stay as drawn.
  share_.assign(curve.size(), 1);
  for (uint32_t i = 0; i < curve.size(); ++i) {
    if (curve.on_guide(i)) share_[i] = 0;
  }
  resolve(surface, curve, NodeData<Vec2>(curve.size()), spare, pool, seconds);
  std::swap(curve, spare);
}

/// Moves the nodes by their shares, which fall until nothing crosses.
void Retraction::resolve(const Surface& surface, const Curve& curve, const NodeData<Vec2>& displacement, Curve& next,
                         ThreadPool& pool, MoveSeconds& seconds) {
  Stopwatch watch;
  const uint32_t n = curve.size();
  next.lay_out_as(curve);
  resize_closely(traces_, n);
  moved_.resize(n);
  trace(surface, curve, displacement, All{n}, kJoinedPerBlock, next, pool);
  seconds.retract += watch.lap();
  test_->begin(next);
  const auto collect = [&](size_t block, size_t, size_t) { test_->collect(next, block); };
  reconnect(surface, curve, displacement, All{n}, kJoinedPerBlock, collect, next, pool);
  seconds.reconnect += watch.lap();
  auto pairs = test_->find_collected(surface, next, pool);
  seconds.crossings += watch.lap();
  for (int attempt = 1; !pairs.empty(); ++attempt) {
    back_off(curve, pairs, attempt);
    list_changed(curve);
    trace(surface, curve, displacement, changed_nodes_, kRejoinedPerBlock, next, pool);
    seconds.retract += watch.lap();
    test_->begin_some(ThreadPool::block_count(changed_segments_.size(), kRejoinedPerBlock));
    const auto collect_some = [&](size_t block, size_t begin, size_t end) {
      test_->collect_some(next, block, std::span(changed_segments_).subspan(begin, end - begin));
    };
    reconnect(surface, curve, displacement, changed_segments_, kRejoinedPerBlock, collect_some, next, pool);
    seconds.reconnect += watch.lap();
    pairs = test_->find_again(surface, next, pool);
    seconds.crossings += watch.lap();
  }
}

/// Lists the nodes that are marked, and the segments that end in one.
void Retraction::list_changed(const Curve& curve) {
  changed_nodes_.clear();
  changed_segments_.clear();
  for (uint32_t i = 0; i < curve.size(); ++i) {
    const uint32_t j = curve.next(i);
    if (node_changed_[i]) changed_nodes_.push_back(i);
    if (node_changed_[i] || (j != kNone && node_changed_[j])) changed_segments_.push_back(i);
  }
}

/// Leads some nodes.
template <class Nodes>
void Retraction::trace(const Surface& surface, const Curve& curve, const NodeData<Vec2>& displacement,
                       const Nodes& nodes, size_t grain, Curve& next, ThreadPool& pool) {
  pool.for_blocks(nodes.size(), grain, [&](size_t, size_t begin, size_t end) {
    std::vector<GeodesicWalk> walks;
    std::array<uint32_t, kTogether> node;  // of every walk
    walks.reserve(kTogether);
    for (size_t at = begin; at < end;) {
      walks.clear();
      for (; at < end && walks.size() < kTogether; ++at) {
        if (at + kTogether < end) surface.fetch_face(curve.nodes[nodes[at + kTogether]].face);
        const uint32_t i = nodes[at];
        traces_[i].clear();
        next.nodes[i] = curve.nodes[i];
        moved_[i] = 0;
        if (share_[i] == 0) continue;
        node[walks.size()] = i;
        walks.emplace_back(surface, curve.nodes[i], share_[i] * displacement[i]);
      }
      lead_together(walks, [&](size_t k) { traces_[node[k]].push_back(walks[k].crossing()); });
      for (size_t k = 0; k < walks.size(); ++k) {
        next.nodes[node[k]] = walks[k].end();
        moved_[node[k]] = walks[k].length();
      }
    }
  });
}

/// Joins moved nodes again by some segments, of which collect(block, begin, end) takes those of one block. Where nodes
/// have walked over many faces the new segment is first guessed: a straight walk costs the faces that it crosses, while
/// a path that follows its ends is led over all the vertices that they have passed by. A guess might come to the same
/// place by another path around a handle or a hole, so the surface must have none.
template <class Segments, class Collect>
void Retraction::reconnect(const Surface& surface, const Curve& old, const NodeData<Vec2>& displacement,
                           const Segments& segments, size_t grain, const Collect& collect, Curve& next,
                           ThreadPool& pool) {
  const bool may_guess = surface.simply_connected();
  pool.for_blocks(segments.size(), grain, [&](size_t block, size_t begin, size_t end) {
    PathShortener shortener(surface);
    std::vector<uint32_t> far;  // segments to be guessed; the others are joined at once
    for (size_t at = begin; at < end; ++at) {
      if (at + 2 * kFetchedAhead < end) {
        const uint32_t ahead = segments[at + 2 * kFetchedAhead];
        fetch(old.paths[ahead]);
        fetch(traces_[ahead]);
        fetch(next.paths[ahead]);
      }
      if (at + kFetchedAhead < end) {
        const uint32_t ahead = segments[at + kFetchedAhead];
        for (const Crossing& c : old.paths[ahead]) surface.fetch_hinges(face_of(c.twin));
        for (const Crossing& c : traces_[ahead]) surface.fetch_hinges(face_of(c.twin));
      }
      const uint32_t i = segments[at], j = old.next(i);
      if (j != kNone && may_guess && traces_[i].size() + traces_[j].size() >= kFacesWorthGuess) {
        far.push_back(i);
        continue;
      }
      if (j == kNone || (share_[i] == 0 && share_[j] == 0)) {
        next.paths[i] = old.paths[i];
        next.shapes[i] = old.shapes[i];
      } else {
        next.shapes[i] =
            shortener.follow(next.nodes[i], next.nodes[j], old.paths[i], traces_[i], traces_[j], next.paths[i]);
      }
    }
    guess(surface, old, displacement, far, shortener, next);
    collect(block, begin, end);
  });
}

/// Joins the nodes of some segments again by walks that are led in turns.
void Retraction::guess(const Surface& surface, const Curve& old, const NodeData<Vec2>& displacement,
                       std::span<const uint32_t> segments, PathShortener& shortener, Curve& next) {
  std::vector<GeodesicWalk> walks;
  walks.reserve(kTogether);
  std::array<Vec2, kTogether> displacements;  // of every walk
  while (!segments.empty()) {
    const auto together = segments.first(std::min<size_t>(kTogether, segments.size()));
    segments = segments.subspan(together.size());
    walks.clear();
    for (const uint32_t i : together) surface.fetch_face(next.nodes[i].face);
    for (const uint32_t i : together) {
      next.paths[i].clear();
      displacements[walks.size()] = chord(surface, old, displacement, i);
      walks.emplace_back(surface, next.nodes[i], displacements[walks.size()]);
    }
    lead_together(walks, [&](size_t k) { next.paths[together[k]].push_back(walks[k].crossing()); });
    for (size_t k = 0; k < together.size(); ++k) {
      const uint32_t i = together[k], j = old.next(i);
      const SurfacePoint &start = next.nodes[i], &goal = next.nodes[j];
      Path& path = next.paths[i];
      std::optional<PathShape> shape = aim(surface, start, goal, displacements[k], walks[k], path, shortener);
      if (!shape) shape = shortener.follow(start, goal, old.paths[i], traces_[i], traces_[j], path);
      next.shapes[i] = *shape;
    }
  }
}

/// Makes a shortest path to `goal` of a walk by `displacement` from `start`, and of its `path`; where the
/// surface bends in between, so that the walk ends elsewhere, it is aimed again by what it has missed. Nothing, and
/// `path` is anything then, if that leads nowhere.
std::optional<PathShape> Retraction::aim(const Surface& surface, const SurfacePoint& start, const SurfacePoint& goal,
                                         Vec2 displacement, const GeodesicWalk& first, Path& path,
                                         PathShortener& shortener) {
  std::optional<GeodesicWalk> again;
  Vec2 aimed = displacement;
  for (int shot = 1;; ++shot) {
    const GeodesicWalk& walk = again ? *again : first;
    const SurfacePoint end = walk.end();
    const double length = walk.length();
    const Vec3 missed = position(surface, goal) - position(surface, end);
    if (missed.norm() <= kAstray * length) {
      const std::optional<PathShape> shape = shortener.adopt(start, goal, path);
      if (shape) return std::abs(shape->length - length) <= kAstray * length ? shape : std::nullopt;
    }
    if (shot == kMostGuesses) return std::nullopt;
    aimed = aimed + surface.to_plane(end.face, missed) * conj(walk.direction()) * unit(aimed);
    if (!(norm(aimed - displacement) <= norm(displacement))) return std::nullopt;
    again.emplace(surface, start, aimed);
    path.clear();
    while (again->step()) path.push_back(again->crossing());
  }
}

/// The straight line from a moved node to the next one, in the plane of its new face, as it is where the surface is
/// flat between the old segment and the new one.
Vec2 Retraction::chord(const Surface& surface, const Curve& old, const NodeData<Vec2>& displacement,
                       uint32_t i) const {
  const uint32_t j = old.next(i);
  const PathShape& shape = old.shapes[i];
  const Vec2 step_here = share_[i] * displacement[i];
  const Vec2 step_there = share_[j] * displacement[j] * conj(shape.arriving) * shape.leaving;
  UnfoldedStrip trace(surface, old.nodes[i].face);
  for (const Crossing& c : traces_[i]) trace.cross(c);
  return trace.carried(shape.length * shape.leaving + step_there - step_here);
}

/// Marks the nodes of a strand up to `reach` beyond a marked one, in both directions, and in a closed strand across the
/// place where it is joined.
void Retraction::spread(const Strand& strand, uint32_t reach) {
  if (reach == 0) return;
  marked_.clear();
  for (uint32_t k = 0; k < strand.count; ++k) {
    if (node_changed_[strand.first + k]) marked_.push_back(k);
  }
  // Between one marked node and the next, from both of them.
  for (size_t m = 0; m < marked_.size(); ++m) {
    const bool last = m + 1 == marked_.size();
    if (last && !strand.closed) break;
    const uint32_t from = marked_[m], to = last ? marked_[0] + strand.count : marked_[m + 1];
    const auto mark = [&](uint32_t k) { node_changed_[strand.first + k % strand.count] = 1; };
    const uint32_t steps = std::min(reach, to - from - 1);
    for (uint32_t k = 1; k <= steps; ++k) {
      mark(from + k);
      mark(to - k);
    }
  }
  if (marked_.empty() || strand.closed) return;
  const uint32_t front = marked_.front(), back = marked_.back();
  const auto at = [&](uint32_t k) { return node_changed_.begin() + strand.first + k; };
  std::fill(at(front - std::min(reach, front)), at(front), uint8_t{1});
  std::fill(at(back), at(back + std::min(reach, strand.count - 1 - back) + 1), uint8_t{1});
}

void Retraction::back_off(const Curve& curve, const std::vector<std::pair<uint32_t, uint32_t>>& pairs,
                          int attempt) {
  // The stretch that gives way doubles with every attempt once single nodes have not helped.
  const uint32_t reach = attempt <= 2 ? 0 : (attempt >= 32 ? UINT32_MAX : 1u << std::min(attempt - 2, 30));
  node_changed_.assign(curve.size(), 0);
  for (const auto& [a, b] : pairs) {
    for (const uint32_t segment : {a, b}) node_changed_[segment] = node_changed_[curve.next(segment)] = 1;
  }
  for (const Strand& strand : curve.strands) spread(strand, reach);
  for (uint32_t i = 0; i < curve.size(); ++i) {
    if (node_changed_[i]) share_[i] = attempt > kMostStepHalvings ? 0 : 0.5 * share_[i];
  }
}

}  // namespace meander
