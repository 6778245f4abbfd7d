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

/// Per vertex its place, named by the lowest vertex there; vertices that are not used are alone.
///
/// distance   in the unit of the positions
/// cell       of the grid that is searched, in distances, at least 2: many where few vertices are near to each other
std::vector<uint32_t> shared_places(std::span<const Eigen::Vector3d> positions, std::span<const uint8_t> used,
                                    double distance, double cell, CancelToken poll);

}  // namespace meander
