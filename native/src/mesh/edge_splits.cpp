// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/edge_splits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/point_grid.h"
#include "mesh/seams.h"
#include "mesh/sheets.h"

namespace meander {
namespace {

class SplitSearch {
 public:
  using Point = Eigen::Vector3d;

  SplitSearch(std::span<const Point> positions, std::span<const Triangle> faces, std::span<const uint32_t> boundary,
              double distance)
      : positions_(positions), faces_(faces), boundary_(boundary), distance_(distance) {}

  std::vector<EdgeSplit> all() {
    collect();
    std::vector<EdgeSplit> found;
    if (!(cell_ > 0)) return found;
    const PointGrid grid(points_, cell_);
    for (const uint32_t side : boundary_) {
      const size_t first = found.size();
      find_on(side, grid, found);
      std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(),
                [](const EdgeSplit& a, const EdgeSplit& b) { return a.t != b.t ? a.t < b.t : a.vertex < b.vertex; });
      drop_crowded(side, first, found);
    }
    return found;
  }

 private:
  uint32_t corner(uint32_t side, uint32_t k) const { return faces_[side / 3][(side % 3 + k) % 3]; }

  /// The vertices of the boundary with the boundary edges at each, and how near to an edge each has to be.
  void collect() {
    double length = 0, extent = 0;
    std::vector<std::pair<uint32_t, uint32_t>> ends;
    for (const uint32_t side : boundary_) {
      const uint32_t a = corner(side, 0), b = corner(side, 1);
      ends.emplace_back(a, side);
      ends.emplace_back(b, side);
      length += (positions_[b] - positions_[a]).norm();
    }
    std::sort(ends.begin(), ends.end());
    std::vector<double> shortest(positions_.size(), std::numeric_limits<double>::infinity());
    for (const Triangle& t : faces_) {
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t a = t[k], b = t[(k + 1) % 3];
        const double edge = (positions_[a] - positions_[b]).norm();
        shortest[a] = std::min(shortest[a], edge);
        shortest[b] = std::min(shortest[b], edge);
      }
    }
    for (size_t i = 0; i < ends.size(); ++i) {
      if (i == 0 || ends[i].first != ends[i - 1].first) {
        vertices_.push_back(ends[i].first);
        first_side_.push_back(static_cast<uint32_t>(i));
        points_.push_back(positions_[ends[i].first] - positions_[ends[0].first]);
        extent = std::max(extent, points_.back().cwiseAbs().maxCoeff());
        reach_.push_back(std::min(distance_, 0.25 * shortest[ends[i].first]));
      }
      sides_.push_back(ends[i].second);
    }
    first_side_.push_back(static_cast<uint32_t>(ends.size()));
    if (ends.empty()) return;
    distance_ = *std::max_element(reach_.begin(), reach_.end());  // however large the one that is asked for is
    cell_ = std::max({length / static_cast<double>(boundary_.size()), distance_, 1e-6 * extent});
  }

  void find_on(uint32_t side, const PointGrid& grid, std::vector<EdgeSplit>& found) const {
    const uint32_t a = corner(side, 0), b = corner(side, 1), apex = corner(side, 2);
    const Point origin = positions_[a], edge = positions_[b] - origin;
    const double length = edge.norm();
    const auto steps = static_cast<size_t>(std::ceil(length / cell_));
    const Point shift = positions_[vertices_[0]];
    for (size_t i = 0; i < steps; ++i) {  // a tube around the edge, in balls
      const double begin = static_cast<double>(i) / static_cast<double>(steps);
      const double end = static_cast<double>(i + 1) / static_cast<double>(steps);
      const Point middle = origin + 0.5 * (begin + end) * edge - shift;
      grid.near(middle, 0.5 * (end - begin) * length + distance_, [&](uint32_t j, double) {
        const uint32_t v = vertices_[j];
        if (v == a || v == b || v == apex) return;
        const double t = (positions_[v] - origin).dot(edge) / (length * length);
        if (!(t >= begin && t < end)) return;
        if (!((positions_[v] - origin - t * edge).norm() <= reach_[j])) return;
        // At its ends an edge is joined to others as a seam.
        if (t * length <= distance_ || (1 - t) * length <= distance_) return;
        if (continues_along(side, j, t)) found.push_back({side, t, v});
      });
    }
  }

  /// Does a boundary edge at the vertex run along the edge, with a face that continues that of the edge?
  bool continues_along(uint32_t side, uint32_t j, double t) const {
    const uint32_t a = corner(side, 0), b = corner(side, 1), v = vertices_[j];
    const Point origin = positions_[a], edge = positions_[b] - origin;
    const double length = edge.norm();
    for (uint32_t k = first_side_[j]; k < first_side_[j + 1]; ++k) {
      const uint32_t other = sides_[k];
      if (other / 3 == side / 3) continue;
      const bool leaves = corner(other, 0) == v;
      const Point along = positions_[leaves ? corner(other, 1) : corner(other, 0)] - positions_[v];
      const double rise = along.dot(edge) / (length * length);  // of t
      if (rise == 0) continue;
      // As far as both run beside each other.
      const double share = std::min(1.0, (rise > 0 ? 1 - t : -t) / rise);
      const Point there = positions_[v] + share * along;
      const double place = t + share * rise;
      if (!((there - origin - place * edge).norm() <= distance_)) continue;
      if (!(std::abs(share * rise) * length > distance_)) continue;
      const bool same_way = (rise > 0) == leaves;
      const double turn = turn_at_edge(positions_[a], positions_[b], positions_[corner(side, 2)],
                                       positions_[corner(other, 2)]);
      if (turn < (same_way ? 1 : kOnEachOther)) return true;
    }
    return false;
  }

  /// Keeps one of vertices that lie in one place: the others are joined to it as seams are.
  void drop_crowded(uint32_t side, size_t first, std::vector<EdgeSplit>& found) const {
    const double length = (positions_[corner(side, 1)] - positions_[corner(side, 0)]).norm();
    size_t kept = first;
    for (size_t i = first; i < found.size(); ++i) {
      if (kept > first && (found[i].t - found[kept - 1].t) * length <= distance_) continue;
      found[kept++] = found[i];
    }
    found.resize(kept);
  }

  /// A turn from which on faces count as lying on each other, as in find_seams.
  static constexpr double kOnEachOther = 1.99;

  std::span<const Point> positions_;
  std::span<const Triangle> faces_;
  std::span<const uint32_t> boundary_;
  double distance_;
  std::vector<uint32_t> vertices_;    // of the boundary, rising
  std::vector<Point> points_;         // of those, from the first one
  std::vector<double> reach_;         // of those
  std::vector<uint32_t> first_side_;  // of those, into sides_
  std::vector<uint32_t> sides_;
  double cell_ = 0;
};

}  // namespace

std::vector<EdgeSplit> find_edge_splits(std::span<const Eigen::Vector3d> positions, std::span<const Triangle> faces,
                                        std::span<const uint32_t> boundary, double distance) {
  if (boundary.empty()) return {};
  return SplitSearch(positions, faces, boundary, distance).all();
}

}  // namespace meander
