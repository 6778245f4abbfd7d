// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/tree_tour.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "curve/crossings.h"
#include "geodesic/geodesic_trace.h"
#include "seed/constants.h"

namespace meander {
namespace {

/// Segments joined between two asks.
constexpr uint32_t kSegmentsPerPoll = 1024;

using Pairs = std::vector<std::pair<uint32_t, uint32_t>>;

/// The walk of each strand of the first curve; none where that stays.
using Walks = std::vector<std::optional<Walk>>;

/// The curve of many walks, as it is laid nearer to their trees.
class Laying {
 public:
  Laying(const LineNetwork& network, const Ways& ways, Walks walks, double offset, const Curve& first,
         ThreadPool& pool)
      : network_(network), ways_(ways), walks_(std::move(walks)), offset_(offset), first_(first), pool_(pool),
        shortener_(network.surface()), poll_(pool.poll(kSegmentsPerPoll)), known_(walks_.size()) {
    for (size_t k = 0; k < walks_.size(); ++k) {
      if (walks_[k]) known_[k].assign(Stop::kMostStops * (walks_[k]->corners.size() + 1), kNone);
    }
  }

  /// Lays the curve; the pairs of segments that touch after all.
  Pairs lay() {
    std::vector<uint8_t> nearer;  // per node: its corner has come nearer to the tree
    Pairs crossing;
    for (int k = 0; k <= kHalvingsOfOffset; ++k) {
      lay_out(nearer);
      const Table<uint8_t> changed = join();
      crossing = test_.find(network_.surface(), curve_, pool_, &changed);
      if (crossing.empty() || k == kHalvingsOfOffset) break;
      nearer = halve(crossing);
    }
    return crossing;
  }

  const Walks& walks() const { return walks_; }
  Curve& curve() { return curve_; }

  /// The strand whose walk a segment is of, and that walk's ways along it, from the first to before the last, counted
  /// on beyond its end where it is closed. Nothing of a strand that stays.
  struct Span {
    uint32_t strand;
    size_t first, last;
  };
  std::optional<Span> span_of(uint32_t segment) const {
    if (strand_of_[segment] == kNone) return std::nullopt;
    const uint32_t strand = strand_of_[segment];
    const Stop &a = stops_[segment], &b = stops_[curve_.next(segment)];
    return Span{strand, a.after, a.after + steps(*walks_[strand], a, b)};
  }

 private:
  static size_t steps(const Walk& walk, const Stop& a, const Stop& b) {
    if (!walk.closed) return b.after - a.after;
    const size_t count = walk.ways.size();
    return (b.after + count - a.after) % count;
  }
  /// Alike for the same stop of a walk in every laying.
  static size_t key(const Stop& stop) { return Stop::kMostStops * stop.after + stop.number; }

  /// Lays the strands out anew, as the shares of their corners are: `known_` and `old_` have what is as it was.
  void lay_out(const std::vector<uint8_t>& nearer) {
    std::swap(old_, curve_);
    std::swap(old_traces_, traces_);
    curve_ = {};
    stops_.clear();
    strand_of_.clear();
    was_.clear();
    for (uint32_t k = 0; k < walks_.size(); ++k) {
      const auto begin = static_cast<uint32_t>(strand_of_.size());
      if (!walks_[k]) {
        const Strand& strand = first_.strands[k];
        curve_.strands.push_back({begin, strand.count, strand.closed, strand.guide});
        stops_.resize(begin + strand.count);
        was_.resize(begin + strand.count, kNone);
        strand_of_.resize(begin + strand.count, kNone);
        continue;
      }
      const std::vector<Stop> stops = stops_of(*walks_[k], network_, ways_, offset_);
      for (const Stop& stop : stops) {
        uint32_t& known = known_[k][key(stop)];
        was_.push_back(known == kNone || nearer[known] ? kNone : known);
        known = static_cast<uint32_t>(stops_.size());
        stops_.push_back(stop);
        strand_of_.push_back(k);
      }
      curve_.strands.push_back({begin, static_cast<uint32_t>(stops.size()), walks_[k]->closed});
    }
    place();
    curve_.link();
  }

