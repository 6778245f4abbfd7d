// SPDX-License-Identifier: GPL-3.0-or-later
//
// nanoflann as its manual shows it: the benchmark's own tree, so that no optimisation of the
// library's gets into the floor or into the judgement.
#pragma once

#include <nanoflann.hpp>
#include <vector>

#include "mesh.h"

namespace meander::bench {

class NearestPoint {
 public:
  explicit NearestPoint(const std::vector<Point>& points)
      : cloud_{points}, index_(3, cloud_, {10}) {
    index_.buildIndex();
  }

  double squared_distance(const Point& query) const {
    uint32_t nearest = 0;
    double squared = 0;
    index_.knnSearch(query.data(), 1, &nearest, &squared);
    return squared;
  }

 private:
  struct Cloud {
    const std::vector<Point>& points;
    size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(size_t i, size_t k) const { return points[i][k]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };
  Cloud cloud_;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3,
                                      uint32_t>
      index_;
};

}  // namespace meander::bench
