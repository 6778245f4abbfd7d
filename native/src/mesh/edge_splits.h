// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices of the boundary that lie on boundary edges of other faces (T-junctions): cracks without a width.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh_check.h"

namespace meander {

/// A vertex that lies on the half-edge 3 f + k, at the share t of the way along it.
struct EdgeSplit {
  uint32_t side = 0;
  double t = 0;
  uint32_t vertex = 0;
};

/// All of them, in the order of the half-edges and along each.
///
/// A vertex counts where it lies within `distance` of the edge, and nearer than a quarter of every edge at it, away
/// from the edge's ends, and a boundary edge that begins or ends at it runs along the edge: a corner that only touches
/// an edge is no crack. As in find_seams, faces that lie on each other are left alone.
///
/// boundary   the half-edges that are alone on their edge, in rising order
/// distance   positive, in the unit of the positions
std::vector<EdgeSplit> find_edge_splits(std::span<const Eigen::Vector3d> positions, std::span<const Triangle> faces,
                                        std::span<const uint32_t> boundary, double distance);

}  // namespace meander
