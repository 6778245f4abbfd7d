// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/invariant.h"

#include <cmath>
#include <cstring>

namespace meander {
namespace {

bool is_inside(const Surface& surface, const SurfacePoint& p) {
  // Written so that NaN fails.
  return p.face < surface.face_count() && p.b.x > 0 && p.b.y > 0 && 1 - p.b.x - p.b.y > 0;
}

bool same_place(const SurfacePoint& p, const SurfacePoint& q) {
  return p.face == q.face && p.b.x == q.b.x && p.b.y == q.b.y;
}

/// The first fixed node from i on; the size of the curve: there is none.
size_t next_fixed(const Curve& curve, size_t i) {
  if (i >= curve.fixed.size()) return curve.size();
  const void* found = std::memchr(curve.fixed.data() + i, 1, curve.fixed.size() - i);
  return found ? static_cast<size_t>(static_cast<const uint8_t*>(found) - curve.fixed.data()) : curve.size();
}

bool fixed_nodes_are_kept(const Curve& before, const Curve& after) {
  size_t old = next_fixed(before, 0), now = next_fixed(after, 0);
  while (old < before.size() && now < after.size()) {
    if (!same_place(before.nodes[old], after.nodes[now])) return false;
    old = next_fixed(before, old + 1);
    now = next_fixed(after, now + 1);
  }
  return old >= before.size() && now >= after.size();
}

bool strands_are_kept(const Curve& before, const Curve& after) {
  if (before.strands.size() != after.strands.size()) return false;
  size_t first = 0;
  for (size_t s = 0; s < after.strands.size(); ++s) {
    const Strand &old = before.strands[s], &now = after.strands[s];
    if (now.closed != old.closed || now.guide != old.guide) return false;
    if (now.first != first || now.count < (now.closed ? 3u : 2u)) return false;
    first += now.count;
  }
  return first == after.size() && after.fixed.size() == first && after.paths.size() == first &&
         after.shapes.size() == first;
}

bool path_is_whole(const Curve& curve, uint32_t i) {
  uint32_t face = curve.nodes[i].face;
  for (const Crossing& c : curve.paths[i]) {
    if (face_of(c.e) != face || c.twin == kNone || !(c.t > 0 && c.t < 1)) return false;
    face = face_of(c.twin);
  }
  return face == curve.nodes[curve.next(i)].face;
}

}  // namespace

std::string broken_promise(const Surface& surface, const Curve& before, const Curve& after, size_t turn,
                           ThreadPool& pool) {
  if (!strands_are_kept(before, after)) return "a strand would have been opened, closed or lost";
  if (!fixed_nodes_are_kept(before, after)) return "a fixed point would have moved";
  const auto any = [&](size_t count, const auto& wrong) { return pool.first(count, kNodeGrain, wrong) < count; };
  const size_t n = after.size();
  if (any(n, [&](size_t i) { return !is_inside(surface, after.nodes[i]); })) return "a point would have left its face";
  const auto endless = [&](size_t i) {
    return after.has_segment(static_cast<uint32_t>(i)) && !std::isfinite(after.shapes[i].length);
  };
  if (any(n, endless)) return "a length would have been no number";
  const size_t first = turn % kPathTurns;
  const auto broken = [&](size_t k) {
    const auto node = static_cast<uint32_t>(first + k * kPathTurns);
    return after.has_segment(node) && !path_is_whole(after, node);
  };
  if (n > first && any((n - first - 1) / kPathTurns + 1, broken)) return "a piece would have left the surface";
  return {};
}

}  // namespace meander
