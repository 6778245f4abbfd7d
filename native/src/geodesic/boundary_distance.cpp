// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic/boundary_distance.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "base/point_tree.h"
#include "geodesic/constants.h"
#include "geodesic/marching.h"

namespace meander {
namespace {

/// Splits, and vertices that the front passes, from one poll to the next: a few hundred microseconds.
constexpr uint32_t kPiecesPerPoll = 256;

/// Points along the boundary, no more than `step` apart.
std::vector<Vec3> boundary_samples(const Surface& surface, double step, CancelToken poll) {
  std::vector<Vec3> samples;
  for (const HalfEdge e : surface.boundary()) {
    const Triangle& t = surface.face(face_of(e));
    const Vec3 from = surface.position(t[corner_of(e)]);
    const Vec3 along = surface.position(t[next_corner(corner_of(e))]) - from;
    const int pieces = static_cast<int>(std::min(kMostSamplesOfEdge, 1 + std::ceil(along.norm() / step)));
    for (int k = 0; k < pieces; ++k) {
      poll();
      samples.push_back(from + along * (double(k) / pieces));
    }
  }
  return samples;
}

}  // namespace

BoundaryDistance::BoundaryDistance(const Surface& surface, double reach, double edge,
                                   const CancelToken& cancel)
    : mesh_(surface, false) {
  caller_.reserve(surface.vertex_count());
  for (uint32_t v = 0; v < surface.vertex_count(); ++v) caller_.push_back(surface.caller_position(v));
  const PointTree boundary(boundary_samples(surface, edge, cancel.every(64 * kPiecesPerPoll)));
  refine(boundary, reach, edge, cancel);
  front_ = FrontSearch(AllNodes(mesh_.vertex_count()));
  march(reach + 2 * edge, cancel);
}

void BoundaryDistance::halve(HalfEdge h) {
  const Vec3 middle = mesh_.middle(h), callers = 0.5 * (caller_[mesh_.from(h)] + caller_[mesh_.to(h)]);
  caller_.push_back(callers);
  mesh_.split_edge(h, mesh_.add_vertex(middle), Vec2{}, Vec2{});
}

/// Longest edges first, so that an edge is the longest of its faces when it is split, and no angle becomes small
/// (Rivara, "Algorithms for refining triangular grids suitable for adaptive and multigrid techniques", 1984).
void BoundaryDistance::refine(const PointTree& boundary, double reach, double edge,
                              const CancelToken& cancel) {
  struct Long {
    double length;
    HalfEdge half;  // the first of the edge's two
    bool operator<(const Long& other) const {
      return length != other.length ? length < other.length : half > other.half;
    }
  };
  CancelToken poll = cancel.every(kPiecesPerPoll);
  std::priority_queue<Long> queue;
  const auto consider = [&](HalfEdge h) {
    const double length = mesh_.length(h);
    if (!(length > edge)) return;
    // A point of the edge is at most half its length from its middle; a sample, half a step from the boundary's.
    const double near = reach + 0.5 * (length + edge);
    if (boundary.any_within(mesh_.middle(h), near * near)) queue.push({length, h});
  };
  for (HalfEdge h = 0; h < mesh_.half_edge_count(); h += 2) {
    poll();
    consider(h);
  }
  while (!queue.empty()) {
    poll();
    const HalfEdge half = queue.top().half;
    queue.pop();
    const HalfEdge added = mesh_.half_edge_count();
    halve(half);
    consider(half);
    for (HalfEdge h = added; h < mesh_.half_edge_count(); h += 2) consider(h);
  }
}

void BoundaryDistance::march(double last, const CancelToken& cancel) {
  CancelToken poll = cancel.every(kPiecesPerPoll);
  for (HalfEdge h = 0; h < mesh_.half_edge_count(); ++h) {
    if (mesh_.face(h) == kNone) front_.offer(mesh_.from(h), 0);
  }
  while (const auto v = front_.next()) {
    poll();
    if (at(*v) > last) break;
    reach_from(mesh_, front_, *v, [&](HalfEdge, HalfEdge corner, HalfEdge other, bool passed) {
      const uint32_t c = mesh_.from(corner);
      const double along_edge = at(*v) + (mesh_.position(c) - mesh_.position(*v)).norm();
      front_.offer(c, passed ? across(*v, mesh_.from(other), c) : along_edge);
    });
  }
}

/// The distance at c of a straight front that reaches a and b when it does.
double BoundaryDistance::across(uint32_t a, uint32_t b, uint32_t c) const {
  const Vec3 u = mesh_.position(b) - mesh_.position(a), w = mesh_.position(c) - mesh_.position(a);
  const double by_edges = std::min(at(a) + w.norm(), at(b) + (w - u).norm());
  const FrontOverEdge front(u, w, at(a), at(b));
  if (!front.is_possible()) return by_edges;
  const double foot = front.foot();
  if (!(foot >= 0 && foot <= front.length)) return by_edges;
  return std::min(by_edges, front.distance());
}

}  // namespace meander
