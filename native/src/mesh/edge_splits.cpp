// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "base/point_grid.h"
#include "mesh/constants.h"
#include "mesh/repairs.h"
#include "mesh/seams.h"
#include "mesh/sheets.h"

namespace meander {
namespace {

using Vec3 = Eigen::Vector3d;

class SplitSearch {
 public:
  explicit SplitSearch(const FaceBoundary& boundary)
      : boundary_(boundary), faces_(boundary.faces), positions_(boundary.positions),
        distance_(boundary.farthest), poll_(boundary.poll) {
    // The boundary edges at each vertex, by a counting sort.
    std::vector<uint32_t> end(positions_.size() + 1, 0);
    double length = 0;
    for (const uint32_t side : boundary.half_edges) {
      poll_();
      const uint32_t a = from(faces_, side), b = to(faces_, side);
      ++end[a + 1];
      ++end[b + 1];
      length += (positions_[b] - positions_[a]).norm();
    }
    cell_ = std::max({length / static_cast<double>(boundary.half_edges.size()), distance_, 1e-6 * boundary.extent});
    for (size_t v = 0; v < positions_.size(); ++v) end[v + 1] += end[v];
    sides_.resize(end.back());
    for (const uint32_t side : boundary.half_edges) {
      poll_();
      for (const uint32_t v : {from(faces_, side), to(faces_, side)}) sides_[end[v]++] = side;
    }
    end_ = std::move(end);
  }

  std::vector<EdgeSplit> all() {
    std::vector<EdgeSplit> found;
    if (!(cell_ > 0)) return found;
    const PointGrid grid(boundary_.points, cell_, poll_);
    for (const uint32_t side : boundary_.half_edges) {
      const size_t first = found.size();
      find_on(side, grid, found);
      std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(),
                [](const EdgeSplit& a, const EdgeSplit& b) { return a.t != b.t ? a.t < b.t : a.vertex < b.vertex; });
      drop_crowded(side, first, found);
    }
    return found;
  }

 private:
  void find_on(uint32_t side, const PointGrid& grid, std::vector<EdgeSplit>& found) {
    const uint32_t a = from(faces_, side), b = to(faces_, side), c = apex(faces_, side);
    const Vec3 origin = positions_[a], edge = positions_[b] - origin, shift = positions_[boundary_.vertices[0]];
    const double length = edge.norm();
    const auto steps = static_cast<size_t>(std::ceil(length / cell_));
    for (size_t i = 0; i < steps; ++i) {  // a tube around the edge, in balls
      poll_(256);
      const double begin = static_cast<double>(i) / static_cast<double>(steps);
      const double end = static_cast<double>(i + 1) / static_cast<double>(steps);
      const Vec3 middle = origin + 0.5 * (begin + end) * edge - shift;
      grid.near(middle, 0.5 * (end - begin) * length + distance_, [&](uint32_t j, double) {
        const uint32_t v = boundary_.vertices[j];
        if (v == a || v == b || v == c) return;
        const double t = (positions_[v] - origin).dot(edge) / (length * length);
        if (!(t >= begin && t < end)) return;
        if (!((positions_[v] - origin - t * edge).norm() <= boundary_.reach[j])) return;
        // At its ends an edge is joined to others as a seam.
        if (t * length <= distance_ || (1 - t) * length <= distance_) return;
        if (continues_along(side, v, t)) found.push_back({side, t, v});
      });
    }
  }

