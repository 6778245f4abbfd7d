// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/line_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "base/disjoint_sets.h"
#include "geodesic/chart.h"

namespace meander {
namespace {

/// What links may be like. Lengths are in r, angles cosines with the line.
struct LinkRules {
  double longest;     ///< a link
  double ahead;       ///< at a tip, a link deviates from straight ahead by no more than this,
  double sideways;    ///< and elsewhere from a right angle
  size_t from_tip;    ///< nodes between a link that leaves sideways and a tip, at least
  double clear;       ///< of third lines
};

/// Links that leave by about 50 degrees from straight ahead or sideways, and, for lines that none of them reaches, others.
constexpr LinkRules kUsual{6.5, 0.5, 0.6, 2, 0.9}, kLast{10, 0, 0.92, 1, 0.6};

/// A tip that is joined saves a hairpin, which is worth this length, in r.
constexpr double kTipWorth = 1.5;

/// A link far from tips parts long stretches: this share of its distance from the nearest tip, of no more than so many r,
/// counts as length.
constexpr double kFromTip = 0.15, kFarFromTip = 20;

/// Two links on one side of a line keep this distance, in r.
constexpr double kApart = 2;

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
  Joiner(const std::vector<Streamline>& lines, LineNetwork& network, CancelPoll poll)
      : lines_(lines), network_(network), s_(network.surface()), poll_(poll), trees_(lines.size()),
        shortener_(network.surface()), index_(network.nodes().size(), kNone), tangent_(network.nodes().size()),
        used_(lines.size()) {
    for (const Streamline& line : lines) {
      for (size_t k = 0; k < line.nodes.size(); ++k) index_[line.nodes[k]] = static_cast<uint32_t>(k);
    }
    for (const LineNetwork::Edge& e : network.edges()) {
      const double sign = index_[e.to] > index_[e.from] ? 1 : -1;
      tangent_[e.from] = tangent_[e.from] + sign * e.shape.leaving;
      tangent_[e.to] = tangent_[e.to] + sign * e.shape.arriving;
    }
    for (Vec2& t : tangent_) t = unit(t);
  }

  std::vector<uint32_t> join() {
    join(kUsual, std::vector<uint8_t>(lines_.size(), 1));
    join(kLast, not_in_largest());
    std::vector<uint32_t> tree(lines_.size());
    for (uint32_t k = 0; k < lines_.size(); ++k) tree[k] = trees_.find(k);
    return tree;
  }

 private:
  uint32_t line_of(uint32_t node) const { return network_.nodes()[node].line; }

  /// The lines of all trees but the one with the most nodes of each component of the surface.
  std::vector<uint8_t> not_in_largest() {
    std::vector<size_t> nodes(lines_.size(), 0);
    std::vector<uint32_t> largest(s_.component_count(), kNone);
    for (uint32_t k = 0; k < lines_.size(); ++k) nodes[trees_.find(k)] += lines_[k].nodes.size();
    const auto component = [&](uint32_t k) {
      return s_.component(network_.nodes()[lines_[k].nodes[0]].point.face);
    };
    for (uint32_t k = 0; k < lines_.size(); ++k) {
      uint32_t& best = largest[component(k)];
      const uint32_t root = trees_.find(k);
      if (best == kNone || nodes[root] > nodes[best]) best = root;
    }
    std::vector<uint8_t> marked(lines_.size());
    for (uint32_t k = 0; k < lines_.size(); ++k) marked[k] = trees_.find(k) != largest[component(k)];
    return marked;
  }

  /// How a link in this direction, in the plane of the node, leaves the line.
  Exit exit_of(const LinkRules& rules, uint32_t node, Vec2 direction) const {
    const size_t k = index_[node], last = lines_[line_of(node)].nodes.size() - 1;
    const double cosine = dot(direction, tangent_[node]);
    if (k == last && cosine > rules.ahead) return Exit::kTip;
    if (k == 0 && cosine < -rules.ahead) return Exit::kTip;
    if (k < rules.from_tip || k + rules.from_tip > last || std::abs(cosine) > rules.sideways) return Exit::kNone;
    return cross(tangent_[node], direction) > 0 ? Exit::kLeft : Exit::kRight;
  }

  /// Distance along its line from the nearer tip, in r.
  double from_tip(uint32_t node) const {
    const std::vector<uint32_t>& nodes = lines_[line_of(node)].nodes;
    const auto arc = [&](uint32_t i) { return network_.nodes()[i].arc; };
    return std::min(arc(nodes.back()) - arc(node), arc(node) - arc(nodes.front()));
  }

  double cost(uint32_t a, uint32_t b, double length, Exit at_a, Exit at_b) const {
    const double tips = (at_a == Exit::kTip) + (at_b == Exit::kTip);
    return length - kTipWorth * tips + kFromTip * std::min({from_tip(a), from_tip(b), kFarFromTip});
  }

