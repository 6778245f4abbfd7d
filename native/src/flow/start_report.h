// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a run began, for whoever asks afterwards: what was asked for, and what became of it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "seed/full_start.h"

namespace meander {

/// A part is a strand that grows: one in every component of the surface, or region between guides, or one that was
/// drawn.
struct StartReport {
  /// A curve that fills the surface was asked for.
  bool full_asked = false;
  /// What became of every strand, in their order. Empty before the first iteration, where the curve was to grow, and
  /// where nothing was to be laid, since the curve filled a surface that had moved already. Where growth was asked for,
  /// but would take too long (too_long_to_grow), a curve is laid too.
  std::vector<StrandStart> strands;
  /// Strands that have grown, and were then joined to lines laid in what was still empty beside them.
  uint32_t completed = 0;

  /// Where growth was asked for only those that were laid count: the others are as they were to be.
  uint32_t count(StrandStart what) const {
    return full_asked || what == StrandStart::kLaid ? static_cast<uint32_t>(std::ranges::count(strands, what)) : 0;
  }
  uint32_t full_parts() const { return count(StrandStart::kLaid); }
  /// Those that grow although they were to begin full; `strands` says why.
  uint32_t grown_parts() const { return count(StrandStart::kNoRoom) + count(StrandStart::kCrossings); }
  /// Whether the curve is treated as one that filled the surface from its start.
  bool began_full() const { return full_parts() > 0; }
};

}  // namespace meander
