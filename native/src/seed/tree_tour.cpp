// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/tree_tour.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "base/elementary.h"
#include "curve/crossings.h"
#include "geodesic/geodesic_trace.h"

namespace meander {
namespace {

constexpr double kPi = std::numbers::pi;

/// A sector wider than this has three nodes, so that the curve goes round a tip; one narrower than that is a corner of
/// two edges, in whose bisector the node may lie so many offsets away.
constexpr double kTip = 1.4 * kPi, kCorner = 0.75 * kPi, kMostReach = 2;

/// Beside such a corner nodes are left out as far as this along the edges, in offsets.
constexpr double kLeftOut = 2;

/// So often distances are halved.
constexpr int kHalvings = 24;

/// Segments joined between two asks.
constexpr uint32_t kPieces = 1024;

/// Half-edge 2 e runs along edge e of a network, 2 e + 1 the other way.
using Way = uint32_t;

/// The edges around the nodes of a network.
class Ways {
 public:
  explicit Ways(const LineNetwork& network) : network_(network), first_(network.nodes().size() + 1, 0) {
    const auto count = static_cast<uint32_t>(2 * network.edges().size());
    for (Way w = 0; w < count; ++w) ++first_[from(w) + 1];
    for (size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
    around_.resize(count);
    std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
    for (Way w = 0; w < count; ++w) around_[next[from(w)]++] = w;
    for (size_t v = 0; v + 1 < first_.size(); ++v) {
      std::sort(around_.begin() + first_[v], around_.begin() + first_[v + 1],
                [&](Way a, Way b) { return std::pair(angle(leaving(a)), a) < std::pair(angle(leaving(b)), b); });
    }
    place_.resize(count);
    for (size_t v = 0; v + 1 < first_.size(); ++v) {
      for (uint32_t k = first_[v]; k < first_[v + 1]; ++k) place_[around_[k]] = k;
    }
  }

  static Way twin(Way w) { return w ^ 1u; }
  const LineNetwork::Edge& edge(Way w) const { return network_.edges()[w / 2]; }
  uint32_t from(Way w) const { return w % 2 == 0 ? edge(w).from : edge(w).to; }
  uint32_t to(Way w) const { return from(twin(w)); }
  double length(Way w) const { return edge(w).shape.length; }
  /// Unit, in the plane of the node that it leaves.
  Vec2 leaving(Way w) const { return w % 2 == 0 ? edge(w).shape.leaving : -edge(w).shape.arriving; }
  bool any_at(uint32_t node) const { return first_[node] < first_[node + 1]; }
  Way first_at(uint32_t node) const { return around_[first_[node]]; }

  /// The way on along the left side of the tree: the first one clockwise from where `w` came from.
  Way next(Way w) const {
    const uint32_t v = to(w), k = place_[twin(w)];
    return around_[k == first_[v] ? first_[v + 1] - 1 : k - 1];
  }

  /// Appends the crossings of a way.
  void append_to(Path& path, Way w) const {
    const Path& own = edge(w).path;
    if (w % 2 == 0) {
      path.insert(path.end(), own.begin(), own.end());
    } else {
      std::transform(own.rbegin(), own.rend(), std::back_inserter(path), reversed);
    }
  }

 private:
  static double angle(Vec2 v) { return elementary::atan2(v.y, v.x); }

  const LineNetwork& network_;
  std::vector<uint32_t> first_;  // per node, in around_
  std::vector<Way> around_;      // counterclockwise
  std::vector<uint32_t> place_;  // of every way in around_
};

/// A node of a curve, and where it comes in the walk.
struct Stop {
  uint32_t node;      ///< of the network, that it is placed from,
  Vec2 direction;     ///< in this direction, unit,
  double reach;       ///< at this distance
  size_t after;       ///< so many ways of the walk have come before it
  SurfacePoint point; ///< where it is
  Path trace;         ///< from the node to there
};

/// One closed walk round a tree.
struct Walk {
  uint32_t root;
  std::vector<Way> ways;
  std::vector<Stop> stops;
};

/// What lies between the way that comes into a node and the one that leaves it, on the left of the walk.
struct Sector {
  Vec2 leaving;
  double angle;  ///< counterclockwise from there to where the walk comes from

