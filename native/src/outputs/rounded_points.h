// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of a curve that has been made round, as many as a smooth tube along it calls for.
#pragma once

#include <vector>

#include "outputs/rounding.h"

namespace meander {

/// Which of the points of the curve's polylines are drawn, per point 1 or 0: all nodes, and of the edges that segments
/// cross those without which the line would be off by more than kFlatWay of the local spacing, or three times that
/// near a node: a ring of a tube at an edge there would be turned over.
std::vector<uint8_t> drawn_points(const Domain& domain, const Curve& curve, ThreadPool& pool);

}  // namespace meander
