// SPDX-License-Identifier: GPL-3.0-or-later
//
// Curves in which some splits and collapses would make segments cross.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "curve/refinement.h"
#include "curves.h"

namespace meander::test {

/// A curve to be refined, and what has to come of it.
struct Blocked {
  Curve curve;
  NodeData<double> target;
  std::vector<uint32_t> origin;         // of the refined curve
  std::vector<SurfacePoint> new_nodes;  // its nodes
  size_t count = 0;                     // changes that are blocked
};

/// An open strand between two points of face 0, which is left as it is.
inline void add_needle(const Surface& s, Blocked& b, Vec2 from, Vec2 to) {
  const uint32_t first = b.curve.size();
  add_node(b.curve, {0, from});
  add_node(b.curve, {0, to});
  b.curve.strands.push_back({first, 2, false});
  b.curve.link();
  b.curve.shapes[first] = measure_path(s, b.curve.nodes[first], b.curve.nodes[first + 1], {});
  b.target.resize(b.curve.size(), b.curve.shapes[first].length);
}

/// A segment over an edge, which stays as it is, an open strand, a closed one, and a ring over several faces, on the
/// octahedron. All segments of the second and the third strand are to be split into `parts`; where blocked(i) holds for
/// the i-th of their nodes, 0 to 11, and rounding puts the k-th cut of the segment after it beside that, a needle ends
/// in that point. Points of cuts are those of a curve without needles.
template <class IsBlocked>
Blocked blocked_splits(const Surface& s, uint32_t parts, uint32_t k, const IsBlocked& blocked) {
  Blocked b;
  Rng rng(parts);
  const auto in_face = [&](double x, double y) {
    return make_point(0, 1 - x - y, x + rng.in(-0.01, 0.01), y + rng.in(-0.01, 0.01));
  };
  HalfEdge e = 3 * 2;
  while (face_of(s.twin(e)) != 3) ++e;
  for (const uint32_t face : {2u, 3u}) add_node(b.curve, make_point(face, 1, 1, 1));
  constexpr uint32_t kFirst = 2, kEnd = kFirst + 12;
  for (int i = 0; i < 6; ++i) add_node(b.curve, in_face(0.07 + 0.12 * i, 0.15), i == 2);
  for (int i = 0; i < 6; ++i) add_node(b.curve, in_face(0.25 + 0.12 * std::cos(i), 0.5 + 0.12 * std::sin(i)), i == 3);
  b.curve.strands = {{0, 2, false}, {kFirst, 6, false}, {kFirst + 6, 6, true}};
  join_in_face(s, b.curve);
  b.curve.paths[0] = {crossing_of(s, e, 0.5)};
  b.curve.shapes[0] = measure_path(s, b.curve.nodes[0], b.curve.nodes[1], b.curve.paths[0]);
  b.target.resize(kEnd, b.curve.shapes[0].length);
  for (uint32_t i = kFirst; i < kEnd; ++i) b.target[i] = b.curve.shapes[i].length / (1.5 * parts);
  EXPECT_TRUE(add_ring(s, b.curve, make_point(6, 1, 1, 1), 0.15, 40, 0.2, rng));
  b.target.resize(b.curve.size(), 0.022);

  Curve cut = b.curve;
  NodeData<uint32_t> origin;
  ThreadPool pool(1);
  EXPECT_TRUE(Refinement().refine(s, cut, b.target, pool, origin));
  const uint32_t count = b.curve.size();
  for (uint32_t n = 0; n < cut.size(); ++n) {
    const uint32_t i = origin[n];
    b.origin.push_back(i);
    b.new_nodes.push_back(cut.nodes[n]);
    const bool is_new = n > 0 && origin[n - 1] == i;
    if (is_new || i < kFirst || i >= kEnd || !b.curve.has_segment(i) || !blocked(i - kFirst)) continue;
    const Vec2 from = b.curve.nodes[i].b, along = b.curve.nodes[b.curve.next(i)].b - from, tip = cut.nodes[n + k].b;
    const int side = orientation(from, b.curve.nodes[b.curve.next(i)].b, tip);
    if (side == 0) continue;
    add_needle(s, b, tip, {snap(tip.x - 0.05 * side * along.y), snap(tip.y + 0.05 * side * along.x)});
    ++b.count;
    while (n + 1 < cut.size() && origin[n + 1] == i) ++n;
  }
  for (uint32_t i = count; i < b.curve.size(); ++i) {
    b.origin.push_back(i);
    b.new_nodes.push_back(b.curve.nodes[i]);
  }
  return b;
}

/// A strand with a bend at every other node, all of which are to go: open, or closed round a middle. Where held(i)
/// holds for node i, which is in a bend, a needle reaches into that, so that the node has to stay; the one after it may
/// then go instead. Where `long_after` is set the segment after a held node is longer than it may be.
template <class IsHeld>
Blocked blocked_collapses(const Surface& s, bool closed, bool long_after, const IsHeld& held) {
  Blocked b;
  constexpr uint32_t kNodes = 12;
  const auto place = [&](uint32_t i, double out) {
    if (!closed) return Vec2{snap(0.1 + 0.05 * i), snap(0.28 + out)};
    const double angle = 2 * kPi * i / kNodes;
    return Vec2{snap(0.33 + (0.2 + out) * std::cos(angle)), snap(0.33 + (0.2 + out) * std::sin(angle))};
  };
  for (uint32_t i = 0; i < kNodes; ++i) add_node(b.curve, {0, place(i, i % 2 ? 0.03 : 0)});
  b.curve.strands = {{0, kNodes, closed}};
  join_in_face(s, b.curve);
  b.target.resize(kNodes);
  for (uint32_t i = 0; i < kNodes; ++i) {
    const double l = b.curve.shapes[i].length;
    b.target[i] = long_after && held(i) ? l / 3 : 1.01 * std::max(l, b.curve.shapes[(i + 1) % kNodes].length);
  }
  for (uint32_t i = 0; i < kNodes; ++i) {
    b.origin.push_back(i);
    const bool may_go = i + 1 < kNodes && (closed || i + 2 < kNodes) && !held(i + 1) && !(long_after && held(i));
    if (may_go) ++i;
  }
  for (uint32_t i = 0; i < kNodes; ++i) {
    if (!held(i)) continue;
    b.origin.insert(b.origin.end(), {b.curve.size(), b.curve.size() + 1});
    add_needle(s, b, place(i, 0.01), place(i, -0.15));
    ++b.count;
  }
  for (const uint32_t i : b.origin) b.new_nodes.push_back(b.curve.nodes[i]);
  return b;
}

}  // namespace meander::test
