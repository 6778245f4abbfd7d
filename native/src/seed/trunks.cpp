// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/trunks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "geodesic/chart.h"
#include "seed/bent_path.h"
#include "seed/constants.h"

namespace meander {
namespace {

/// How far the boundary is from a node on both sides of a direction, in its r; infinite where it is farther than asked,
/// and where another line is nearer.
struct Across {
  double left, right;
  double width() const { return left + right; }
};
Across across(const LineNetwork& network, uint32_t node, Vec2 direction, double most) {
  const LineNetwork::Node& here = network.nodes()[node];
  const auto reach = [&](double side) {
    Path path;
    const Vec2 sideways = Vec2{0, side * most * here.radius} * direction;
    const Trace there = trace_geodesic(network.surface(), here.point, sideways, path);
    const bool free = there.hit_boundary && !network.first_met(node, there.end, path);
    return free ? there.length / here.radius : std::numeric_limits<double>::infinity();
  };
  return {reach(1), reach(-1)};
}

/// Of the last node of a list, away from the one before it.
std::optional<Vec2> outward(const LineNetwork& network, const std::vector<uint32_t>& nodes) {
  const uint32_t last = nodes.back(), before = nodes[nodes.size() - 2];
  for (const LineNetwork::Edge& e : network.edges()) {
    if (e.taken_out) continue;
    if (e.from == before && e.to == last) return unit(e.shape.arriving);
    if (e.from == last && e.to == before) return -unit(e.shape.leaving);
  }
  return std::nullopt;
}

/// Lets the last end of one trunk run on.
class Prolonging {
 public:
  Prolonging(const LineField& field, LineNetwork& network, std::vector<Streamline>& lines, size_t drawn)
      : field_(field), network_(network), s_(network.surface()), lines_(lines), drawn_(drawn),
        shortener_(network.surface()) {}

  /// Joins the end to a line that fills what is narrow with its way back, but for lines that are joined to one already.
  void link_to_next(const std::vector<uint32_t>& nodes) {
    linked_.resize(lines_.size(), 0);
    const auto direction = nodes.size() < 2 ? std::nullopt : outward(network_, nodes);
    if (!direction) return;
    for (const uint32_t tip : tips_in_reach(nodes.back(), *direction, kTwoStrandsInStrip)) {
      const uint32_t line = network_.nodes()[tip].line;
      if (linked_[line] || !join(nodes.back(), tip)) continue;
      linked_[line] = 1;
      return;
    }
  }

  /// Appends the nodes of the line ahead to those of a trunk, whose number is `line`; false where there is none. The
  /// first `kept` nodes stay.
  bool run_on(std::vector<uint32_t>& nodes, size_t kept, uint32_t line) {
    if (nodes.size() < 2) return false;
    const auto direction = outward(network_, nodes);
    if (!direction || !ends_in_narrow(nodes, *direction)) return false;
    for (const uint32_t tip : tips_in_reach(nodes.back(), *direction, kOneLineInStrip)) {
      if (!join(nodes, kept, tip)) continue;
      take(network_.nodes()[tip].line, tip, line, nodes);
      return true;
    }
    return false;
  }

 private:
  /// Whether it is narrow where a line ends or, as the strip may turn there, just before.
  bool ends_in_narrow(const std::vector<uint32_t>& nodes, Vec2 direction) const {
    if (across(network_, nodes.back(), direction, kOneLineInStrip).width() <= kOneLineInStrip) return true;
    const LineNetwork::Node& end = network_.nodes()[nodes.back()];
    for (size_t k = nodes.size(); k-- > 0;) {
      if ((network_.nodes()[nodes[k]].place - end.place).norm() > kOneLineInStrip * end.radius) break;
      if (is_narrow(nodes[k], kOneLineInStrip)) return true;
    }
    return false;
  }
  bool is_narrow(uint32_t node, double width) const {
    const Vec2 direction = unit(field_.at(network_.nodes()[node].point));
    return across(network_, node, direction, width).width() <= width;
  }

  /// Tips of lines, most of which lie where it is no wider than this: those straight ahead, the nearest first, and then
  /// the others, as a strip may turn back at a corner.
  std::vector<uint32_t> tips_in_reach(uint32_t end, Vec2 direction, double width) {
    const LineNetwork::Node& here = network_.nodes()[end];
    std::vector<std::tuple<bool, double, uint32_t>> tips;
    network_.near(here, kTipAhead * here.radius, [&](uint32_t i, double distance) {
      const LineNetwork::Node& other = network_.nodes()[i];
      if (other.line >= LineNetwork::kBoundary || other.line < drawn_) return false;
      const std::vector<uint32_t>& line = lines_[other.line].nodes;
      const Vec2 there = unit(s_.to_plane(here.point.face, other.place - here.place));
      const bool tip = i == line.front() || i == line.back();
      if (tip) tips.emplace_back(dot(there, direction) <= kStraightAhead, distance, i);
      return false;
    });
    std::ranges::sort(tips);
    std::vector<uint32_t> found;
    for (const auto& [aside, distance, tip] : tips) {
      if (is_narrow(lines_[network_.nodes()[tip].line], width)) found.push_back(tip);
    }
    return found;
  }

