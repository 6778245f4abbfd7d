// SPDX-License-Identifier: GPL-3.0-or-later
//
// The radii of the medial balls of a node.
#pragma once

#include <array>

namespace meander {

/// r+ (on the side of the bitangent) and r- of a node.
using Radii = std::array<double, 2>;

}  // namespace meander
