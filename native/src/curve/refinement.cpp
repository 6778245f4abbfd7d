// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/refinement.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <new>
#include <numbers>

#include "base/close_growth.h"
#include "base/elementary.h"

namespace meander {
namespace {

/// Cuts a segment's path into `parts` of equal length: fills paths[0] to paths[parts - 1], and nodes[1] to
/// nodes[parts - 1] with where they begin. Returns how many there are; rounding may leave out the last cut.
uint32_t cut(const Surface& surface, const SurfacePoint& start, const SurfacePoint& end, const Path& path,
             double length, uint32_t parts, SurfacePoint* nodes, Path* paths) {
  paths[0].clear();
  double before = 0;
  uint32_t next_cut = 1;
  uint32_t face = start.face;
  Vec2 from = flat(surface, start);
  for (size_t k = 0; k <= path.size(); ++k) {
    const Vec2 to = k < path.size() ? flat_on_edge(surface, path[k]) : flat(surface, end);
    const double piece = norm(to - from);
    while (next_cut < parts && length * next_cut / parts <= before + piece) {
      const double t = piece > 0 ? (length * next_cut / parts - before) / piece : 0.5;
      nodes[next_cut] = point_at(surface, face, (1 - t) * from + t * to);
      paths[next_cut].clear();
      ++next_cut;
    }
    before += piece;
    if (k < path.size()) {
      paths[next_cut - 1].push_back(path[k]);
      const Crossing r = reversed(path[k]);
      face = face_of(r.e);
      from = flat_on_edge(surface, r);
    }
  }
  return next_cut;
}

}  // namespace

bool Refinement::refine(const Surface& surface, Curve& curve, const NodeData<double>& target, ThreadPool& pool,
                        NodeData<uint32_t>& origin, double most_turn) {
  least_cosine_ = most_turn < std::numbers::pi ? elementary::cos(most_turn) : -2;
  may_split_.assign(curve.size(), 1);
  may_remove_.assign(curve.size(), 1);
  while (propose(surface, curve, target, pool)) {
    const auto pairs = test_->find_changed(surface, next_, pool, changed_, [&](uint32_t i) -> const Path& {
      return changed_[i] ? new_paths_[source_[i]] : curve.paths[origin_[i]];
    });
    if (pairs.empty()) {
      accept(curve, pool);
      origin.swap(origin_);
      return true;
    }
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
  return false;
}

void Refinement::hand_on() noexcept {
  next_.hand_all_on();
  meander::hand_on(origin_, source_, changed_, may_split_, may_remove_);
  test_->hand_on();
}

/// May the node after i go? Not the strand's first one, which holds the list's place. There is a segment i.
bool Refinement::removes_next(const Curve& curve, const NodeData<double>& target, uint32_t i) const {
  const uint32_t j = curve.next(i);
  if (j <= i || !curve.has_segment(j) || curve.fixed[j] || !may_remove_[j]) return false;
  if (dot(curve.shapes[i].arriving, curve.shapes[j].leaving) < least_cosine_) return true;
  const double h = target[i], l = curve.shapes[i].length, l2 = curve.shapes[j].length;
  return std::min(l, l2) < h && l + l2 <= 2 * h;
}

/// Into how many parts segment i is to be split; 1 where it stays whole.
uint32_t Refinement::parts_of(const Curve& curve, const NodeData<double>& target, uint32_t i) const {
  const double h = target[i], l = curve.shapes[i].length;
  return l > 2 * h && may_split_[i] ? static_cast<uint32_t>(std::clamp(std::round(l / (1.5 * h)), 2.0, 1e6)) : 1;
}

/// Fills changes_ with what is to change, along the curve. All threads look for what could; of two nodes
/// in a row only the first may go, and that is found out in order. Most late iterations change little.
void Refinement::choose(const Curve& curve, const NodeData<double>& target, ThreadPool& pool) {
  candidates_.resize(ThreadPool::block_count(curve.size(), kNodeGrain));
  pool.for_blocks(curve.size(), kNodeGrain, [&](size_t block, size_t begin, size_t end) {
    candidates_[block].clear();
    for (auto i = static_cast<uint32_t>(begin); i < end; ++i) {
      if (!curve.has_segment(i)) continue;
      if (removes_next(curve, target, i) || parts_of(curve, target, i) > 1) candidates_[block].push_back(i);
    }
  });
  changes_.clear();
  uint32_t slots = 0;
  const auto change = [&](uint32_t from, uint32_t parts) {
    if (parts > UINT32_MAX - curve.size() - slots) throw std::bad_alloc();  // nodes could not be counted
    changes_.push_back({from, parts, slots, parts});
    slots += parts;
  };
  auto strand = curve.strands.begin();
  uint32_t left = strand == curve.strands.end() ? 0 : strand->count, removed = kNone;
  for (const std::vector<uint32_t>& block : candidates_) {
    for (const uint32_t i : block) {
      for (; i >= strand->end(); left = strand->count) ++strand;
      if (i == removed) continue;
      if (left > (strand->closed ? 3u : 2u) && removes_next(curve, target, i)) {
        removed = curve.next(i);
        --left;
        change(i, 1);
      } else if (const uint32_t parts = parts_of(curve, target, i); parts > 1) {
        change(i, parts);
      }
    }
  }
  new_nodes_.resize(slots);
  new_shapes_.resize(slots);
  new_paths_.resize(std::max<size_t>(new_paths_.size(), slots));
}

/// The segments that a change brings.
void Refinement::make(const Surface& surface, const Curve& curve, Change& change, PathShortener& shortener) {
  const uint32_t i = change.from, j = curve.next(i);
  SurfacePoint* const nodes = &new_nodes_[change.slot];
  Path* const paths = &new_paths_[change.slot];
  PathShape* const shapes = &new_shapes_[change.slot];
  if (change.removed()) {
    paths[0] = curve.paths[i];
    paths[0].insert(paths[0].end(), curve.paths[j].begin(), curve.paths[j].end());
    shapes[0] = shortener.shorten(curve.nodes[i], curve.nodes[curve.next(j)], paths[0]);
    return;
  }
  const uint32_t count = change.segments = cut(surface, curve.nodes[i], curve.nodes[j], curve.paths[i],
                                               curve.shapes[i].length, change.parts, nodes, paths);
  for (uint32_t p = 0; p < count; ++p) {
    shapes[p] = measure_path(surface, p > 0 ? nodes[p] : curve.nodes[i],
                             p + 1 < count ? nodes[p + 1] : curve.nodes[j], paths[p]);
  }
}

/// Finds where the nodes of the strands and of the changes come to be; fills next_.strands and places_, and returns
/// the number of nodes.
uint32_t Refinement::find_places(const Curve& curve) {
  places_.resize(changes_.size());
  next_.strands = curve.strands;
  uint32_t shift = 0;  // modulo 2^32
  size_t c = 0;
  for (Strand& strand : next_.strands) {
    const uint32_t end = strand.end(), before = shift;
    for (; c < changes_.size() && changes_[c].from < end; ++c) {
      places_[c] = changes_[c].from + shift;
      shift += changes_[c].added() - changes_[c].removed();
    }
    strand.first += before;
    strand.count += shift - before;
  }
  return curve.size() + shift;
}

void Refinement::put_node(uint32_t place, const SurfacePoint& node, uint8_t fixed, uint32_t origin) {
  next_.nodes[place] = node;
  next_.fixed[place] = fixed;
  origin_[place] = origin;
}

/// Puts what replaces segment change.from, without the node where it begins.
void Refinement::put_change(const Curve& curve, const Change& change, uint32_t place) {
  for (uint32_t p = 0; p < change.segments; ++p) {
    if (p > 0) put_node(place + p, new_nodes_[change.slot + p], curve.on_guide(change.from), change.from);
    source_[place + p] = change.slot + p;
    next_.shapes[place + p] = new_shapes_[change.slot + p];
    changed_[place + p] = 1;
  }
}

/// Puts the old nodes begin to end - 1 and the segments after them.
void Refinement::put_block(const Curve& curve, uint32_t begin, uint32_t end) {
  uint32_t i = begin;
  auto next = static_cast<size_t>(std::ranges::lower_bound(changes_, i, {}, &Change::from) - changes_.begin());
  // What comes before the next change is as far from its old place as that is.
  const auto place_of = [&](uint32_t node) {
    return next < changes_.size() ? places_[next] - (changes_[next].from - node)
                                  : next_.size() - (curve.size() - node);
  };
  if (next > 0 && changes_[next - 1].removed() && curve.next(changes_[next - 1].from) == i) ++i;
  while (i < end) {
    const uint32_t place = place_of(i);
    put_node(place, curve.nodes[i], curve.fixed[i], i);
    if (next < changes_.size() && changes_[next].from == i) {
      put_change(curve, changes_[next], place);
      i += 1 + changes_[next].removed();
      ++next;
      continue;
    }
    next_.shapes[place] = curve.shapes[i];
    changed_[place] = 0;
    ++i;
  }
}

/// Fills next_ with what stays and what is changed, but for the paths, which stay where they are.
void Refinement::lay_out(const Curve& curve, ThreadPool& pool) {
  const uint32_t count = find_places(curve);
  resize_closely(next_.nodes, count);
  resize_closely(next_.fixed, count);
  resize_closely(next_.paths, count);
  resize_closely(next_.shapes, count);
  origin_.resize(count);
  resize_closely(source_, count);
  resize_closely(changed_, count);
  pool.for_blocks(curve.size(), kNodeGrain, [&](size_t, size_t begin, size_t end) {
    put_block(curve, static_cast<uint32_t>(begin), static_cast<uint32_t>(end));
  });
  next_.link();
}

/// Takes the paths, of `curve` and of the changes, and puts next_ in the place of the curve. Nothing ends this on the
/// way, and what for_blocks would have to allocate is there before anything is taken.
void Refinement::accept(Curve& curve, const ThreadPool& pool) {
  const std::function<void(size_t, size_t, size_t)> take = [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      next_.paths[i].swap(changed_[i] ? new_paths_[source_[i]] : curve.paths[origin_[i]]);
    }
  };
  pool.with({}).for_blocks(next_.size(), kNodeGrain, take);
  std::swap(curve, next_);
}

/// Fills next_ with the refined curve, but for its paths; false if there is nothing to do.
bool Refinement::propose(const Surface& surface, const Curve& curve, const NodeData<double>& target, ThreadPool& pool) {
  choose(curve, target, pool);
  if (changes_.empty()) return false;
  constexpr size_t kChangesPerBlock = 16;
  pool.for_blocks(changes_.size(), kChangesPerBlock, [&](size_t, size_t begin, size_t end) {
    PathShortener shortener(surface);
    for (size_t c = begin; c < end; ++c) make(surface, curve, changes_[c], shortener);
  });
  lay_out(curve, pool);
  return true;
}

}  // namespace meander
