// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/tree_walk.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "base/elementary.h"
#include "seed/constants.h"

namespace meander {
namespace {

double angle_of(Vec2 v) { return elementary::atan2(v.y, v.x); }

/// What lies between the way that comes into a node and the one that leaves it, on the side of the walk.
struct Sector {
  Vec2 leaving;
  double angle;  ///< from there to where the walk comes from, counterclockwise on the left
  Hand hand;

  static Sector between(const Ways& ways, Way in, Way out, Hand hand) {
    const Vec2 back = ways.leaving(Ways::twin(in)), ahead = ways.leaving(out);
    double angle = hand * elementary::atan2(cross(ahead, back), dot(ahead, back));
    if (angle <= 0 || out == Ways::twin(in)) angle += 2 * std::numbers::pi;
    return {ahead, std::min(angle, 2 * std::numbers::pi), hand};
  }
  bool is_tip() const { return angle > kSectorOfTip; }
  bool is_corner() const { return angle < kSectorOfCorner; }
  Vec2 at(double share) const {
    const double a = hand * share * angle;
    return unit(leaving * Vec2{elementary::cos(a), elementary::sin(a)});
  }
};

/// Makes the stops of a walk.
class StopMaker {
 public:
  StopMaker(const LineNetwork& network, const Ways& ways, double offset, const Walk& walk)
      : network_(network), ways_(ways), offset_(offset), walk_(walk) {}

  std::vector<Stop> make() const {
    std::vector<Stop> stops;
    if (!walk_.closed) {
      stops.push_back({ways_.from(walk_.ways[0]), {1, 0}, 0, 0, walk_.begins_fixed, 0});
    }
    const std::vector<uint8_t> out = left_out();
    for (size_t k = 0; k < walk_.corners.size(); ++k) {
      if (!out[k]) add(k, stops);
    }
    return stops;
  }

 private:
  double reach(size_t k) const {
    return walk_.corners[k].share * offset_ * network_.nodes()[ways_.to(walk_.ways[k])].radius;
  }
  Way after(size_t k) const { return walk_.ways[(k + 1) % walk_.ways.size()]; }
  Sector sector(size_t k) const {
    return Sector::between(ways_, walk_.ways[k], after(k), walk_.corners[k].hand);
  }
  bool is_plain(size_t k) const {
    if (walk_.corners[k].kind == WalkCorner::kOnTrunk) return !walk_.corners[k].stays;
    if (walk_.corners[k].kind != WalkCorner::kRound) return false;
    const Sector s = sector(k);
    return !s.is_corner() && !s.is_tip();
  }
  bool is_narrow(size_t k) const {
    const WalkCorner::Kind kind = walk_.corners[k].kind;
    return kind == WalkCorner::kFromTrunk || kind == WalkCorner::kToTrunk ||
           (kind == WalkCorner::kRound && sector(k).is_corner());
  }

