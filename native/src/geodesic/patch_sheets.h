// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which patches of a surface lie on one sheet: the layers of a folded cloth, both sides of a leaf.
#pragma once

#include <cstdint>
#include <vector>

#include "base/cancel_poll.h"
#include "geodesic/surface_patches.h"

namespace meander {

/// Parts patches into sheets, connected sets in which none is hidden from another. Each begins with the first patch
/// that is left, and takes in what is beside it as long as that holds: a sheet is about as large as can be. Returns the
/// number of the sheet for each patch.
///
/// `hidden`  for each patch those that are hidden from it; maybe only for one of two
/// `poll`    counts patches
std::vector<uint32_t> find_sheets(const SurfacePatches& patches, const std::vector<std::vector<uint32_t>>& hidden,
                                  CancelPoll poll);

}  // namespace meander
