// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/line_tree.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "base/disjoint_sets.h"
#include "base/variation.h"
#include "geodesic/chart.h"
#include "seed/constants.h"
#include "seed/link_rules.h"
#include "seed/way_out.h"

namespace meander {
namespace {

/// What a search counts for, in pieces of work.
constexpr size_t kPiecesPerSearch = 64;

/// How a link leaves a line.
enum class Exit : uint8_t { kNone, kTip, kLeft, kRight };

struct Candidate {
  double cost;
  uint32_t from, to;
  bool operator<(const Candidate& other) const {
    return std::tie(cost, from, to) < std::tie(other.cost, other.from, other.to);
  }
};

class Joiner {
 public:
  Joiner(std::vector<Streamline>& lines, const std::vector<uint8_t>& holds, uint32_t variation,
         LineNetwork& network, ThreadPool& pool, CancelToken poll)
      : lines_(lines), variation_(variation), network_(network), s_(network.surface()), pool_(pool), poll_(poll),
        trees_(lines.size()),
        shortener_(network.surface()), index_(network.nodes().size(), kNone), tangent_(network.nodes().size()),
        trunk_(lines.size(), 0), held_(network.nodes().size(), 0),
        places_left_(10 * kPlacesOfTree + kPlacesOfAny * network.nodes().size()), used_(lines.size()) {
    for (uint32_t k = 0; k < lines.size(); ++k) number(k);
    for (const LineNetwork::Edge& e : network.edges()) {
      if (e.taken_out || line_of(e.from) != line_of(e.to)) continue;
      const bool closing = lines[line_of(e.from)].closed && index_[e.to] == 0;
      const double sign = index_[e.to] > index_[e.from] || closing ? 1 : -1;
      tangent_[e.from] = tangent_[e.from] + sign * e.shape.leaving;
      tangent_[e.to] = tangent_[e.to] + sign * e.shape.arriving;
    }
    for (Vec2& t : tangent_) t = unit(t);
    for (uint32_t k = 0; k < lines.size(); ++k) {
      if (!lines[k].trunk) continue;
      trunk_[k] = 1;
      for (size_t i = 0; i < lines[k].nodes.size(); ++i) {
        const uint32_t node = lines[k].nodes[i];
        const bool end = !lines[k].closed && (i == 0 || i + 1 == lines[k].nodes.size());
        if (!end && !(node < holds.size() && holds[node])) continue;
        const LineNetwork::Node& here = network.nodes()[node];
        held_[node] = 1;
        network.near(here, kFromHeld * here.radius, [&](uint32_t near, double) {
          held_[near] = 1;
          return false;
        });
      }
    }
    for (const LineNetwork::Edge& e : network.edges()) {
      const uint32_t a = line_of(e.from), b = line_of(e.to);
      if (a == b) continue;
      used_[a].push_back({e.from, exit_of(kLast, e.from, e.shape.leaving)});
      used_[b].push_back({e.to, exit_of(kLast, e.to, -e.shape.arriving)});
      if (!e.taken_out) join(a, b);
    }
  }

  std::vector<uint32_t> join() {
    join_near();
    while (join_met() || join_by_ways()) continue;
    std::vector<uint32_t> tree(lines_.size());
    for (uint32_t k = 0; k < lines_.size(); ++k) tree[k] = trees_.find(k);
    return tree;
  }

 private:
  using Best = std::map<std::pair<uint32_t, double>, Candidate>;  // of one node, per line and part of it

  uint32_t line_of(uint32_t node) const { return network_.nodes()[node].line; }

  /// The lines of all trees but the one with the most nodes of each component of the surface.
  std::vector<uint8_t> not_in_largest() {
    std::vector<size_t> nodes(lines_.size(), 0);
    std::vector<uint32_t> largest(s_.component_count(), kNone);
    for (uint32_t k = 0; k < lines_.size(); ++k) nodes[trees_.find(k)] += lines_[k].nodes.size();
    for (uint32_t k = 0; k < lines_.size(); ++k) {
      if (lines_[k].trunk) nodes[trees_.find(k)] += network_.nodes().size();  // never joined to another
    }
    const auto component = [&](uint32_t k) {
      return s_.component(network_.nodes()[lines_[k].nodes[0]].point.face);
    };
    for (uint32_t k = 0; k < lines_.size(); ++k) {
      uint32_t& best = largest[component(k)];
      const uint32_t root = trees_.find(k);
      if (best == kNone || nodes[root] > nodes[best]) best = root;
    }
    std::vector<uint8_t> marked(lines_.size());
    for (uint32_t k = 0; k < lines_.size(); ++k) {
      marked[k] = trees_.find(k) != largest[component(k)] && !trunk_[trees_.find(k)];
    }
    return marked;
  }

