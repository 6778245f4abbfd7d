// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/spacing_approach.h"

#include <algorithm>
#include <cmath>

#include "flow/constants.h"

namespace meander {

SpacingApproach::SpacingApproach(double start, double radius, double area)
    : factor_(std::max(1.0, std::min(start, std::sqrt(area / kWideTurns) / (2 * radius)))) {}

double SpacingApproach::next(const IterationFigures& figures) {
  lengths_.push_back(figures.length);
  const size_t n = lengths_.size();
  constexpr size_t kWindow = kWideWindow;
  const double change = n > kWindow ? std::abs(lengths_[n - 1] / lengths_[n - 1 - kWindow] - 1) : 1;
  if (change < kWideGrown || n > kWideIterations) shrinking_ = true;
  if (shrinking_) factor_ = std::max(1.0, kShrinking * factor_);
  return factor_;
}

}  // namespace meander
