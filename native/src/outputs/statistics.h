// SPDX-License-Identifier: GPL-3.0-or-later
//
// The figures of a flow's curve.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "flow/flow.h"

namespace meander {

/// Lengths are in the unit of Flow::surface().
struct Statistics {
  uint32_t strands = 0, closed_strands = 0, guides = 0;
  uint32_t empty_components = 0;  ///< of the surface, on which no strand may move
  uint32_t small_components = 0;  ///< smaller than the spacing: a curve has no room on them
  size_t crossings = 0;
  double length = 0;
  double energy = 0;            ///< of the model, with the weights of the next iteration
  std::vector<double> spacing;  ///< on both sides of every node of no guide: 2 r times its medial radius over its own
                                ///< local r; sorted

  /// What this share of the spacings, from 0 to 1, lies below; 0 where there is none.
  double spacing_percentile(double share) const;
  /// The share of the spacings that are within a fifth of `wanted`.
  double evenness(double wanted) const;
};

/// Those of the curve as it is now. See Flow::ask for what that changes, and for `cancel`.
Statistics statistics_of(Flow& flow, const CancelToken& cancel = {});
/// The same, where more is asked at once.
Statistics statistics_of(const Flow& flow, const Flow::Present& present);

}  // namespace meander
