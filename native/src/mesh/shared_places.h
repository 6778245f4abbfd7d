// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices that are in the same place, whatever their numbers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/eigen.h"

#include "base/cancel_token.h"

namespace meander {

/// A share of the size of a mesh, about what single precision can tell apart: vertices this near to each other are in
/// one place, and the two sides of whatever has a thickness are not.
inline constexpr double kOnePlace = 1e-7;

/// Per vertex its place, named by the lowest vertex there; vertices that are not used are alone.
///
/// distance   in the unit of the positions, positive
std::vector<uint32_t> shared_places(std::span<const Eigen::Vector3d> positions, std::span<const uint8_t> used,
                                    double distance, CancelToken poll);

}  // namespace meander