  /// Does a boundary edge at the vertex run along the edge, with a face that continues that of the edge?
  bool continues_along(uint32_t side, uint32_t v, double t) const {
    const uint32_t a = from(faces_, side), b = to(faces_, side);
    const Vec3 origin = positions_[a], edge = positions_[b] - origin;
    const double length = edge.norm();
    for (uint32_t k = v == 0 ? 0 : end_[v - 1]; k < end_[v]; ++k) {
      const uint32_t other = sides_[k];
      if (other / 3 == side / 3) continue;
      const bool leaves = from(faces_, other) == v;
      const Vec3 along = positions_[leaves ? to(faces_, other) : from(faces_, other)] - positions_[v];
      const double rise = along.dot(edge) / (length * length);  // of t
      if (rise == 0) continue;
      // As far as both run beside each other.
      const double share = std::min(1.0, (rise > 0 ? 1 - t : -t) / rise);
      const Vec3 there = positions_[v] + share * along;
      const double place = t + share * rise;
      if (!((there - origin - place * edge).norm() <= distance_)) continue;
      if (!(std::abs(share * rise) * length > distance_)) continue;
      const bool same_way = (rise > 0) == leaves;
      const double turn = turn_at_edge(positions_, {a, b}, apex(faces_, side), apex(faces_, other));
      if (turn < (same_way ? 1 : kOnEachOther)) return true;
    }
    return false;
  }

  /// Keeps one of vertices that lie in one place: the others are joined to it as seams are.
  void drop_crowded(uint32_t side, size_t first, std::vector<EdgeSplit>& found) const {
    const double length = (positions_[to(faces_, side)] - positions_[from(faces_, side)]).norm();
    size_t kept = first;
    for (size_t i = first; i < found.size(); ++i) {
      if (kept > first && (found[i].t - found[kept - 1].t) * length <= distance_) continue;
      found[kept++] = found[i];
    }
    found.resize(kept);
  }

  const FaceBoundary& boundary_;
  std::span<const Triangle> faces_;
  std::span<const Vec3> positions_;
  double distance_;
  CancelToken poll_;
  std::vector<uint32_t> end_, sides_;  // the boundary edges at vertex v end at end_[v]
  double cell_ = 0;
};

/// Replaces face f by those of a ring of places on its edges, which begins with corner 0; `one` and `two` are where in
/// it the other corners are.
void divide(Soup& soup, uint32_t f, const std::vector<Soup::WeightedVertex>& ring, size_t one, size_t two) {
  const Soup::Face face = soup.face(f);
  const size_t n = ring.size();
  bool first = true;
  const auto fan = [&](size_t tip, size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) {
      const Soup::Face part = soup.part(face, ring[tip], ring[k], ring[k + 1 == n ? 0 : k + 1]);
      if (first) {
        soup.set_face(f, part);
      } else {
        soup.add_face(part);
      }
      first = false;
    }
  };
  if (one > 1) {
    // Corner 0, its neighbour on edge 0, and edge 2; from corner 2 over the rest of edge 0 but its last piece; the
    // vertex before corner 1, and edge 1.
    fan(1, two, n);
    fan(two, 1, one - 1);
    fan(one - 1, one, two);
  } else if (two == 2) {
    fan(1, 2, n);  // all on edge 2
  } else {
    // Edge 1 as a fan from corner 0, whose last triangle has edge 2.
    fan(0, 1, two - 1);
    fan(two - 1, two, n);
  }
}

}  // namespace

std::vector<EdgeSplit> find_edge_splits(const FaceBoundary& boundary) {
  if (boundary.half_edges.empty()) return {};
  return SplitSearch(boundary).all();
}

bool split_edges(Soup& soup, double distance, PrepareCounts& counts) {
  const std::vector<EdgeSplit> splits = find_edge_splits(FaceBoundary(soup, distance));
  // Of each face the splits of its three edges, which are neighbours in the list.
  for (size_t i = 0; i < splits.size();) {
    const uint32_t f = splits[i].side / 3;
    const Soup::Face face = soup.face(f);
    std::vector<Soup::WeightedVertex> ring;  // from corner 0 of the face, all around it
    size_t corner[3];
    for (uint32_t k = 0; k < 3; ++k) {
      const Soup::WeightedVertex here = soup.place(face, k), next = soup.place(face, (k + 1) % 3);
      corner[k] = ring.size();
      ring.push_back(here);
      counts.split_edges += i < splits.size() && splits[i].side == 3 * f + k;
      for (; i < splits.size() && splits[i].side == 3 * f + k; ++i) {
        ring.push_back(Soup::between(here, next, splits[i].t, splits[i].vertex));
      }
    }
    divide(soup, f, ring, corner[1], corner[2]);
  }
  return !splits.empty();
}

}  // namespace meander
