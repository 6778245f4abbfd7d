// SPDX-License-Identifier: GPL-3.0-or-later
//
// The nearest point of a surface, or of any list of triangles, to a point in space.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/thread_pool.h"
#include "mesh/surface_point.h"
#include "mesh/triangle_tree.h"

namespace meander {

/// Nearest points of a surface, in its own unit and place.
class ClosestPoint {
 public:
  /// `poll` counts what is done while the tree is made, some nanoseconds each.
  explicit ClosestPoint(const Surface& surface, const CancelToken& poll = {});

  struct Result {
    SurfacePoint point;
    double distance;  ///< to the face itself; the point keeps kClearance from its edges
  };
  Result operator()(const Vec3& q) const;

 private:
  TriangleTree tree_;
};

/// Where the nearest places are, point by point.
struct ClosestPlaces {
  std::vector<uint32_t> faces;
  std::vector<std::array<double, 3>> weights;  ///< of the face's corners
  std::vector<double> distances;
};

/// The points of faces nearest to `points`, three coordinates each. Faces may be anything; those with a vertex that is
/// not finite are left out. Throws Failure(FailureKind::kInvalidMesh) where none is left, or an index is out of range.
ClosestPlaces closest_places(std::span<const double> vertices, std::span<const uint32_t> faces,
                             std::span<const double> points, ThreadPool& pool);

/// The same on a surface; points are in the caller's units, distances too, faces and weights the surface's own.
ClosestPlaces closest_places(const Surface& surface, std::span<const double> points, ThreadPool& pool);

}  // namespace meander
