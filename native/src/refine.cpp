// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine.h"

#include <algorithm>
#include <cmath>

namespace meander {
namespace {

/// The nodes that cut a segment's path into `parts` of equal length, and the paths between them.
struct Cut {
  std::vector<SurfacePoint> nodes;
  std::vector<Path> paths;
};

Cut cut(const Surface& surface, const SurfacePoint& start, const SurfacePoint& end, const Path& path,
        double length, int parts) {
  Cut result;
  result.paths.emplace_back();
  double before = 0;
  int next_cut = 1;
  uint32_t face = start.face;
  Vec2 from = flat(surface, start);
  for (size_t k = 0; k <= path.size(); ++k) {
    const Vec2 to = k < path.size() ? flat_on_edge(surface, path[k]) : flat(surface, end);
    const double piece = norm(to - from);
    while (next_cut < parts && length * next_cut / parts <= before + piece) {
      const double t = piece > 0 ? (length * next_cut / parts - before) / piece : 0.5;
      result.nodes.push_back(point_at(surface, face, (1 - t) * from + t * to));
      result.paths.emplace_back();
      ++next_cut;
    }
    before += piece;
    if (k < path.size()) {
      result.paths.back().push_back(path[k]);
      const Crossing r = reversed(path[k]);
      face = face_of(r.e);
      from = flat_on_edge(surface, r);
    }
  }
  return result;  // rounding may have left out the last cut; the caller uses what there is
}

}  // namespace

void Refinement::refine(const Surface& surface, Curve& curve, const std::vector<double>& target, Team& team,
                        std::vector<uint32_t>& origin) {
  may_split_.assign(curve.size(), 1);
  may_remove_.assign(curve.size(), 1);
  try {
    while (propose(surface, curve, target)) {
      const auto pairs = test_.find(surface, next_, team, &changed_);
      if (pairs.empty()) {
        std::swap(curve, next_);
        origin.swap(origin_);
        return;
      }
      give_back(curve);
      // Take back what lies between the old nodes around a crossing segment; the rest is proposed again.
      for (const auto& [a, b] : pairs) {
        for (const uint32_t segment : {a, b}) {
          if (!changed_[segment]) continue;
          const uint32_t first = origin_[segment], last = origin_[next_.next(segment)];
          may_split_[first] = 0;
          if (first == last) continue;  // between two cuts of one segment
          for (uint32_t i = curve.next(first); i != kNone && i != last && i != first; i = curve.next(i)) {
            may_split_[i] = 0;
            may_remove_[i] = 0;
          }
        }
      }
    }
  } catch (...) {
    give_back(curve);  // out of memory: the curve stays what it was
    throw;
  }
  origin.resize(curve.size());
  for (uint32_t i = 0; i < curve.size(); ++i) origin[i] = i;
}

/// May anything at all be split or removed? Most late iterations change nothing.
bool Refinement::any_change(const Curve& curve, const std::vector<double>& target) const {
  for (uint32_t i = 0; i < curve.size(); ++i) {
    const uint32_t j = curve.next(i);
    if (j == kNone) continue;
    const double l = curve.shapes[i].length, h = target[i];
    if (l > 2 * h && may_split_[i]) return true;
    if (!curve.has_segment(j) || curve.fixed[j] || !may_remove_[j]) continue;
    const double l2 = curve.shapes[j].length;
    if (std::min(l, l2) < h && l + l2 <= 2 * h) return true;
  }
  return false;
}

/// Returns the paths of unchanged segments to the curve.
void Refinement::give_back(Curve& curve) {
  for (uint32_t i = 0; i < changed_.size(); ++i) {
    if (!changed_[i] && !next_.paths[i].empty()) curve.paths[origin_[i]].swap(next_.paths[i]);
  }
}

/// Fills next_ with the refined curve; false if there is nothing to do. The paths of segments that do
/// not change are moved there, not copied: give_back() undoes it.
bool Refinement::propose(const Surface& surface, Curve& curve, const std::vector<double>& target) {
  if (!any_change(curve, target)) return false;
  next_.nodes.clear();
  next_.fixed.clear();
  next_.strands.clear();
  next_.shapes.clear();  // paths keep their memory; they are taken again one by one
  origin_.clear();
  changed_.clear();
  bool any = false;
  PathShortener shortener(surface);
  const auto add = [&](const SurfacePoint& node, uint8_t fixed, uint32_t from) {
    const size_t index = next_.nodes.size();
    next_.nodes.push_back(node);
    next_.fixed.push_back(fixed);
    if (index < next_.paths.size()) {
      next_.paths[index].clear();
    } else {
      next_.paths.emplace_back();
    }
    next_.shapes.emplace_back();
    origin_.push_back(from);
    changed_.push_back(0);
  };
  const auto last_path = [&]() -> Path& { return next_.paths[next_.nodes.size() - 1]; };
  for (const Strand& strand : curve.strands) {
    const uint32_t first_new = next_.size();
    uint32_t left = strand.count;
    const uint32_t least = strand.closed ? 3 : 2;
    add(curve.nodes[strand.first], curve.fixed[strand.first], strand.first);
    for (uint32_t k = 0; k < strand.segment_count();) {
      const uint32_t i = strand.first + k;
      const uint32_t j = curve.next(i);
      const double h = target[i];
      const double l = curve.shapes[i].length;
      // Remove j (not the strand's first node, which holds the list's place) and join i to the next.
      const bool inner = j != strand.first && curve.has_segment(j);
      if (inner && !curve.fixed[j] && may_remove_[j] && left > least) {
        const double l2 = curve.shapes[j].length;
        if (std::min(l, l2) < h && l + l2 <= 2 * h) {
          const uint32_t after = curve.next(j);
          Path path = curve.paths[i];
          path.insert(path.end(), curve.paths[j].begin(), curve.paths[j].end());
          next_.shapes.back() = shortener.shorten(curve.nodes[i], curve.nodes[after], path);
          last_path() = std::move(path);
          changed_.back() = 1;
          any = true;
          --left;
          k += 2;
          if (after != strand.first) add(curve.nodes[after], curve.fixed[after], after);
          continue;
        }
      }
      const int parts =
          l > 2 * h && may_split_[i] ? static_cast<int>(std::clamp(std::round(l / (1.5 * h)), 2.0, 1e6)) : 1;
      if (parts == 1) {
        next_.shapes.back() = curve.shapes[i];
        last_path().swap(curve.paths[i]);
      } else {
        any = true;
        Cut pieces = cut(surface, curve.nodes[i], curve.nodes[j], curve.paths[i], l, parts);
        for (size_t p = 0; p < pieces.paths.size(); ++p) {
          const SurfacePoint from = next_.nodes.back();
          const SurfacePoint to = p < pieces.nodes.size() ? pieces.nodes[p] : curve.nodes[j];
          next_.shapes.back() = measure_path(surface, from, to, pieces.paths[p]);
          last_path() = std::move(pieces.paths[p]);
          changed_.back() = 1;
          if (p < pieces.nodes.size()) add(to, strand.guide, i);
        }
      }
      ++k;
      if (j != strand.first) add(curve.nodes[j], curve.fixed[j], j);
    }
    next_.strands.push_back({first_new, next_.size() - first_new, strand.closed, strand.guide});
  }
  next_.paths.resize(next_.nodes.size());
  if (any) {
    next_.link();
  } else {
    give_back(curve);
  }
  return any;
}

}  // namespace meander
