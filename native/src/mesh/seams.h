// SPDX-License-Identifier: GPL-3.0-or-later
//
// Boundary edges that lie on each other: faces that only look joined, as in what scanners and STL files give.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh_check.h"

namespace meander {

/// Two half-edges 3 f + k that are one edge but for its name, from corner k of face f to the next.
struct Seam {
  uint32_t one = 0, other = 0;
  bool opposed = true;  ///< they run against each other, as neighbours of the same orientation do
};

/// Pairs of boundary half-edges whose ends lie within `distance` of each other.
///
/// Vertices count as near only where they are also nearer than a quarter of every edge at them, so that no face can
/// collapse whatever the distance. Where more than two edges lie together, pairs are found as in find_sheets, and none
/// of more than kMostAtEdge. Faces
/// that lie on each other are never paired, nor are edges that run in the same direction unless their faces continue
/// each other: sheets in one place stay sheets.
///
/// boundary   the half-edges that are alone on their edge, in rising order
/// distance   positive, in the unit of the positions
std::vector<Seam> find_seams(std::span<const Eigen::Vector3d> positions, std::span<const Triangle> faces,
                             std::span<const uint32_t> boundary, double distance);

/// The half-edges that are alone on their edge, in rising order.
std::vector<uint32_t> boundary_of(std::span<const Triangle> faces);

}  // namespace meander
