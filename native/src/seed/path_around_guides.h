// SPDX-License-Identifier: GPL-3.0-or-later
//
// A short path that meets no guide.
#pragma once

#include <optional>
#include <vector>

#include "seed/guide_samples.h"

namespace meander {

/// Places to pass on a short path between two points of a component that `samples` has, without the two; nothing
/// where guides part them, or leave less than a spacing between them. The path leads over samples, so it keeps r / 2
/// from guides but at its ends. Takes time for the places that the search comes to only. Any thread may call it.
std::optional<std::vector<SurfacePoint>> path_around_guides(const Surface& surface, const GuideSamples& samples,
                                                            const SurfacePoint& from, const SurfacePoint& to);

}  // namespace meander
