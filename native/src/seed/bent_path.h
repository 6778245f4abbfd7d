// SPDX-License-Identifier: GPL-3.0-or-later
//
// A short path between two nodes round what lies straight between them.
#pragma once

#include <optional>

#include "geodesic/geodesic_path.h"
#include "seed/line_network.h"

namespace meander {

/// The shortest locally shortest path found between two nodes that are near each other, but do not see each other, as
/// round a hole or the inner side of a corner: by way of places beside the middle of the straight line between them,
/// in steps of a 32nd of its length to both sides. Nothing where none of these sees both. Whether it touches
/// anything is for the caller to ask. `path` is the result's, else anything.
std::optional<PathShape> bent_path(const LineNetwork& network, uint32_t from, uint32_t to, PathShortener& shortener,
                                   Path& path);

}  // namespace meander
