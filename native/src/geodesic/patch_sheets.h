// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which patches of a surface lie on one sheet: the layers of a folded cloth, both sides of a leaf.
#pragma once

#include <cstdint>
#include <vector>

#include "base/cancel_token.h"
#include "geodesic/patch_search.h"

namespace meander {

/// Parts patches into sheets, connected sets in which none is hidden from another. Each begins with the first patch
/// that is left, and takes in what is beside it as long as that holds: a sheet is about as large as can be. Returns the
/// number of the sheet for each patch.
///
/// `hidden`  for each patch those that are hidden from it; maybe only for one of two
/// `poll`    counts patches
std::vector<uint32_t> find_sheets(const SurfacePatches& patches, const std::vector<std::vector<uint32_t>>& hidden,
                                  CancelToken poll);

/// For each patch that hides something on its side the sheets that are remote from it, see SurfacePatches::remote, in
/// rising order: those of at least eight patches of which it hides anything, unless they come within `most` of it along
/// the surface, in its own r.
///
/// One search from every sheet reaches each patch a few times; one from every patch would reach hundreds of others.
///
/// `patches`     their sheets are known
/// `hidden`      for each patch those that are hidden from it
/// `r`           of the patches
std::vector<std::vector<uint32_t>> find_remote_sheets(const SurfacePatches& patches,
                                                      const std::vector<std::vector<uint32_t>>& hidden,
                                                      const PatchSteps& steps, const std::vector<double>& r,
                                                      double most, ThreadPool& pool);

}  // namespace meander