  /// How a link in this direction, in the plane of the node, leaves the line.
  Exit exit_of(const LinkRules& rules, uint32_t node, Vec2 direction) const {
    const size_t k = index_[node], last = lines_[line_of(node)].nodes.size() - 1;
    const double cosine = dot(direction, tangent_[node]);
    if (lines_[line_of(node)].trunk) {
      return std::abs(cosine) > kUsual.sideways || held_[node] ? Exit::kNone : Exit::kLeft;
    }
    if (k == last && cosine > rules.ahead) return Exit::kTip;
    if (k == 0 && cosine < -rules.ahead) return Exit::kTip;
    if (k < rules.from_tip || k + rules.from_tip > last || std::abs(cosine) > rules.sideways) return Exit::kNone;
    return cross(tangent_[node], direction) > 0 ? Exit::kLeft : Exit::kRight;
  }

  /// Distance along its line from the nearer tip, in r.
  double from_tip(uint32_t node) const {
    if (lines_[line_of(node)].trunk) return 0;
    const std::vector<uint32_t>& nodes = lines_[line_of(node)].nodes;
    const auto arc = [&](uint32_t i) { return network_.nodes()[i].arc; };
    return std::min(arc(nodes.back()) - arc(node), arc(node) - arc(nodes.front()));
  }

  /// By how much less a link costs in this variation: alike for all from one half of a line to another line.
  double varied(uint32_t a, uint32_t b) const {
    if (variation_ == 0) return 0;
    const uint32_t half = 2 * index_[a] >= lines_[line_of(a)].nodes.size();
    return kVaried * number_of_variation(variation_, 2 * line_of(a) + half, line_of(b));
  }

  double cost(uint32_t a, uint32_t b, double length, Exit at_a, Exit at_b) const {
    const double tips = (at_a == Exit::kTip) + (at_b == Exit::kTip);
    return length - kTipWorth * tips + kFromTip * std::min({from_tip(a), from_tip(b), kFarFromTip}) - varied(a, b);
  }

  /// Joins what is near through space and along the surface.
  void join_near() {
    constexpr size_t kLines = 4;
    std::vector<std::vector<Candidate>> found(ThreadPool::block_count(lines_.size(), kLines));
    pool_.for_blocks(lines_.size(), kLines, [&](size_t block, size_t begin, size_t end) {
      Best best;
      for (size_t k = begin; k < end; ++k) {
        for (const uint32_t node : lines_[k].nodes) find_candidates(node, best, found[block]);
      }
    });
    std::vector<Candidate> candidates;
    for (const auto& block : found) candidates.insert(candidates.end(), block.begin(), block.end());
    std::sort(candidates.begin(), candidates.end());
    for (const Candidate& c : candidates) {
      if (trees_.find(line_of(c.from)) == trees_.find(line_of(c.to))) continue;
      poll_(kPiecesPerSearch);
      link_near(c);
    }
  }

  /// The best link from a node to each line near it, and one at a tip of that besides.
  void find_candidates(uint32_t node, Best& best_here, std::vector<Candidate>& candidates) const {
    const LineNetwork::Node& here = network_.nodes()[node];
    best_here.clear();
    const auto wanted = [&](uint32_t line) { return line > here.line && line < LineNetwork::kBoundary; };
    network_.near(here, kUsual.longest * here.radius, wanted, [&](uint32_t i, double distance) {
      const LineNetwork::Node& other = network_.nodes()[i];
      const Vec3 chord = other.place - here.place;
      const Exit a = exit_of(kUsual, node, unit(s_.to_plane(here.point.face, chord)));
      const Exit b = exit_of(kUsual, i, unit(s_.to_plane(other.point.face, -chord)));
      if (a == Exit::kNone || b == Exit::kNone) return false;
      const Candidate c{cost(node, i, distance / here.radius, a, b), node, i};
      const auto [best, added] = best_here.try_emplace({other.line, b == Exit::kTip}, c);
      if (!added && c < best->second) best->second = c;
      return false;
    });
    for (const auto& [key, candidate] : best_here) candidates.push_back(candidate);
  }

  void link_near(const Candidate& c) {
    const LineNetwork::Node &a = network_.nodes()[c.from], &b = network_.nodes()[c.to];
    Chart chart = Chart::at(a.point, a.place);
    if (!chart.advance_to(s_, b.point, b.place, kUsual.longest * a.radius)) return;
    const double length = norm(chart.place);
    if (!(length > 0) || length > kUsual.longest * a.radius) return;
    if (network_.passes_by(c.from, line_of(c.to), chart.place, kClearOfThirdLines)) return;
    Path path;
    trace_geodesic(s_, a.point, chart.place, path);
    if (const auto shape = shortener_.adopt(a.point, b.point, path)) link(kUsual, c, std::move(path), *shape);
  }

