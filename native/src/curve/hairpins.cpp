// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/hairpins.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "curve/constants.h"
#include "curve/curvature.h"

namespace meander {
namespace {

/// Arc length along a strand, in units of the local r, and turning up to a node. A closed strand has no end,
/// so nodes are numbered before the first and after the last as well.
class Course {
 public:
  /// `turns`  at all nodes of the curve
  Course(const Curve& curve, const Strand& strand, const LocalMetric& metric, const NodeData<double>& turns,
         ThreadPool& pool)
      : closed_(strand.closed), count_(strand.count), arc_length_(strand.count + 1, 0), turn_(strand.count + 1, 0) {
    pool.for_each(strand.count, kNodeGrain, [&](uint32_t k) {
      const uint32_t i = strand.first + k;
      if (curve.has_segment(i)) arc_length_[k + 1] = curve.shapes[i].length / metric.radius[i];
      turn_[k + 1] = turns[i];
    });
    std::partial_sum(arc_length_.begin(), arc_length_.end(), arc_length_.begin());
    std::partial_sum(turn_.begin(), turn_.end(), turn_.begin());
  }

  int64_t begin() const { return closed_ ? -count_ : 0; }
  int64_t end() const { return closed_ ? 2 * count_ : count_; }
  double total() const { return arc_length_[static_cast<size_t>(count_)]; }
  double arc_length(int64_t k) const { return at(arc_length_, k); }
  /// Sum of the turns at the nodes before k.
  double turn(int64_t k) const { return at(turn_, k); }

  /// The first node at or after this place.
  int64_t first_after(double place) const {
    int64_t low = begin(), high = end();
    while (low < high) {
      const int64_t middle = low + (high - low) / 2;
      if (arc_length(middle) < place) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    return low;
  }

 private:
  double at(const std::vector<double>& sums, int64_t k) const {
    if (k == count_) return sums[static_cast<size_t>(k)];
    const int64_t rounds = k < 0 ? -1 : k / count_;
    return sums[static_cast<size_t>(k - rounds * count_)] + static_cast<double>(rounds) * sums.back();
  }

  bool closed_;
  int64_t count_;
  std::vector<double> arc_length_, turn_;
};

std::vector<Hairpin> find(const Course& course, const Strand& strand, ThreadPool& pool) {
  // Turning within half a window to both sides of every node.
  std::vector<double> turning(strand.count);
  pool.for_blocks(strand.count, kNodeGrain, [&](size_t, size_t begin, size_t end) {
    const double start = course.arc_length(static_cast<int64_t>(begin));
    int64_t first = course.first_after(start - kHairpinWindow / 2), last = first;
    for (auto k = static_cast<int64_t>(begin); k < static_cast<int64_t>(end); ++k) {
      const double place = course.arc_length(k);
      while (first < k && course.arc_length(first) < place - kHairpinWindow / 2) ++first;
      while (last < course.end() && course.arc_length(last) < place + kHairpinWindow / 2) ++last;
      turning[static_cast<size_t>(k)] = course.turn(last) - course.turn(first);
    }
  });
  std::vector<Hairpin> hairpins;
  const auto at = [&](int64_t k) { return turning[static_cast<size_t>(k % strand.count)]; };
  for (int64_t k = 0; k < strand.count; ++k) {
    const int side = at(k) > 0 ? 1 : -1;
    const auto turns = [&](int64_t j) { return side * at(j) >= kHairpinTurn; };
    const bool has_before = strand.closed || k > 0;
    if (!turns(k) || (has_before && turns(k + strand.count - 1))) continue;
    int64_t end = k;
    while (end < (strand.closed ? k + strand.count : int64_t{strand.count}) && turns(end)) ++end;
    hairpins.push_back({0.5 * (course.arc_length(k) + course.arc_length(end - 1)), side});
  }
  return hairpins;
}

}  // namespace

std::vector<Hairpin> find_hairpins(const Curve& curve, const Strand& strand,
                                   const LocalMetric& metric, ThreadPool& pool) {
  return find(Course(curve, strand, metric, turns_at_nodes(curve, pool), pool), strand, pool);
}

NodeData<uint8_t> mark_short_runs(const Curve& curve, const LocalMetric& metric, double share,
                                     ThreadPool& pool) {
  struct Run {
    size_t strand;
    double from, to;
  };
  const NodeData<double> turns = turns_at_nodes(curve, pool);
  std::vector<Run> runs;
  std::vector<Course> courses;
  for (size_t s = 0; s < curve.strands.size(); ++s) {
    const Strand& strand = curve.strands[s];
    courses.emplace_back(curve, strand, metric, turns, pool);
    const std::vector<Hairpin> hairpins = find(courses.back(), strand, pool);
    for (size_t h = 0; h < hairpins.size(); ++h) {
      const bool wraps = h + 1 == hairpins.size();
      if (wraps && (!strand.closed || hairpins.size() < 2)) continue;
      const Hairpin& next = hairpins[wraps ? 0 : h + 1];
      if (next.side == hairpins[h].side) continue;
      runs.push_back({s, hairpins[h].at, next.at + (wraps ? courses.back().total() : 0)});
    }
  }
  const auto chosen = static_cast<size_t>(share * static_cast<double>(runs.size()));
  std::stable_sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.to - a.from < b.to - b.from; });
  runs.resize(chosen);

  NodeData<uint8_t> marked(curve.size(), 0);
  for (const Run& run : runs) {
    const Strand& strand = curve.strands[run.strand];
    const Course& course = courses[run.strand];
    // Never more than once round.
    const int64_t begin = course.first_after(run.from - kHairpinMargin);
    const int64_t end = std::min(course.first_after(run.to + kHairpinMargin), begin + strand.count);
    for (int64_t k = begin; k < end; ++k) {
      marked[strand.first + static_cast<size_t>((k + strand.count) % strand.count)] = 1;
    }
  }
  return marked;
}

}  // namespace meander
