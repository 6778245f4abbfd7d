// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nearest-point queries among points in space, on nanoflann's k-d tree.
#pragma once

#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

// Where memory runs out nanoflann throws, but before that it prints, which a library in somebody's program must not.
#pragma push_macro("fprintf")
#undef fprintf
#define fprintf(...) static_cast<void>(0)
#include <nanoflann.hpp>
#pragma pop_macro("fprintf")

#include "base/cancel_token.h"
#include "base/eigen.h"

namespace meander {

/// Holds its own copy of the points. Queries may run on any number of threads.
class PointTree {
 public:
  /// `poll` counts every coordinate that is looked at while the tree is made, some nanoseconds each.
  explicit PointTree(std::vector<Eigen::Vector3d> points, const CancelToken& poll = {})
      : cloud_{{std::move(points)}, poll}, index_(3, cloud_, {8, kMadeLater}) {
    if (!cloud_.points.empty()) index_.buildIndex();
    cloud_.poll = {};
  }
  PointTree(const PointTree&) = delete;
  PointTree& operator=(const PointTree&) = delete;

  struct Hit {
    uint32_t index;
    double squared_distance;
  };

  /// The nearest point to `q` closer than sqrt(squared_bound), if there is one.
  std::optional<Hit> nearest(const Eigen::Vector3d& q,
                             double squared_bound = std::numeric_limits<double>::infinity()) const {
    if (cloud_.points.empty()) return std::nullopt;
    Best best{squared_bound};
    index_.findNeighbors(best, q.data(), nanoflann::SearchParams(0, 0.f, false));
    if (best.index == UINT32_MAX) return std::nullopt;
    return Hit{best.index, best.distance};
  }

  /// Whether any point is closer to `q` than sqrt(squared_radius). Stops at the first one that it finds.
  bool any_within(const Eigen::Vector3d& q, double squared_radius) const {
    if (cloud_.points.empty()) return false;
    Any any{squared_radius};
    index_.findNeighbors(any, q.data(), nanoflann::SearchParams(0, 0.f, false));
    return any.found;
  }

  /// The indices of all points closer than sqrt(squared_radius), sorted.
  void within(const Eigen::Vector3d& q, double squared_radius, std::vector<uint32_t>& found) const {
    found.clear();
    if (cloud_.points.empty()) return;
    All all{squared_radius, found};
    index_.findNeighbors(all, q.data(), nanoflann::SearchParams(0, 0.f, false));
    std::sort(found.begin(), found.end());
  }

  const std::vector<Eigen::Vector3d>& points() const { return cloud_.points; }

 private:
  struct Cloud {
    std::vector<Eigen::Vector3d> points;
    size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(size_t i, size_t k) const { return points[i][static_cast<Eigen::Index>(k)]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };
  /// The same as the making of the tree sees it. Searches do not: they read points through the Cloud.
  struct AskingCloud : Cloud {
    AskingCloud(Cloud&& cloud, const CancelToken& asked) : Cloud(std::move(cloud)), poll(asked) {}
    mutable CancelToken poll;
    double kdtree_get_pt(size_t i, size_t k) const {
      poll();
      return Cloud::kdtree_get_pt(i, k);
    }
  };
  using Index =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, AskingCloud, 3, uint32_t>;

  // nanoflann's result-set interface. The bound prunes the search from its start.
  struct Best {
    double distance;
    uint32_t index = UINT32_MAX;
    size_t size() const { return index != UINT32_MAX; }
    bool full() const { return true; }
    double worstDist() const { return distance; }
    bool addPoint(double d, uint32_t i) {
      if (d < distance) {
        distance = d;
        index = i;
      }
      return true;
    }
  };
  struct Any {
    double bound;
    bool found = false;
    size_t size() const { return found; }
    bool full() const { return true; }
    double worstDist() const { return bound; }
    /// False ends the search.
    bool addPoint(double d, uint32_t) {
      found |= d < bound;
      return !found;
    }
  };
  struct All {
    double bound;
    std::vector<uint32_t>& found;
    size_t size() const { return found.size(); }
    bool full() const { return true; }
    double worstDist() const { return bound; }
    bool addPoint(double d, uint32_t i) {
      if (d < bound) found.push_back(i);
      return true;
    }
  };

  /// Where the constructor makes the tree, buildIndex() makes it once more.
  static constexpr auto kMadeLater = nanoflann::KDTreeSingleIndexAdaptorFlags::SkipInitialBuildIndex;

  AskingCloud cloud_;
  Index index_;
};

}  // namespace meander