  /// Joins trees by what straight walks from them meet, as round the edge of a fold. Whether it has joined any.
  bool join_met() {
    const std::vector<uint8_t> marked = not_in_largest();
    struct Walk {
      double length;
      Candidate ends;
      Path path;
      PathShape shape;
    };
    std::vector<Walk> walks;
    for (uint32_t k = 0; k < lines_.size(); ++k) {
      if (!marked[k]) continue;
      for (const uint32_t node : lines_[k].nodes) {
        for (const Vec2 direction : {Vec2{0, 1}, Vec2{0, -1}, Vec2{1, 0}, Vec2{-1, 0}}) {
          poll_(kPiecesPerSearch);
          const auto to = walk(node, direction * tangent_[node]);
          if (!to) continue;
          walks.push_back({to->second.length / network_.nodes()[node].radius, {0, node, to->first}, std::move(walked_),
                           to->second});
        }
      }
    }
    std::ranges::stable_sort(walks, {}, &Walk::length);
    bool any = false;
    for (Walk& w : walks) any = link(kLast, w.ends, std::move(w.path), w.shape) || any;
    return any;
  }

  /// Joins trees by ways round whatever there is, as through a neck. Whether it has joined any.
  bool join_by_ways() {
    const std::vector<uint8_t> marked = not_in_largest();
    std::map<uint32_t, std::vector<WayEnd>> ends;  // per tree
    for (uint32_t k = 0; k < lines_.size(); ++k) {
      const std::vector<uint32_t>& nodes = lines_[k].nodes;
      for (size_t i = 0; marked[k] && i < nodes.size(); ++i) {
        const bool tip = i == 0 || i + 1 == nodes.size();
        const Vec2 along = i == 0 ? -tangent_[nodes[i]] : tangent_[nodes[i]];
        if (tip && is_used(nodes[i], Exit::kTip)) continue;
        if (is_outermost(nodes[i])) ends[trees_.find(k)].push_back({nodes[i], along, tip});
      }
    }
    bool any = false;
    for (const auto& [tree, from_here] : ends) {
      const uint32_t own = trees_.find(tree);
      const auto is_goal = [&](uint32_t line) { return line < lines_.size() && trees_.find(line) != own; };
      const auto takes = [&](uint32_t from, uint32_t to, WayOut& way) { return link_by_way({0, from, to}, way); };
      const size_t most = std::min(places_left_, kPlacesOfTree + kPlacesOfNode * from_here.size());
      size_t left = most;
      any = find_way_out(network_, from_here, is_goal, takes, shortener_, left, poll_) || any;
      places_left_ -= most - left;
    }
    return any;
  }

  /// Whether the boundary or another tree is not far from a node: in the midst of its own tree there is no way out.
  bool is_outermost(uint32_t node) {
    const LineNetwork::Node& here = network_.nodes()[node];
    const auto other = [&](uint32_t line) {
      return line >= LineNetwork::kBoundary || trees_.find(line) != trees_.find(here.line);
    };
    return network_.near(here, kOutermost * here.radius, other, [](uint32_t, double) { return true; });
  }

  /// Joins two nodes by a line through places, if that may be; whether it has.
  bool link_by_way(const Candidate& c, WayOut& way) {
    if (trunk_[trees_.find(line_of(c.from))] && trunk_[trees_.find(line_of(c.to))]) return false;
    if (way.places.empty()) return link(kLast, c, std::move(way.legs[0].path), way.legs[0].shape);
    const Exit at_a = exit_of(kLast, c.from, way.legs.front().shape.leaving);
    const Exit at_b = exit_of(kLast, c.to, -way.legs.back().shape.arriving);
    if (at_a == Exit::kNone || at_b == Exit::kNone || is_used(c.from, at_a) || is_used(c.to, at_b)) return false;
    const LineNetwork::Mark mark = network_.mark();
    const auto line = static_cast<uint32_t>(lines_.size());
    Streamline between;
    double arc = 0;
    uint32_t from = c.from;
    for (size_t k = 0; k < way.legs.size(); ++k) {
      const bool last = k == way.places.size();
      WayOut::Leg& leg = way.legs[k];
      const SurfacePoint& end = last ? network_.nodes()[c.to].point : way.places[k];
      if (network_.touches(from, last ? c.to : kNone, end, leg.path)) {
        network_.take_back(mark);
        return false;
      }
      if (k > 0) arc += leg.shape.length / network_.nodes()[from].radius;
      const uint32_t to = last ? c.to : network_.add_node(network_.make_node(end, line, arc));
      network_.add_edge(from, to, std::move(leg.path), leg.shape);
      if (!last) between.nodes.push_back(to);
      from = to;
    }
    add(std::move(between), way);
    used_[line_of(c.from)].push_back({c.from, at_a});
    used_[line_of(c.to)].push_back({c.to, at_b});
    join(line_of(c.from), line);
    join(line, line_of(c.to));
    return true;
  }