  void join(const LinkRules& rules, const std::vector<uint8_t>& marked) {
    std::vector<Candidate> candidates;
    for (uint32_t k = 0; k < lines_.size(); ++k) {
      if (!marked[k]) continue;
      for (const uint32_t node : lines_[k].nodes) find_candidates(rules, node, marked, candidates);
    }
    std::sort(candidates.begin(), candidates.end());
    for (const Candidate& c : candidates) {
      if (trees_.find(line_of(c.from)) == trees_.find(line_of(c.to))) continue;
      poll_(64);
      link(rules, c);
    }
  }

  /// The best link from a node to each line near it, and one at a tip of that besides.
  void find_candidates(const LinkRules& rules, uint32_t node, const std::vector<uint8_t>& marked,
                       std::vector<Candidate>& candidates) {
    const LineNetwork::Node& here = network_.nodes()[node];
    best_.clear();
    network_.near(here, rules.longest * here.radius, [&](uint32_t i, double distance) {
      poll_();
      const LineNetwork::Node& other = network_.nodes()[i];
      if (other.line >= LineNetwork::kBoundary || other.line == here.line) return false;
      if (marked[other.line] && other.line < here.line) return false;  // it is looked at from there
      const Vec3 chord = other.place - here.place;
      const Exit a = exit_of(rules, node, unit(s_.to_plane(here.point.face, chord)));
      const Exit b = exit_of(rules, i, unit(s_.to_plane(other.point.face, -chord)));
      if (a == Exit::kNone || b == Exit::kNone) return false;
      const Candidate c{cost(node, i, distance / here.radius, a, b), node, i};
      const auto [best, added] = best_.try_emplace({other.line, b == Exit::kTip}, c);
      if (!added && c < best->second) best->second = c;
      return false;
    });
    for (const auto& [key, candidate] : best_) candidates.push_back(candidate);
  }

  /// Adds a link, if it is one that may be.
  void link(const LinkRules& rules, const Candidate& c) {
    const LineNetwork::Node &a = network_.nodes()[c.from], &b = network_.nodes()[c.to];
    Chart chart = Chart::at(a.point, a.place);
    if (!chart.advance_to(s_, b.point, b.place, rules.longest * a.radius)) return;
    const double length = norm(chart.place);
    if (!(length > 0) || length > 1.2 * rules.longest * a.radius) return;
    Path path;
    trace_geodesic(s_, a.point, chart.place, path);
    const std::optional<PathShape> shape = shortener_.adopt(a.point, b.point, path);
    if (!shape || !(shape->length > 0)) return;
    const Exit at_a = exit_of(rules, c.from, shape->leaving), at_b = exit_of(rules, c.to, -shape->arriving);
    if (at_a == Exit::kNone || at_b == Exit::kNone) return;
    if (is_used(c.from, at_a) || is_used(c.to, at_b)) return;
    if (passes_over_another(rules, a, b, chart.place) || network_.touches(c.from, c.to, b.point, path)) return;
    used_[a.line].push_back({c.from, at_a});
    used_[b.line].push_back({c.to, at_b});
    trees_.join(a.line, b.line);
    network_.add_edge(c.from, c.to, std::move(path), *shape);
  }

  bool is_used(uint32_t node, Exit exit) const {
    const auto arc = [&](uint32_t i) { return network_.nodes()[i].arc; };
    return std::ranges::any_of(used_[line_of(node)], [&](const auto& other) {
      return other.second == exit && std::abs(arc(other.first) - arc(node)) < kApart;
    });
  }

  bool passes_over_another(const LinkRules& rules, const LineNetwork::Node& a, const LineNetwork::Node& b,
                           Vec2 link) const {
    for (const double share : {0.25, 0.5, 0.75}) {
      Path path;
      const Trace there = trace_geodesic(s_, a.point, share * link, path);
      const LineNetwork::Node node = network_.make_node(there.end, kNone, 0);
      if (network_.near(node, rules.clear * node.radius, [&](uint32_t i, double) {
            const uint32_t line = network_.nodes()[i].line;
            return line != a.line && line != b.line && line != LineNetwork::kBoundary;
          })) {
        return true;
      }
    }
    return false;
  }

  const std::vector<Streamline>& lines_;
  LineNetwork& network_;
  const Surface& s_;
  CancelPoll poll_;
  DisjointSets trees_;
  PathShortener shortener_;
  std::vector<uint32_t> index_;  // per node: its place in its line
  std::vector<Vec2> tangent_;    // per node, in the plane of its face, along its line
  std::vector<std::vector<std::pair<uint32_t, Exit>>> used_;  // per line
  std::map<std::pair<uint32_t, bool>, Candidate> best_;       // of one node, per line and whether at its tip
};

}  // namespace

std::vector<uint32_t> join_lines(const std::vector<Streamline>& lines, LineNetwork& network, CancelPoll poll) {
  return Joiner(lines, network, poll).join();
}

}  // namespace meander
