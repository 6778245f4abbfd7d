// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices that are in the same place, whatever their numbers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/cancel_token.h"
#include "base/eigen.h"

namespace meander {

/// A share of the size of a mesh: vertices this near to each other are in one place, or to a plane in it. Single
/// precision tells no less apart in a mesh that lies ten of its sizes from the origin, so that copies made or moved
/// there differ by as much; the two sides of whatever has a thickness are farther from each other.
inline constexpr double kOnePlace = 1e-6;

/// Per vertex its place, named by the lowest vertex there; vertices that are not used are alone.
///
/// distance   in the unit of the positions
/// cell       of the grid that is searched, in distances, at least 2: many where few vertices are near to each other
std::vector<uint32_t> shared_places(std::span<const Eigen::Vector3d> positions, std::span<const uint8_t> used,
                                    double distance, double cell, CancelToken poll);

}  // namespace meander
