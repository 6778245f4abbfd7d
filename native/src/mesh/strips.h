// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which components of a surface are long strips, and how wide these are.
#pragma once

#include <vector>

#include "mesh/surface.h"

namespace meander {

/// A strip is so many times as long as wide.
inline constexpr double kLeastStrip = 5;

/// The width of every component that is a strip, infinite for others. A component counts as the rectangle that has its
/// area and its boundary: so do rings, spirals and the arms of a star, and one that has no boundary is no strip.
std::vector<double> strip_widths(const Surface& surface);

}  // namespace meander
