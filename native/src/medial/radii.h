// SPDX-License-Identifier: GPL-3.0-or-later
//
// The radii of the medial balls of a node.
#pragma once

#include <array>

namespace meander {

/// r+ (on the side of the bitangent) and r- of a node.
using Radii = std::array<double, 2>;

/// A ball is first looked for among those up to this much larger than the node's last one.
inline constexpr double kWarmth = 1.2;

}  // namespace meander
