// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/spacing_correction.h"

#include <algorithm>
#include <vector>

#include "flow/constants.h"

namespace meander {
namespace {

/// A median of more nodes says no more.
constexpr uint32_t kMostLookedAt = 1u << 16;

}  // namespace

double median_spacing(const Curve& curve, const NodeData<Radii>& radii, const LocalMetric& metric) {
  const uint32_t stride = curve.size() / kMostLookedAt + 1;
  std::vector<double> spacing;
  spacing.reserve(2 * (curve.size() / stride + 1));
  for (uint32_t i = 0; i < curve.size(); i += stride) {
    if (curve.on_guide(i)) continue;
    for (const double radius : radii[i]) spacing.push_back(radius / metric.radius[i]);
  }
  if (spacing.empty()) return 0;
  const auto middle = spacing.begin() + static_cast<std::ptrdiff_t>(spacing.size() / 2);
  std::ranges::nth_element(spacing, middle);
  return *middle;
}

double corrected(double correction, double spacing, bool coarse) {
  if (!(spacing > 0)) return correction;
  const double off = spacing / (coarse ? kCoarseSpacing : 1) - 1;
  const double too_far = off - std::clamp(off, -kCloseEnough, kCloseEnough);
  return std::clamp(correction * (1 - kCorrecting * too_far), 1 - kMostCorrection, 1 + kMostCorrection);
}

}  // namespace meander