  void place() {
    const size_t count = stops_.size();
    curve_.nodes.resize(count);
    curve_.fixed.assign(count, 0);
    curve_.paths.resize(count);
    curve_.shapes.resize(count);
    traces_.assign(count, {});
    for (uint32_t i = 0; i < count; ++i) {
      if (strand_of_[i] == kNone) continue;
      const Stop& stop = stops_[i];
      curve_.fixed[i] = stop.fixed;
      if (was_[i] != kNone) {
        curve_.nodes[i] = old_.nodes[was_[i]];
        traces_[i] = std::move(old_traces_[was_[i]]);
        continue;
      }
      poll_();
      const SurfacePoint& from = network_.nodes()[stop.node].point;
      curve_.nodes[i] = from;
      if (stop.reach > 0) {
        curve_.nodes[i] = trace_geodesic(network_.surface(), from, stop.reach * stop.direction, traces_[i]).end;
      }
    }
  }

  /// Joins neighbours; the segments that are others than they were.
  Table<uint8_t> join() {
    Table<uint8_t> changed(curve_.size(), 0);
    for (uint32_t k = 0; k < walks_.size(); ++k) {
      const Strand& strand = curve_.strands[k];
      if (!walks_[k]) {
        const uint32_t from = first_.strands[k].first;
        for (uint32_t i = 0; i < strand.count; ++i) {
          const uint32_t to = strand.first + i;
          curve_.nodes[to] = first_.nodes[from + i];
          curve_.fixed[to] = first_.fixed[from + i];
          curve_.paths[to] = first_.paths[from + i];
          curve_.shapes[to] = first_.shapes[from + i];
        }
        continue;
      }
      for (uint32_t i = strand.first; i < strand.end(); ++i) {
        const uint32_t next = curve_.next(i);
        if (next == kNone) continue;
        if (was_[i] != kNone && was_[next] != kNone && old_.next(was_[i]) == was_[next]) {
          curve_.paths[i] = std::move(old_.paths[was_[i]]);
          curve_.shapes[i] = old_.shapes[was_[i]];
          continue;
        }
        changed[i] = 1;
        join(*walks_[k], i, next);
      }
    }
    return changed;
  }

  void join(const Walk& walk, uint32_t i, uint32_t next) {
    poll_();
    const Stop &a = stops_[i], &b = stops_[next];
    Path& path = curve_.paths[i];
    std::transform(traces_[i].rbegin(), traces_[i].rend(), std::back_inserter(path), reversed);
    const size_t count = steps(walk, a, b);
    for (size_t k = 0; k < count; ++k) ways_.append_to(path, walk.ways[(a.after + k) % walk.ways.size()]);
    path.insert(path.end(), traces_[next].begin(), traces_[next].end());
    curve_.shapes[i] = shortener_.shorten(curve_.nodes[i], curve_.nodes[next], path);
  }

  /// Halves the offset at both ends of what touches; the nodes of these corners.
  std::vector<uint8_t> halve(const Pairs& crossing) {
    std::vector<uint8_t> ends(curve_.size(), 0), nearer(curve_.size(), 0);
    for (const auto& [a, b] : crossing) {
      for (const uint32_t segment : {a, b}) ends[segment] = ends[curve_.next(segment)] = 1;
    }
    // The stops of a corner follow one another.
    for (uint32_t i = 0; i < curve_.size();) {
      uint32_t end = i + 1;
      while (end < curve_.size() && strand_of_[end] == strand_of_[i] && stops_[end].after == stops_[i].after) ++end;
      const bool any = std::find(ends.begin() + i, ends.begin() + end, uint8_t{1}) != ends.begin() + end;
      if (any && strand_of_[i] != kNone) {
        std::fill(nearer.begin() + i, nearer.begin() + end, uint8_t{1});
        if (stops_[i].after > 0) walks_[strand_of_[i]]->corners[stops_[i].after - 1].share /= 2;
      }
      i = end;
    }
    return nearer;
  }

