// SPDX-License-Identifier: GPL-3.0-or-later
#include "curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace meander::test {

bool same_bytes(const SurfacePoint& a, const SurfacePoint& b) {
  return a.face == b.face && a.b.x == b.b.x && a.b.y == b.b.y;
}

testing::AssertionResult chains(const Surface& s, uint32_t face, uint32_t last,
                                std::span<const Crossing> path) {
  for (size_t k = 0; k < path.size(); ++k) {
    if (path[k].e >= 3 * s.face_count()) {
      return testing::AssertionFailure() << "crossing " << k << " names no half-edge";
    }
    if (face_of(path[k].e) != face) {
      return testing::AssertionFailure()
             << "crossing " << k << " of " << path.size() << " leaves face " << face_of(path[k].e)
             << ", but the path is in face " << face;
    }
    if (!(path[k].t >= kClearance && path[k].t <= 1 - kClearance) || path[k].t != snap(path[k].t)) {
      return testing::AssertionFailure() << "crossing " << k << " is at the share " << path[k].t;
    }
    if (s.twin(path[k].e) == kNone) {
      return testing::AssertionFailure() << "crossing " << k << " leaves the surface";
    }
    if (path[k].twin != s.twin(path[k].e)) {
      return testing::AssertionFailure() << "crossing " << k << " does not know its twin";
    }
    face = face_of(path[k].twin);
  }
  if (face != last) {
    return testing::AssertionFailure()
           << "the path ends in face " << face << " instead of " << last;
  }
  return testing::AssertionSuccess();
}

