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
/// two edges, in whose bisector the node lies kMostReach offsets away at most.
constexpr double kTip = 1.4 * kPi, kCorner = 0.75 * kPi, kMostReach = 2;

/// Beside such a corner nodes are left out as far as this along the edges, in offsets.
constexpr double kLeftOut = 2;

/// So often distances are halved.
constexpr int kHalvings = 24;

/// Segments joined between two asks.
constexpr uint32_t kTourPieces = 1024;

/// Half-edge 2 e runs along edge e of a network, 2 e + 1 the other way.
using Way = uint32_t;

/// On which side of a tree a curve walks: the sign of angles there.
using Side = double;
constexpr Side kLeft = 1, kRight = -1;

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

  /// The way on along the left side of the tree: the first one clockwise from where `w` came from; and along the right.
  Way next(Way w, Side side) const {
    const uint32_t v = to(w), k = place_[twin(w)];
    if (side == kLeft) return around_[k == first_[v] ? first_[v + 1] - 1 : k - 1];
    return around_[k + 1 == first_[v + 1] ? first_[v] : k + 1];
  }

  /// All ways from a node.
  std::span<const Way> from_node(uint32_t v) const {
    return std::span(around_).subspan(first_[v], first_[v + 1] - first_[v]);
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
  size_t after;       ///< the number of ways of the walk before it
  SurfacePoint point; ///< where it is
  Path trace;         ///< from the node to there
  uint8_t fixed = 0;
};

/// A walk round a tree, or along a trunk and round what leaves it.
struct Walk {
  bool closed = true;
  std::vector<Way> ways;
  std::vector<Stop> stops;
};

/// What lies between the way that comes into a node and the one that leaves it, on the side of the walk.
struct Sector {
  Vec2 leaving;
  double angle;  ///< from there to where the walk comes from, counterclockwise on the left
  Side side;

  static Sector between(const Ways& ways, Way in, Way out, Side side) {
    const Vec2 back = ways.leaving(Ways::twin(in)), ahead = ways.leaving(out);
    double angle = side * elementary::atan2(cross(ahead, back), dot(ahead, back));
    if (angle <= 0 || out == Ways::twin(in)) angle += 2 * kPi;
    return {ahead, std::min(angle, 2 * kPi), side};
  }
  bool is_tip() const { return angle > kTip; }
  bool is_corner() const { return angle < kCorner; }
  Vec2 at(double share) const {
    const double a = side * share * angle;
    return unit(leaving * Vec2{elementary::cos(a), elementary::sin(a)});
  }
};

/// Where a walk may turn: after each of its ways.
struct Corner {
  enum Kind { kRound, kOnTrunk, kFromTrunk, kToTrunk } kind;
  Side side;
  bool stays = false;  ///< on a trunk: whatever is near
  uint8_t fixed = 0;
};

/// Makes the stops of one walk after another.
class Stops {
 public:
  Stops(const LineNetwork& network, const Ways& ways, double offset, CancelToken poll)
      : network_(network), ways_(ways), offset_(offset), poll_(poll) {}

  Walk round_tree(uint32_t root) {
    begin(true);
    const Way first = ways_.first_at(root);
    Way way = first;
    do {
      add(way, {Corner::kRound, kLeft});
      way = ways_.next(way, kLeft);
    } while (way != first);
    return end();
  }

  Walk along_trunk(const Trunk& trunk) {
    begin(trunk.closed);
    const size_t count = trunk.nodes.size(), segments = trunk.closed ? count : count - 1;
    std::vector<Way> along;
    for (size_t k = 0; k < segments; ++k) along.push_back(way_between(trunk.nodes[k], trunk.nodes[(k + 1) % count]));
    if (!trunk.closed) walk_.stops.push_back(on_trunk(trunk.nodes[0], 0, trunk.fixed[0]));
    for (size_t step = 0; step < segments; ++step) {
      // A closed trunk begins with the segment that leads to its first node.
      const size_t k = trunk.closed ? (step + segments - 1) % segments : step;
      const uint32_t node = trunk.nodes[(k + 1) % count];
      const bool last = !trunk.closed && k + 1 == segments;
      const Way ahead = last ? kNone : along[(k + 1) % segments];
      const Way finger = last ? kNone : finger_at(node, along[k], ahead);
      if (finger == kNone) {
        const uint8_t fixed = trunk.fixed[(k + 1) % count];
        add(along[k], {Corner::kOnTrunk, kLeft, last || fixed, fixed});
        continue;
      }
      add(along[k], {Corner::kFromTrunk, kLeft});
      const Side side = cross(ways_.leaving(ahead) - ways_.leaving(Ways::twin(along[k])), ways_.leaving(finger)) > 0
                            ? kLeft
                            : kRight;
      for (Way way = finger;; way = ways_.next(way, side)) {
        const bool back = way == Ways::twin(finger);
        add(way, {back ? Corner::kToTrunk : Corner::kRound, side});
        if (back) break;
      }
    }
    return end();
  }

