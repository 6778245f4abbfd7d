// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a curve still changes to the eye, wherever its nodes go along it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/thread_pool.h"
#include "curve/curve.h"
#include "curve/local_metric.h"
#include "mesh/surface.h"

namespace meander {

/// Whether a curve comes to rest: it is compared with what it was a window before.
class RestOfPicture {
 public:
  void forget() { before_.reset(); }
  /// Whether the curve, whose length has changed by the share `change`, looks as it did; the first time this only
  /// takes down how it looks.
  bool has_settled(size_t iteration, const Surface& surface, const Curve& curve, const LocalMetric& metric,
                   double change, ThreadPool& pool);

 private:
  /// The curve as it was at an iteration.
  struct Picture {
    size_t iteration = 0;
    std::vector<Vec3> nodes;
    std::vector<uint32_t> next, previous;
  };
  double mean_distance(const Surface& surface, const Curve& curve, const LocalMetric& metric,
                       ThreadPool& pool) const;

  std::optional<Picture> before_;
};

}  // namespace meander
