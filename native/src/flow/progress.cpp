// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/progress.h"

#include <algorithm>

#include "base/tuning.h"

namespace meander {
double progress_of(const FlowSettings& settings, const ProgressFigures& figures) {
  return std::min(1.0, std::max(figures.length/figures.expected_length, double(figures.iterations)/settings.iteration_limit));
}
}  // namespace meander