  static Sector between(const Ways& ways, Way in, Way out) {
    const Vec2 back = ways.leaving(Ways::twin(in)), ahead = ways.leaving(out);
    double angle = elementary::atan2(cross(ahead, back), dot(ahead, back));
    if (angle <= 0 || out == Ways::twin(in)) angle += 2 * kPi;
    return {ahead, std::min(angle, 2 * kPi)};
  }
  bool is_tip() const { return angle > kTip; }
  bool is_corner() const { return angle < kCorner; }
  Vec2 at(double share) const {
    const double a = share * angle;
    return unit(leaving * Vec2{elementary::cos(a), elementary::sin(a)});
  }
};

/// Walks round the tree of a node.
Walk walk_from(const LineNetwork& network, const Ways& ways, uint32_t root, double offset, CancelPoll& poll) {
  Walk walk{root, {}, {}};
  const Way first = ways.first_at(root);
  Way way = first;
  do {
    poll();
    walk.ways.push_back(way);
    way = ways.next(way);
  } while (way != first);
  const size_t count = walk.ways.size();
  std::vector<Sector> sectors;  // after each way
  for (size_t k = 0; k < count; ++k) sectors.push_back(Sector::between(ways, walk.ways[k], walk.ways[(k + 1) % count]));
  std::vector<uint8_t> left_out(count, 0);
  for (size_t k = 0; k < count; ++k) {
    if (!sectors[k].is_corner()) continue;
    const double far = kLeftOut * offset * network.nodes()[ways.to(walk.ways[k])].radius;
    const auto leave_out = [&](size_t step) {
      double length = 0;
      for (size_t at = k, n = 0; n < count; ++n) {
        length += ways.length(walk.ways[step == 1 ? (at + 1) % count : at]);
        at = (at + step) % count;
        if (length > far || sectors[at].is_corner() || sectors[at].is_tip()) break;
        left_out[at] = 1;
      }
    };
    leave_out(1);
    leave_out(count - 1);
  }
  for (size_t k = 0; k < count; ++k) {
    if (left_out[k]) continue;
    const uint32_t node = ways.to(walk.ways[k]);
    const Sector& sector = sectors[k];
    const double reach = offset * network.nodes()[node].radius;
    const auto stop = [&](double share, double factor) {
      walk.stops.push_back({node, sector.at(share), factor * reach, k + 1, {}, {}});
    };
    if (sector.is_tip()) {
      for (const double share : {0.75, 0.5, 0.25}) stop(share, 1);
    } else {
      stop(0.5, std::min(kMostReach, 1 / elementary::sin(std::min(0.5 * sector.angle, 0.5 * kPi))));
    }
  }
  return walk;
}

/// The curve of many walks, as it is laid nearer to their trees.
class Laying {
 public:
  Laying(const LineNetwork& network, const Ways& ways, std::vector<Walk> walks, ThreadPool& pool)
      : network_(network), ways_(ways), walks_(std::move(walks)), pool_(pool), shortener_(network.surface()),
        poll_(pool.poll(kPieces)) {
    for (uint32_t w = 0; w < walks_.size(); ++w) {
      const auto count = static_cast<uint32_t>(walks_[w].stops.size());
      curve_.strands.push_back({static_cast<uint32_t>(stop_of_.size()), count, true});
      for (Stop& stop : walks_[w].stops) {
        stop_of_.push_back(&stop);
        walk_of_.push_back(w);
      }
    }
    const size_t count = stop_of_.size();
    curve_.nodes.resize(count);
    curve_.fixed.assign(count, 0);
    curve_.paths.resize(count);
    curve_.shapes.resize(count);
    curve_.link();
  }