testing::AssertionResult inside_face(const Surface& s, const SurfacePoint& p) {
  if (p.face < s.face_count() && p.b.x >= kClearance && p.b.y >= kClearance &&
      1 - p.b.x - p.b.y >= kClearance && p.b.x == snap(p.b.x) && p.b.y == snap(p.b.y)) {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure()
         << "face " << p.face << " weights " << p.weight(0) << " " << p.b.x << " " << p.b.y;
}

testing::AssertionResult whole(const Surface& s, const Curve& c) {
  const size_t n = c.nodes.size();
  if (c.fixed.size() != n || c.paths.size() != n || c.shapes.size() != n) {
    return testing::AssertionFailure() << "arrays differ in length";
  }
  uint32_t first = 0;
  for (const Strand& strand : c.strands) {
    if (strand.first != first) return testing::AssertionFailure() << "strands are not consecutive";
    if (strand.count < (strand.closed ? 3u : 2u))
      return testing::AssertionFailure() << "a strand is too short";
    first = strand.end();
    for (uint32_t k = 0; k < strand.count; ++k) {
      const uint32_t i = strand.first + k;
      const bool last = k + 1 == strand.count;
      const uint32_t j = !last ? i + 1 : (strand.closed ? strand.first : kNone);
      if (c.next(i) != j || (j != kNone && c.previous(j) != i)) {
        return testing::AssertionFailure() << "node " << i << " is linked wrongly";
      }
      if (auto r = inside_face(s, c.nodes[i]); !r) return r << " at node " << i;
      if (j == kNone) {
        if (!c.paths[i].empty()) return testing::AssertionFailure() << "a path after an open end";
        continue;
      }
      if (const auto r = chains(s, c.nodes[i].face, c.nodes[j].face, c.paths[i]); !r) {
        return testing::AssertionFailure() << "segment " << i << ": " << r.message();
      }
    }
  }
  if (first != n) return testing::AssertionFailure() << "strands do not cover the nodes";
  return testing::AssertionSuccess();
}

__extension__ typedef __int128 Int128;

int exact_sign(int64_t ax, int64_t ay, int64_t bx, int64_t by, int64_t cx, int64_t cy) {
  const Int128 d = Int128{bx - ax} * (cy - ay) - Int128{by - ay} * (cx - ax);
  return d > 0 ? 1 : (d < 0 ? -1 : 0);
}

bool exact_touch(const ExactPiece& p, const ExactPiece& q) {
  const auto on = [](const ExactPiece& s, int64_t x, int64_t y) {
    return exact_sign(s.ax, s.ay, s.bx, s.by, x, y) == 0 && std::min(s.ax, s.bx) <= x &&
           x <= std::max(s.ax, s.bx) && std::min(s.ay, s.by) <= y && y <= std::max(s.ay, s.by);
  };
  if (on(p, q.ax, q.ay) || on(p, q.bx, q.by) || on(q, p.ax, p.ay) || on(q, p.bx, p.by)) return true;
  return exact_sign(p.ax, p.ay, p.bx, p.by, q.ax, q.ay) *
                 exact_sign(p.ax, p.ay, p.bx, p.by, q.bx, q.by) <
             0 &&
         exact_sign(q.ax, q.ay, q.bx, q.by, p.ax, p.ay) *
                 exact_sign(q.ax, q.ay, q.bx, q.by, p.bx, p.by) <
             0;
}

namespace {

/// Whether the pieces share a point that is not a common node of their segments.
bool exact_crossing(const ExactPiece& p, const ExactPiece& q) {
  const auto beyond = [](int64_t cx, int64_t cy, int64_t px, int64_t py, int64_t qx, int64_t qy) {
    const Int128 along = Int128{px - cx} * (qx - cx) + Int128{py - cy} * (qy - cy);
    return exact_sign(cx, cy, px, py, qx, qy) == 0 && along > 0;
  };
  if (p.segment != q.segment) {
    if (p.to_node != kNone && p.to_node == q.from_node)
      return beyond(q.ax, q.ay, p.ax, p.ay, q.bx, q.by);
    if (q.to_node != kNone && q.to_node == p.from_node)
      return beyond(p.ax, p.ay, q.ax, q.ay, p.bx, p.by);
  }
  return exact_touch(p, q);
}

}  // namespace

std::set<std::pair<uint32_t, uint32_t>> exact_crossings(const Surface& s, const Curve& curve) {
  std::map<uint32_t, std::vector<ExactPiece>> faces;
  const auto whole_number = [](double x) {
    return static_cast<int64_t>(std::llround(std::ldexp(x, 50)));
  };
  constexpr int64_t kOne = int64_t{1} << 50;
  for (uint32_t i = 0; i < curve.size(); ++i) {
    const uint32_t j = curve.next(i);
    if (j == kNone) continue;
    const auto node = [&](const SurfacePoint& p) {
      return std::array{whole_number(p.b.x), whole_number(p.b.y)};
    };
    // Weights of corners 1 and 2 at a share of a half-edge.
    const auto share = [&](HalfEdge e, int64_t t) {
      std::array<int64_t, 3> w{0, 0, 0};
      w[e % 3] = kOne - t;
      w[(e % 3 + 1) % 3] = t;
      return std::array{w[1], w[2]};
    };
    std::array<int64_t, 2> at = node(curve.nodes[i]);
    uint32_t face = curve.nodes[i].face, from = i;
    for (const Crossing& c : curve.paths[i]) {
      const int64_t t = whole_number(c.t);
      const auto to = share(c.e, t);
      faces[face].push_back({at[0], at[1], to[0], to[1], i, from, kNone});
      from = kNone;
      const HalfEdge other = s.twin(c.e);
      face = other / 3;
      at = share(other, kOne - t);
    }
    const auto to = node(curve.nodes[j]);
    faces[face].push_back({at[0], at[1], to[0], to[1], i, from, j});
  }
  std::set<std::pair<uint32_t, uint32_t>> found;
  for (const auto& [face, pieces] : faces) {
    for (size_t a = 0; a < pieces.size(); ++a) {
      for (size_t b = a + 1; b < pieces.size(); ++b) {
        if (exact_crossing(pieces[a], pieces[b]))
          found.insert(std::minmax(pieces[a].segment, pieces[b].segment));
      }
    }
  }
  return found;
}

LocalMetric even_metric(const Curve& curve, double radius, double max_radius, double overhang,
                        double least_rest) {
  const auto all = [&](double value) { return NodeData<double>(curve.size(), value); };
  return {all(radius), all(max_radius), all(overhang), all(least_rest)};
}

void add_node(Curve& curve, const SurfacePoint& p, uint8_t fixed) {
  curve.nodes.push_back(p);
  curve.fixed.push_back(fixed);
  curve.paths.emplace_back();
  curve.shapes.emplace_back();
}

void join_in_face(const Surface& s, Curve& curve) {
  curve.link();
  for (uint32_t i = 0; i < curve.size(); ++i) {
    if (curve.next(i) != kNone)
      curve.shapes[i] = measure_path(s, curve.nodes[i], curve.nodes[curve.next(i)], {});
  }
}

bool add_ring(const Surface& s, Curve& curve, const SurfacePoint& centre, double radius,
              uint32_t count, double wobble, Rng& rng) {
  std::vector<SurfacePoint> ends;
  std::vector<Path> rays(count);
  for (uint32_t k = 0; k < count; ++k) {
    const double a = 2 * kPi * (k + 0.3 * wobble * rng.in(-1, 1)) / count;
    const double d = radius * (1 + wobble * rng.in(-1, 1));
    const Trace trace = trace_geodesic(s, centre, d * Vec2{std::cos(a), std::sin(a)}, rays[k]);
    if (trace.hit_boundary) return false;
    ends.push_back(trace.end);
  }
  const uint32_t first = curve.size();
  for (const SurfacePoint& p : ends) add_node(curve, p);
  curve.strands.push_back({first, count, true});
  curve.link();
  PathShortener shortener(s);
  for (uint32_t k = 0; k < count; ++k) {
    const uint32_t l = (k + 1) % count;
    Path& path = curve.paths[first + k];
    for (size_t c = rays[k].size(); c-- > 0;) path.push_back(reversed(rays[k][c]));
    path.insert(path.end(), rays[l].begin(), rays[l].end());
    curve.shapes[first + k] = shortener.shorten(ends[k], ends[l], path);
  }
  return true;
}

void add_walk(const Surface& s, Curve& curve, const SurfacePoint& start, double step,
              uint32_t count, double turn, Rng& rng) {
  const uint32_t first = curve.size();
  add_node(curve, start);
  Vec2 direction = rng.direction();
  PathShortener shortener(s);
  for (uint32_t k = 1; k < count; ++k) {
    Path path;
    Trace trace = trace_geodesic(s, curve.nodes.back(), step * rng.in(0.5, 1.5) * direction, path);
    if (trace.hit_boundary) {  // turn back from the boundary
      path.clear();
      trace = trace_geodesic(s, curve.nodes.back(), -0.3 * step * direction, path);
    }
    const SurfacePoint from = curve.nodes.back();
    curve.shapes.back() = shortener.shorten(from, trace.end, path);
    curve.paths.back() = std::move(path);
    add_node(curve, trace.end);
    const double a = rng.in(-turn, turn);
    direction = trace.direction * Vec2{std::cos(a), std::sin(a)};
  }
  curve.strands.push_back({first, count, false});
  curve.link();
}

}  // namespace meander::test