  /// Marks what is so near to a narrow corner, or to where a trunk is left, that its node would be in the way.
  std::vector<uint8_t> left_out() const {
    const size_t count = walk_.corners.size();
    std::vector<uint8_t> left_out(count, 0);
    for (size_t k = 0; k < count; ++k) {
      if (!is_narrow(k)) continue;
      const double far = kLeftOutAtCorner * reach(k);
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

  void add(size_t k, std::vector<Stop>& stops) const {
    const uint32_t node = ways_.to(walk_.ways[k]);
    const WalkCorner& corner = walk_.corners[k];
    uint8_t number = 0;
    const auto stop = [&](Vec2 direction, double factor) {
      stops.push_back({node, direction, factor * reach(k), k + 1, 0, number++});
    };
    switch (corner.kind) {
      case WalkCorner::kEnd: break;
      case WalkCorner::kOnTrunk: stops.push_back({node, {1, 0}, 0, k + 1, corner.fixed, 0}); break;
      case WalkCorner::kFromTrunk: stop(ways_.leaving(Ways::twin(walk_.ways[k])), 1); break;
      case WalkCorner::kToTrunk: stop(ways_.leaving(after(k)), 1); break;
      case WalkCorner::kRound: {
        const Sector s = sector(k);
        if (s.is_tip()) {
          for (const double share : {0.75, 0.5, 0.25}) stop(s.at(share), 1);
        } else {
          const double half = std::min(0.5 * s.angle, 0.5 * std::numbers::pi);
          stop(s.at(0.5), std::min(kMostReachOfCorner, 1 / elementary::sin(half)));
        }
      }
    }
  }

  const LineNetwork& network_;
  const Ways& ways_;
  double offset_;
  const Walk& walk_;
};

}  // namespace

Ways::Ways(const LineNetwork& network)
    : network_(network), first_(network.nodes().size() + 1, 0) {
  const auto count = static_cast<uint32_t>(2 * network.edges().size());
  for (Way w = 0; w < count; ++w) first_[from(w) + 1] += !edge(w).taken_out;
  for (size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  around_.resize(first_.back());
  std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
  for (Way w = 0; w < count; ++w) {
    if (!edge(w).taken_out) around_[next[from(w)]++] = w;
  }
  for (size_t v = 0; v + 1 < first_.size(); ++v) {
    std::sort(around_.begin() + first_[v], around_.begin() + first_[v + 1], [&](Way a, Way b) {
      return std::pair(angle_of(leaving(a)), a) < std::pair(angle_of(leaving(b)), b);
    });
  }
  place_.resize(count, kNone);
  for (uint32_t k = 0; k < around_.size(); ++k) place_[around_[k]] = k;
}

Way Ways::between(uint32_t from, uint32_t to) const {
  const auto ways = from_node(from);
  const auto found = std::ranges::find_if(ways, [&](Way w) { return this->to(w) == to; });
  return found == ways.end() ? kNone : *found;
}

Way Ways::next(Way w, Hand hand) const {
  const uint32_t v = to(w), k = place_[twin(w)];
  if (hand == kLeft) return around_[k == first_[v] ? first_[v + 1] - 1 : k - 1];
  return around_[k + 1 == first_[v + 1] ? first_[v] : k + 1];
}

void Ways::append_to(Path& path, Way w) const {
  const Path& own = edge(w).path;
  if (w % 2 == 0) {
    path.insert(path.end(), own.begin(), own.end());
  } else {
    std::transform(own.rbegin(), own.rend(), std::back_inserter(path), reversed);
  }
}

Walk Walk::round_tree(const Ways& ways, uint32_t root, CancelToken& poll) {
  Walk walk;
  const Way first = ways.first_at(root);
  Way way = first;
  do {
    poll();
    walk.ways.push_back(way);
    walk.corners.push_back({WalkCorner::kRound, kLeft});
    way = ways.next(way, kLeft);
  } while (way != first);
  return walk;
}

Walk Walk::along_trunk(const Ways& ways, const Trunk& trunk, CancelToken& poll) {
  Walk walk;
  walk.closed = trunk.closed;
  walk.on_trunk = true;
  walk.begins_fixed = trunk.fixed[0];
  const auto add = [&](Way way, const WalkCorner& corner) {
    poll();
    walk.ways.push_back(way);
    walk.corners.push_back(corner);
  };
  const auto finger_at = [&](uint32_t node, Way in, Way out) {
    const auto from = ways.from_node(node);
    const auto found = std::ranges::find_if(from, [&](Way w) { return w != Ways::twin(in) && w != out; });
    return found == from.end() ? kNone : *found;
  };
  const size_t count = trunk.nodes.size(), segments = trunk.closed ? count : count - 1;
  std::vector<Way> along;
  for (size_t k = 0; k < segments; ++k) along.push_back(ways.between(trunk.nodes[k], trunk.nodes[(k + 1) % count]));
  /// All ways round what leaves with a finger, and the corner after the way back to the trunk.
  const auto walk_round = [&](Way finger, Hand hand, WalkCorner::Kind back_at) {
    for (Way way = finger;; way = ways.next(way, hand)) {
      const bool back = way == Ways::twin(finger);
      add(way, {back ? back_at : WalkCorner::kRound, hand});
      if (back) return;
    }
  };
  if (!trunk.closed) {
    const Way finger = finger_at(trunk.nodes[0], Ways::twin(along[0]), along[0]);
    if (finger != kNone) walk_round(finger, kLeft, WalkCorner::kRound);
  }
  for (size_t step = 0; step < segments; ++step) {
    // A closed trunk begins with the segment that leads to its first node.
    const size_t k = trunk.closed ? (step + segments - 1) % segments : step;
    const uint32_t node = trunk.nodes[(k + 1) % count];
    const bool last = !trunk.closed && k + 1 == segments;
    const Way ahead = last ? kNone : along[(k + 1) % segments];
    const Way finger = finger_at(node, along[k], ahead);
    if (finger == kNone) {
      const uint8_t fixed = trunk.fixed[(k + 1) % count];
      add(along[k], {WalkCorner::kOnTrunk, kLeft, last || fixed, fixed});
      continue;
    }
    if (last) {
      add(along[k], {WalkCorner::kRound, kLeft});
      walk_round(finger, kLeft, WalkCorner::kEnd);
      continue;
    }
    add(along[k], {WalkCorner::kFromTrunk, kLeft});
    const Vec2 across = ways.leaving(ahead) - ways.leaving(Ways::twin(along[k]));
    walk_round(finger, cross(across, ways.leaving(finger)) > 0 ? kLeft : kRight, WalkCorner::kToTrunk);
  }
  return walk;
}

std::vector<Stop> stops_of(const Walk& walk, const LineNetwork& network, const Ways& ways, double offset) {
  return StopMaker(network, ways, offset, walk).make();
}

}  // namespace meander
