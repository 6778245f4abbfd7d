// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "base/eigen.h"

namespace meander {

/// Squared distance of p from the straight segment between a and a + d, which may be one point; `squared` is
/// that of its length.
inline double squared_distance_to_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& d,
                                          double squared) {
  const double t = squared > 0 ? std::clamp((p - a).dot(d) / squared, 0.0, 1.0) : 0.0;
  return (p - a - t * d).squaredNorm();
}

/// Distance of p from the straight segment between a and b, which may be one point.
inline double distance_to_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d d = b - a;
  return std::sqrt(squared_distance_to_segment(p, a, d, d.squaredNorm()));
}

}  // namespace meander
