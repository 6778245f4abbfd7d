// SPDX-License-Identifier: GPL-3.0-or-later
//
// The nearest point of the surface to a point in space (seeds).
#pragma once

#include <vector>

#include "base/point_tree.h"
#include "mesh/surface_point.h"

namespace meander {

/// Exact nearest points. A tree of samples gives a bound and candidates, which are then measured.
class ClosestPoint {
 public:
  /// `poll` counts what is done while the samples and their tree are made, some nanoseconds each.
  explicit ClosestPoint(const Surface& surface, const CancelToken& poll = {});

  struct Result {
    SurfacePoint point;
    double distance;  ///< to the face itself; the point keeps kClearance from its edges
  };
  Result operator()(const Vec3& q) const;

 private:
  struct Samples {
    std::vector<Vec3> points;
    std::vector<uint32_t> face;
    double reach = 0;  // every point of a face is within this distance of one of its samples
  };
  static Samples sample(const Surface& surface, CancelToken poll);
  ClosestPoint(const Surface& surface, Samples&& samples, const CancelToken& poll);

  const Surface& surface_;
  std::vector<uint32_t> face_;
  double reach_;
  PointTree tree_;
};

}  // namespace meander