  const LineNetwork& network_;
  const Ways& ways_;
  Walks walks_;
  double offset_;
  const Curve& first_;
  ThreadPool& pool_;
  PathShortener shortener_;
  CrossingTest test_;
  CancelToken poll_;
  Curve curve_, old_;                         // as it is, and as it was before
  std::vector<Stop> stops_;                   // per node
  std::vector<Path> traces_, old_traces_;     // per node: from its node of the tree to it
  std::vector<uint32_t> strand_of_;           // per node; kNone: of one that stays
  std::vector<uint32_t> was_;                 // per node: its index before, kNone: it is another one
  std::vector<std::vector<uint32_t>> known_;  // per walk and key: the node
};

/// Finds what is in the way of a laying.
class Blame {
 public:
  Blame(const LineNetwork& network, const Laying& laying)
      : network_(network), laying_(laying), place_(2 * network.edges().size(), kUnused) {
    for (const auto& walk : laying.walks()) {
      for (size_t k = 0; walk && k < walk->ways.size(); ++k) place_[walk->ways[k]] = k;
    }
  }

  /// For every pair of segments an edge beside one of them; where none can be taken out, the strands.
  void find(const Pairs& crossing, TreeTour& tour) const {
    for (const auto& [a, b] : crossing) {
      std::optional<Choice> best;
      for (size_t around = 0; around < 2 && !best; ++around) {
        for (const uint32_t segment : {a, b}) {
          if (const auto span = laying_.span_of(segment)) choose(*span, around, best);
        }
      }
      if (best) {
        tour.edges_in_the_way.push_back(best->edge);
        continue;
      }
      for (const uint32_t segment : {a, b}) {
        if (const auto span = laying_.span_of(segment)) tour.strands_in_the_way.push_back(span->strand);
      }
    }
    for (auto* list : {&tour.edges_in_the_way, &tour.strands_in_the_way}) {
      std::ranges::sort(*list);
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
  }

 private:
  static constexpr size_t kUnused = SIZE_MAX;
  /// Links before lines, since others may take their place; then what cuts off least.
  struct Choice {
    bool line;
    size_t cut_off;  // edges
    uint32_t edge;
    auto operator<=>(const Choice&) const = default;
  };

  /// Edges that the walk passes twice, once on each side: those of a trunk stay.
  void choose(const Laying::Span& span, size_t around, std::optional<Choice>& best) const {
    const Walk& walk = *laying_.walks()[span.strand];
    const size_t count = walk.ways.size();
    for (size_t k = span.first + count - around; k < span.last + count + around; ++k) {
      const Way way = walk.ways[k % count];
      const size_t here = place_[way], back = place_[Ways::twin(way)];
      if (back == kUnused) continue;
      const size_t inside = (std::max(here, back) - std::min(here, back) + 1) / 2;
      const LineNetwork::Edge& edge = network_.edges()[way / 2];
      const Choice choice{network_.nodes()[edge.from].line == network_.nodes()[edge.to].line,
                          walk.on_trunk ? inside : std::min(inside, count / 2 - inside + 1), way / 2};
      if (!best || choice < *best) best = choice;
    }
  }

  const LineNetwork& network_;
  const Laying& laying_;
  std::vector<size_t> place_;  // per way, in its walk
};

}  // namespace

TreeTour walk_round(const LineNetwork& network, const std::vector<LineTree>& trees, double offset, const Curve& first,
                    ThreadPool& pool) {
  CancelToken poll = pool.poll(kSegmentsPerPoll);
  const Ways ways(network);
  Walks walks(first.strands.size());
  for (const LineTree& tree : trees) {
    if (tree.trunk) {
      walks[tree.strand] = Walk::along_trunk(ways, *tree.trunk, poll);
    } else if (ways.any_at(tree.root)) {
      walks[tree.strand] = Walk::round_tree(ways, tree.root, poll);
    }
  }
  Laying laying(network, ways, std::move(walks), offset, first, pool);
  TreeTour tour;
  Blame(network, laying).find(laying.lay(), tour);
  tour.curve = std::move(laying.curve());
  return tour;
}

}  // namespace meander