  Curve lay(std::vector<uint32_t>& walked) {
    std::vector<uint8_t> moved(curve_.size(), 1);
    std::vector<std::pair<uint32_t, uint32_t>> crossing;
    for (int k = 0; k <= kHalvings; ++k) {
      place(moved);
      const std::vector<uint8_t> changed = join(moved);
      crossing = test_.find(network_.surface(), curve_, pool_, &changed);
      if (crossing.empty()) break;
      moved.assign(curve_.size(), 0);
      for (const auto& [a, b] : crossing) {
        for (const uint32_t segment : {a, b}) moved[segment] = moved[curve_.next(segment)] = 1;
      }
      for (uint32_t i = 0; i < curve_.size(); ++i) {
        if (moved[i]) stop_of_[i]->reach /= 2;
      }
    }
    std::vector<uint8_t> touched(walks_.size(), 0);
    for (const auto& [a, b] : crossing) touched[walk_of_[a]] = touched[walk_of_[b]] = 1;
    return without(touched, walked);
  }

 private:
  void place(const std::vector<uint8_t>& moved) {
    for (uint32_t i = 0; i < curve_.size(); ++i) {
      if (!moved[i]) continue;
      poll_();
      Stop& stop = *stop_of_[i];
      stop.trace.clear();
      const SurfacePoint& from = network_.nodes()[stop.node].point;
      stop.point = trace_geodesic(network_.surface(), from, stop.reach * stop.direction, stop.trace).end;
      curve_.nodes[i] = stop.point;
    }
  }

  /// Joins the neighbours of what has moved; the segments that are others now.
  std::vector<uint8_t> join(const std::vector<uint8_t>& moved) {
    std::vector<uint8_t> changed(curve_.size(), 0);
    for (uint32_t i = 0; i < curve_.size(); ++i) {
      const uint32_t next = curve_.next(i);
      if (!moved[i] && !moved[next]) continue;
      poll_();
      changed[i] = 1;
      const Stop &a = *stop_of_[i], &b = *stop_of_[next];
      const std::vector<Way>& ways = walks_[walk_of_[i]].ways;
      Path& path = curve_.paths[i];
      path.clear();
      std::transform(a.trace.rbegin(), a.trace.rend(), std::back_inserter(path), reversed);
      const size_t count = ways.size();
      const size_t steps = (b.after + count - a.after) % count;
      for (size_t k = 0; k < steps; ++k) ways_.append_to(path, ways[(a.after + k) % count]);
      path.insert(path.end(), b.trace.begin(), b.trace.end());
      curve_.shapes[i] = shortener_.shorten(curve_.nodes[i], curve_.nodes[next], path);
    }
    return changed;
  }

  /// The curve without some of its strands.
  Curve without(const std::vector<uint8_t>& left_out, std::vector<uint32_t>& walked) {
    Curve kept;
    walked.clear();
    for (uint32_t w = 0; w < walks_.size(); ++w) {
      if (left_out[w]) continue;
      const Strand& strand = curve_.strands[w];
      kept.strands.push_back({kept.size(), strand.count, true});
      for (uint32_t i = strand.first; i < strand.end(); ++i) {
        kept.nodes.push_back(curve_.nodes[i]);
        kept.fixed.push_back(0);
        kept.paths.push_back(std::move(curve_.paths[i]));
        kept.shapes.push_back(curve_.shapes[i]);
      }
      walked.push_back(w);
    }
    kept.link();
    return kept;
  }

  const LineNetwork& network_;
  const Ways& ways_;
  std::vector<Walk> walks_;
  ThreadPool& pool_;
  PathShortener shortener_;
  CrossingTest test_;
  CancelPoll poll_;
  Curve curve_;
  std::vector<Stop*> stop_of_;     // per node of the curve
  std::vector<uint32_t> walk_of_;  // likewise
};

}  // namespace

Curve walk_round(const LineNetwork& network, std::span<const uint32_t> roots, double offset, ThreadPool& pool,
                 std::vector<uint32_t>& walked) {
  const Ways ways(network);
  CancelPoll poll = pool.poll(kPieces);
  std::vector<Walk> walks;
  for (const uint32_t root : roots) walks.push_back(walk_from(network, ways, root, offset, poll));
  return Laying(network, ways, std::move(walks), pool).lay(walked);
}

}  // namespace meander