  /// A line of these nodes, which are the last of the network.
  void add(Streamline line, const WayOut& way) {
    for (size_t k = 0; k < line.nodes.size(); ++k) {
      index_.push_back(static_cast<uint32_t>(k));
      tangent_.push_back(unit(way.legs[k].shape.arriving + way.legs[k + 1].shape.leaving));
      held_.push_back(0);
    }
    lines_.push_back(std::move(line));
    trees_.add();
    trunk_.push_back(0);
    used_.emplace_back();
  }

  /// Notes the places of a line's nodes in it.
  void number(uint32_t line) {
    const std::vector<uint32_t>& nodes = lines_[line].nodes;
    for (size_t k = 0; k < nodes.size(); ++k) index_[nodes[k]] = static_cast<uint32_t>(k);
  }

  /// Where a walk meets a line of another tree: a node beside that place, and the shape of the path there, which is
  /// then in walked_.
  std::optional<std::pair<uint32_t, PathShape>> walk(uint32_t node, Vec2 direction) {
    const LineNetwork::Node& here = network_.nodes()[node];
    if (exit_of(kLast, node, direction) == Exit::kNone) return std::nullopt;
    walked_.clear();
    const Trace there = trace_geodesic(s_, here.point, kLast.longest * here.radius * direction, walked_);
    const auto met = network_.first_met(node, there.end, walked_);
    if (!met || met->edge == kNone) return std::nullopt;
    const LineNetwork::Edge& edge = network_.edges()[met->edge];
    if (line_of(edge.from) != line_of(edge.to) || trees_.find(line_of(edge.to)) == trees_.find(here.line)) {
      return std::nullopt;
    }
    walked_.resize(met->crossings);
    walked_.insert(walked_.end(), edge.path.begin() + static_cast<std::ptrdiff_t>(met->crossings_of_edge),
                   edge.path.end());
    const PathShape shape = shortener_.shorten(here.point, network_.nodes()[edge.to].point, walked_);
    return std::pair{edge.to, shape};
  }

  /// Adds a link, if it is one that may be; whether it has.
  bool link(const LinkRules& rules, const Candidate& c, Path path, const PathShape& shape) {
    const uint32_t a = line_of(c.from), b = line_of(c.to);
    const uint32_t tree_a = trees_.find(a), tree_b = trees_.find(b);
    if (tree_a == tree_b || (trunk_[tree_a] && trunk_[tree_b]) || !(shape.length > 0)) return false;
    const Exit at_a = exit_of(rules, c.from, shape.leaving), at_b = exit_of(rules, c.to, -shape.arriving);
    if (at_a == Exit::kNone || at_b == Exit::kNone) return false;
    if (is_used(c.from, at_a) || is_used(c.to, at_b)) return false;
    if (network_.touches(c.from, c.to, network_.nodes()[c.to].point, path)) return false;
    used_[a].push_back({c.from, at_a});
    used_[b].push_back({c.to, at_b});
    join(a, b);
    network_.add_edge(c.from, c.to, std::move(path), shape);
    return true;
  }

  void join(uint32_t a, uint32_t b) {
    const bool trunk = trunk_[trees_.find(a)] || trunk_[trees_.find(b)];
    trees_.join(a, b);
    trunk_[trees_.find(a)] = trunk;
  }

  bool is_used(uint32_t node, Exit exit) const {
    const auto arc = [&](uint32_t i) { return network_.nodes()[i].arc; };
    return std::ranges::any_of(used_[line_of(node)], [&](const auto& other) {
      return other.second == exit && std::abs(arc(other.first) - arc(node)) < kLinksApart;
    });
  }

  std::vector<Streamline>& lines_;
  uint32_t variation_;
  LineNetwork& network_;
  const Surface& s_;
  ThreadPool& pool_;
  CancelToken poll_;
  DisjointSets trees_;
  PathShortener shortener_;
  std::vector<uint32_t> index_;  // per node: its place in its line
  std::vector<Vec2> tangent_;    // per node, in the plane of its face, along its line
  std::vector<uint8_t> trunk_;   // per tree: one of its lines is a trunk
  std::vector<uint8_t> held_;    // per node: no link of a trunk begins there
  Path walked_;
  size_t places_left_;           // that may be looked at on ways out
  std::vector<std::vector<std::pair<uint32_t, Exit>>> used_;  // per line
};

}  // namespace

std::vector<uint32_t> join_lines(std::vector<Streamline>& lines, const std::vector<uint8_t>& holds,
                                 uint32_t variation, LineNetwork& network, ThreadPool& pool,
                                 CancelToken poll) {
  return Joiner(lines, holds, variation, network, pool, poll).join();
}

}  // namespace meander