 private:
  void begin(bool closed) {
    walk_ = {};
    walk_.closed = closed;
    corners_.clear();
  }
  void add(Way way, const Corner& corner) {
    poll_();
    walk_.ways.push_back(way);
    corners_.push_back(corner);
  }
  Way way_between(uint32_t from, uint32_t to) const {
    for (const Way w : ways_.from_node(from)) {
      if (ways_.to(w) == to) return w;
    }
    return kNone;
  }
  Way finger_at(uint32_t node, Way in, Way out) const {
    for (const Way w : ways_.from_node(node)) {
      if (w != Ways::twin(in) && w != out) return w;
    }
    return kNone;
  }
  static Stop on_trunk(uint32_t node, size_t after, uint8_t fixed) { return {node, {1, 0}, 0, after, {}, {}, fixed}; }
  double reach(uint32_t node) const { return offset_ * network_.nodes()[node].radius; }
  Way after(size_t k) const { return walk_.ways[(k + 1) % walk_.ways.size()]; }
  Sector sector(size_t k) const { return Sector::between(ways_, walk_.ways[k], after(k), corners_[k].side); }

  /// Marks what is so near to a narrow corner, or to where a trunk is left, that its node would be in the way.
  std::vector<uint8_t> left_out() const {
    const size_t count = corners_.size();
    std::vector<uint8_t> left_out(count, 0);
    const auto is_plain = [&](size_t k) {
      if (corners_[k].kind == Corner::kOnTrunk) return !corners_[k].stays;
      if (corners_[k].kind != Corner::kRound) return false;
      const Sector s = sector(k);
      return !s.is_corner() && !s.is_tip();
    };
    for (size_t k = 0; k < count; ++k) {
      const bool narrow = corners_[k].kind == Corner::kFromTrunk || corners_[k].kind == Corner::kToTrunk ||
                          (corners_[k].kind == Corner::kRound && sector(k).is_corner());
      if (!narrow) continue;
      const double far = kLeftOut * reach(ways_.to(walk_.ways[k]));
      for (const size_t step : {size_t{1}, count - 1}) {
        double length = 0;
        for (size_t at = k, n = 0; n + 1 < count; ++n) {
          const size_t next = (at + step) % count;
          if (!walk_.closed && (step == 1 ? next < at : next > at)) break;
          length += ways_.length(walk_.ways[step == 1 ? next : at]);
          at = next;
          if (length > far || !is_plain(at)) break;
          left_out[at] = 1;
        }
      }
    }
    return left_out;
  }

  Walk end() {
    const std::vector<uint8_t> out = left_out();
    for (size_t k = 0; k < corners_.size(); ++k) {
      if (out[k]) continue;
      const uint32_t node = ways_.to(walk_.ways[k]);
      const auto stop = [&](Vec2 direction, double factor) {
        walk_.stops.push_back({node, direction, factor * reach(node), k + 1, {}, {}, 0});
      };
      switch (corners_[k].kind) {
        case Corner::kOnTrunk: walk_.stops.push_back(on_trunk(node, k + 1, corners_[k].fixed)); break;
        case Corner::kFromTrunk: stop(ways_.leaving(Ways::twin(walk_.ways[k])), 1); break;
        case Corner::kToTrunk: stop(ways_.leaving(after(k)), 1); break;
        case Corner::kRound: {
          const Sector s = sector(k);
          if (s.is_tip()) {
            for (const double share : {0.75, 0.5, 0.25}) stop(s.at(share), 1);
          } else {
            stop(s.at(0.5), std::min(kMostReach, 1 / elementary::sin(std::min(0.5 * s.angle, 0.5 * kPi))));
          }
        }
      }
    }
    return std::move(walk_);
  }

  const LineNetwork& network_;
  const Ways& ways_;
  double offset_;
  CancelToken poll_;
  Walk walk_;
  std::vector<Corner> corners_;  // after each way
};