  bool is_narrow(const Streamline& line, double width) const {
    const auto narrow = std::ranges::count_if(line.nodes, [&](uint32_t node) { return is_narrow(node, width); });
    return 2 * static_cast<size_t>(narrow) > line.nodes.size();
  }

  /// Joins the end to a tip or, where it has gone too far round a corner, a node before it; what is after that node is
  /// a line of its own then.
  bool join(std::vector<uint32_t>& nodes, size_t kept, uint32_t tip) {
    const size_t least = std::max(kept, nodes.size() - std::min(nodes.size(), kMostBeyondCorner));
    for (size_t count = nodes.size(); count >= least && count > 1; --count) {
      if (!join(nodes[count - 1], tip)) continue;
      if (count < nodes.size()) cut(nodes, count);
      return true;
    }
    return false;
  }

  void cut(std::vector<uint32_t>& nodes, size_t count) {
    const uint32_t last = nodes[count - 1], first = nodes[count];
    for (uint32_t k = 0; k < network_.edges().size(); ++k) {
      const LineNetwork::Edge& e = network_.edges()[k];
      const bool between = (e.from == last && e.to == first) || (e.from == first && e.to == last);
      if (between && !e.taken_out) network_.take_out(k);
    }
    Streamline rest{{nodes.begin() + static_cast<std::ptrdiff_t>(count), nodes.end()}};
    for (const uint32_t node : rest.nodes) network_.set_line(node, static_cast<uint32_t>(lines_.size()));
    lines_.push_back(std::move(rest));
    nodes.resize(count);
  }

  bool join(uint32_t from, uint32_t to) {
    const SurfacePoint end = network_.nodes()[to].point;
    Path path;
    const auto is_clear = [&](const std::optional<PathShape>& shape) {
      return shape && shape->length > 0 && !network_.touches(from, to, end, path);
    };
    std::optional<PathShape> shape = straight(from, to, path);
    if (!is_clear(shape)) shape = bent_path(network_, from, to, shortener_, path);
    if (!is_clear(shape)) return false;
    network_.add_edge(from, to, std::move(path), *shape);
    return true;
  }

  std::optional<PathShape> straight(uint32_t from, uint32_t to, Path& path) {
    const LineNetwork::Node &a = network_.nodes()[from], &b = network_.nodes()[to];
    Chart chart = Chart::at(a.point, a.place);
    if (!chart.advance_to(s_, b.point, b.place, kTipAhead * a.radius)) return std::nullopt;
    trace_geodesic(s_, a.point, chart.place, path);
    return shortener_.adopt(a.point, b.point, path);
  }

  /// Takes a line that begins, or ends, at `tip`.
  void take(uint32_t taken, uint32_t tip, uint32_t line, std::vector<uint32_t>& nodes) {
    std::vector<uint32_t> added = std::move(lines_[taken].nodes);
    if (added.front() != tip) std::ranges::reverse(added);
    for (const uint32_t node : added) network_.set_line(node, line);
    nodes.insert(nodes.end(), added.begin(), added.end());
    if (taken + 1 < lines_.size()) {
      lines_[taken] = std::move(lines_.back());
      for (const uint32_t node : lines_[taken].nodes) network_.set_line(node, taken);
    }
    lines_.pop_back();
  }

