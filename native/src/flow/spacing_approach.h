// SPDX-License-Identifier: GPL-3.0-or-later
//
// Progressive spacing (Fig. 25): the curve first fills the surface widely, then r shrinks.
#pragma once

#include <cstddef>
#include <vector>

#include "flow/convergence.h"

namespace meander {

/// The spacing in units of the one asked for, iteration after iteration.
class SpacingApproach {
 public:
  /// `start`: the factor to begin with; less where the surface has no room for it.
  SpacingApproach(double start, double radius, double area);

  double factor() const { return factor_; }
  bool arrived() const { return factor_ == 1; }

  /// The factor of the next iteration, after one with these figures.
  double next(const IterationFigures& figures);

  /// Scales all lengths by `factor`.
  void rescale(double factor) noexcept {
    for (double& length : lengths_) length *= factor;
  }

 private:
  double factor_;
  std::vector<double> lengths_;
  bool shrinking_ = false;
};

}  // namespace meander