/// The curve of many walks, as it is laid nearer to their trees.
class Laying {
 public:
  Laying(const LineNetwork& network, const Ways& ways, std::vector<Walk> walks, const Curve& kept, ThreadPool& pool)
      : network_(network), ways_(ways), walks_(std::move(walks)), pool_(pool), shortener_(network.surface()),
        poll_(pool.poll(kTourPieces)) {
    for (uint32_t w = 0; w < walks_.size(); ++w) {
      const auto count = static_cast<uint32_t>(walks_[w].stops.size());
      curve_.strands.push_back({static_cast<uint32_t>(stop_of_.size()), count, walks_[w].closed});
      for (Stop& stop : walks_[w].stops) {
        stop_of_.push_back(&stop);
        walk_of_.push_back(w);
      }
    }
    const size_t count = stop_of_.size();
    curve_.nodes.resize(count);
    for (const Stop* stop : stop_of_) curve_.fixed.push_back(stop->fixed);
    curve_.paths.resize(count);
    curve_.shapes.resize(count);
    for (const Strand& strand : kept.strands) {
      curve_.strands.push_back(strand);
      curve_.strands.back().first += static_cast<uint32_t>(count);
    }
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(curve_.nodes, kept.nodes);
    append(curve_.fixed, kept.fixed);
    append(curve_.paths, kept.paths);
    append(curve_.shapes, kept.shapes);
    curve_.link();
  }

  Curve lay(std::vector<uint32_t>& walked) {
    const auto count = static_cast<uint32_t>(stop_of_.size());
    std::vector<uint8_t> moved(curve_.size(), 0);
    std::fill_n(moved.begin(), count, uint8_t{1});
    std::vector<std::pair<uint32_t, uint32_t>> crossing;
    for (int k = 0; k <= kHalvings; ++k) {
      place(moved);
      const std::vector<uint8_t> changed = join(moved);
      crossing = test_.find(network_.surface(), curve_, pool_, &changed);
      if (crossing.empty()) break;
      moved.assign(curve_.size(), 0);
      for (const auto& [a, b] : crossing) {
        for (const uint32_t segment : {a, b}) {
          if (segment < count) moved[segment] = moved[curve_.next(segment)] = 1;
        }
      }
      for (uint32_t i = 0; i < count; ++i) {
        if (moved[i]) stop_of_[i]->reach /= 2;
      }
    }
    std::vector<uint8_t> touched(walks_.size(), 0);
    for (const auto& [a, b] : crossing) {
      for (const uint32_t segment : {a, b}) {
        if (segment < count) touched[walk_of_[segment]] = 1;
      }
    }
    return without(touched, walked);
  }

 private:
  void place(const std::vector<uint8_t>& moved) {
    for (uint32_t i = 0; i < stop_of_.size(); ++i) {
      if (!moved[i]) continue;
      poll_();
      Stop& stop = *stop_of_[i];
      stop.trace.clear();
      const SurfacePoint& from = network_.nodes()[stop.node].point;
      stop.point = from;
      if (stop.reach > 0) {
        stop.point = trace_geodesic(network_.surface(), from, stop.reach * stop.direction, stop.trace).end;
      }
      curve_.nodes[i] = stop.point;
    }
  }

  /// Joins the neighbours of what has moved; the segments that are others now.
  std::vector<uint8_t> join(const std::vector<uint8_t>& moved) {
    std::vector<uint8_t> changed(curve_.size(), 0);
    for (uint32_t i = 0; i < stop_of_.size(); ++i) {
      const uint32_t next = curve_.next(i);
      if (next == kNone || (!moved[i] && !moved[next])) continue;
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
      kept.strands.push_back({kept.size(), strand.count, strand.closed});
      for (uint32_t i = strand.first; i < strand.end(); ++i) {
        kept.nodes.push_back(curve_.nodes[i]);
        kept.fixed.push_back(curve_.fixed[i]);
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
  CancelToken poll_;
  Curve curve_;
  std::vector<Stop*> stop_of_;     // per node of the curve
  std::vector<uint32_t> walk_of_;  // likewise
};

}  // namespace

Curve walk_round(const LineNetwork& network, std::span<const Trunk> trunks, std::span<const uint32_t> roots,
                 double offset, const Curve& kept, ThreadPool& pool, std::vector<uint32_t>& walked) {
  const Ways ways(network);
  Stops stops(network, ways, offset, pool.poll(kTourPieces));
  std::vector<Walk> walks;
  for (const Trunk& trunk : trunks) walks.push_back(stops.along_trunk(trunk));
  for (const uint32_t root : roots) walks.push_back(stops.round_tree(root));
  return Laying(network, ways, std::move(walks), kept, pool).lay(walked);
}

}  // namespace meander
