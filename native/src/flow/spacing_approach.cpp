// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/spacing_approach.h"

#include <algorithm>
#include <cmath>

namespace meander {
namespace {

constexpr size_t kWindow = 10;          // lengths are compared with those of so many iterations before
constexpr double kGrown = 0.02;         // the wide curve is there when its length changes by less,
constexpr size_t kMostIterations = 150; // or after so many iterations
constexpr double kShrinking = 0.99;     // per iteration, from then on; 0.98 leaves a quarter more hairpins
constexpr double kTurns = 50;           // (2 r)^2 that must fit the surface, so that the wide curve is one

}  // namespace

SpacingApproach::SpacingApproach(double start, double radius, double area)
    : factor_(std::max(1.0, std::min(start, std::sqrt(area / kTurns) / (2 * radius)))) {}

double SpacingApproach::next(const IterationFigures& figures) {
  lengths_.push_back(figures.length);
  const size_t n = lengths_.size();
  if (n > kWindow && std::abs(lengths_[n - 1] / lengths_[n - 1 - kWindow] - 1) < kGrown) shrinking_ = true;
  if (n > kMostIterations) shrinking_ = true;
  if (shrinking_) factor_ = std::max(1.0, kShrinking * factor_);
  return factor_;
}

}  // namespace meander
