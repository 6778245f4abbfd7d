// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/rest_of_picture.h"

#include <algorithm>
#include <utility>

#include "base/segment_distance.h"
#include "flow/constants.h"
#include "flow/free_nodes.h"
#include "medial/near_points.h"

namespace meander {

/// The mean distance of the nodes of `curve` that may move from the picture, in the local r.
double RestOfPicture::mean_distance(const Surface& surface, const Curve& curve, const LocalMetric& metric,
                                    ThreadPool& pool) const {
  const Picture& earlier = *before_;
  const CurveBvh tree(earlier.nodes, pool);
  std::vector<uint32_t> nearest(curve.size());
  pool.for_blocks(curve.size(), kNodeGrain, [&](size_t, size_t begin, size_t end) {
    // Of a neighbour it is about as far.
    uint32_t near = std::min(static_cast<uint32_t>(begin), static_cast<uint32_t>(earlier.nodes.size() - 1));
    for (size_t i = begin; i < end; ++i) {
      nearest[i] = near = nearest_point(tree, position(surface, curve.nodes[i]), near);
    }
  });
  return mean_over_movable(curve, pool, [&](uint32_t i) {
    const Vec3 p = position(surface, curve.nodes[i]);
    const uint32_t near = nearest[i];
    double d = (p - earlier.nodes[near]).norm();
    for (const uint32_t other : {earlier.next[near], earlier.previous[near]}) {
      if (other != kNone) d = std::min(d, distance_to_segment(p, earlier.nodes[near], earlier.nodes[other]));
    }
    return d / metric.radius[i];
  });
}

bool RestOfPicture::has_settled(size_t iteration, const Surface& surface, const Curve& curve,
                                const LocalMetric& metric, double change, ThreadPool& pool) {
  if (before_ && iteration - before_->iteration < kSettledWindow) return false;
  // Before what it looks like is taken down: the tree and two pictures at once would be the most memory of a run.
  const bool settled =
      before_ && change < kSettledLength && mean_distance(surface, curve, metric, pool) < kSettledDistance;
  const size_t count = curve.size();
  Picture present{iteration, std::vector<Vec3>(count), std::vector<uint32_t>(count), std::vector<uint32_t>(count)};
  pool.for_each(count, kNodeGrain, [&](uint32_t i) {
    present.nodes[i] = position(surface, curve.nodes[i]);
    present.next[i] = curve.next(i);
    present.previous[i] = curve.previous(i);
  });
  before_ = std::move(present);
  return settled;
}

}  // namespace meander