  const LineField& field_;
  LineNetwork& network_;
  const Surface& s_;
  std::vector<Streamline>& lines_;
  size_t drawn_;  // the first line that is neither a trunk nor part of one
  PathShortener shortener_;
  std::vector<uint8_t> linked_;  // per line: link_to_next has joined it
};

/// Whether both ends are free and hold all of it, so that nothing leaves it sideways.
bool is_short(const LineNetwork& network, const Trunk& trunk) {
  const auto arc = [&](uint32_t node) { return network.nodes()[node].arc; };
  return !trunk.closed && std::ranges::count(trunk.fixed, 0) == static_cast<std::ptrdiff_t>(trunk.fixed.size()) &&
         std::abs(arc(trunk.nodes.back()) - arc(trunk.nodes.front())) < kShortTrunk;
}

}  // namespace

void Trunks::add(const Curve& curve, size_t drawn, LineNetwork& network, std::vector<Streamline>& lines) {
  for (uint32_t k = 0; k < drawn; ++k) {
    const Strand& strand = curve.strands[k];
    if (strand.guide) continue;
    Streamline line{{}, true, strand.closed};
    Trunk trunk{{}, {}, strand.closed};
    double arc = 0;
    for (uint32_t i = strand.first; i < strand.end(); ++i) {
      const auto node = network.make_node(curve.nodes[i], static_cast<uint32_t>(lines.size()), arc);
      line.nodes.push_back(network.add_node(node));
      trunk.fixed.push_back(curve.fixed[i]);
      if (curve.has_segment(i)) arc += curve.shapes[i].length / node.radius;
    }
    trunk.nodes = line.nodes;
    for (uint32_t i = 0; i < strand.segment_count(); ++i) {
      const uint32_t from = strand.first + i;
      network.add_edge(line.nodes[i], line.nodes[(i + 1) % strand.count], curve.paths[from], curve.shapes[from]);
    }
    for (size_t i = 0; i < line.nodes.size(); ++i) {
      holds.resize(line.nodes[i] + size_t{1}, 0);
      holds[line.nodes[i]] = trunk.fixed[i];
    }
    strands.push_back(k);
    trunks.push_back(std::move(trunk));
    lines.push_back(std::move(line));
  }
  parted.assign(trunks.size(), 0);
  for (size_t k = 0; k < trunks.size(); ++k) {
    if (!trunks[k].closed) part_alone(curve, k, network, lines);
  }
}

void Trunks::part_alone(const Curve& curve, size_t k, LineNetwork& network, std::vector<Streamline>& lines) {
  const Strand& strand = curve.strands[strands[k]];
  const std::vector<uint32_t> nodes = trunks[k].nodes;
  const std::vector<uint8_t> fixed = trunks[k].fixed;
  const auto arc = [&](size_t i) { return network.nodes()[nodes[i]].arc; };
  const auto is_alone = [&](size_t i) {
    const auto at = static_cast<uint32_t>(strand.first + i);
    const Vec2 along = curve.has_segment(at) ? curve.shapes[at].leaving : curve.shapes[at - 1].arriving;
    const Across sides = across(network, nodes[i], unit(along), kTwoStrandsInStrip);
    return !fixed[i] && sides.width() > kOneLineInStrip && sides.width() < kTwoStrandsInStrip;
  };
  const size_t count = nodes.size();
  if (count < 4) return;
  size_t first = 0, last = count;  // what stays: from the one to before the other, two nodes at least
  while (first < count && is_alone(first)) ++first;
  if (first == count) {
    // Other lines may go on from both of its tips, but a short one has only one.
    first = arc(count - 1) < 3 * kLeastTail ? 0 : count / 2 - 1;
    last = first + 2;
  } else {
    while (last > first + 2 && is_alone(last - 1)) --last;
    first = std::min(first, last - 2);
  }
  if (first > 0 && arc(first - 1) - arc(0) < kLeastTail) first = 0;
  if (last < count && arc(count - 1) - arc(last) < kLeastTail) last = count;
  const auto part = [&](size_t begin, size_t end) {
    if (begin == end) return;
    const auto at = [&](size_t i) { return nodes.begin() + static_cast<std::ptrdiff_t>(i); };
    Streamline tail{{at(begin), at(end)}};
    for (const uint32_t node : tail.nodes) network.set_line(node, static_cast<uint32_t>(lines.size()));
    lines.push_back(std::move(tail));
  };
  part(0, first);
  part(last, count);
  parted[k] = first > 0 || last < count;
  const auto stays = [&](auto& list) {
    list = {list.begin() + static_cast<std::ptrdiff_t>(first), list.begin() + static_cast<std::ptrdiff_t>(last)};
  };
  stays(trunks[k].nodes);
  stays(trunks[k].fixed);
  lines[k].nodes = trunks[k].nodes;
}

void Trunks::prolong(const LineField& field, size_t drawn, LineNetwork& network, std::vector<Streamline>& lines,
                     CancelToken poll) {
  prolonged.assign(trunks.size(), 0);
  if (field.empty()) return;
  Prolonging prolonging(field, network, lines, drawn);
  for (uint32_t k = 0; k < trunks.size(); ++k) {
    Trunk& trunk = trunks[k];
    if (trunk.closed) continue;
    for (int end = 0; end < 2; ++end) {
      const size_t kept = trunk.nodes.size();
      while (!trunk.fixed.back() && prolonging.run_on(trunk.nodes, kept, k)) {
        poll();
        prolonged[k] = 1;
        trunk.fixed.resize(trunk.nodes.size(), 0);
      }
      std::ranges::reverse(trunk.nodes);
      std::ranges::reverse(trunk.fixed);
    }
    lines[k].nodes = trunk.nodes;
  }
  for (size_t k = 0; k < trunks.size(); ++k) {
    if (prolonged[k] || parted[k] || !is_short(network, trunks[k])) continue;
    std::vector<uint32_t> nodes = trunks[k].nodes;
    for (int end = 0; end < 2; ++end) {
      prolonging.link_to_next(nodes);
      std::ranges::reverse(nodes);
    }
  }
}

}  // namespace meander
