// SPDX-License-Identifier: GPL-3.0-or-later
//
// Boundary edges that lie on each other: faces that only look joined, as in what scanners and STL files give. Two edges
// from end to end are a seam; where an edge lies along several, their vertices are to split it (T-junctions).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/cancel_token.h"
#include "base/eigen.h"
#include "mesh/edge_groups.h"

namespace meander {

class Soup;

/// The boundary of faces, and how near to its vertices something counts as being in their place.
struct FaceBoundary {
  std::span<const Eigen::Vector3d> positions;
  std::span<const Triangle> faces;
  std::vector<uint32_t> half_edges;     ///< those that are alone on their edge, rising
  std::vector<uint32_t> vertices;       ///< those at them, rising
  std::vector<Eigen::Vector3d> points;  ///< where these are, seen from the first
  /// Of these: `distance`, or a quarter of the shortest edge at one, so that no face can collapse at any distance.
  std::vector<double> reach;
  double farthest = 0, extent = 0;      ///< the largest reach, and the largest coordinate of the points
  CancelToken poll;

  /// half_edges   all that are alone on their edge, rising
  /// distance     positive, in the unit of the positions
  FaceBoundary(std::span<const Eigen::Vector3d> positions, std::span<const Triangle> faces,
               std::vector<uint32_t> half_edges, double distance, const CancelToken& poll);
  FaceBoundary(Soup& soup, double distance);
};

/// Two half-edges that are one edge but for its name.
struct Seam {
  uint32_t one = 0, other = 0;
  bool opposed = true;  ///< they run against each other, as neighbours of the same orientation do
};

/// Pairs of boundary half-edges whose ends lie within reach of each other.
///
/// Where more than two edges lie together, pairs are found as in find_sheets, and none of more than kMostAtEdge. Faces
/// that lie on each other are never paired, nor are edges that run in the same direction unless their faces continue
/// each other: sheets in one place stay sheets.
std::vector<Seam> find_seams(const FaceBoundary& boundary);

/// A vertex that lies on a half-edge, at the share t of the way along it.
struct EdgeSplit {
  uint32_t side = 0;
  double t = 0;
  uint32_t vertex = 0;
};

/// All of them, in the order of the half-edges and along each.
///
/// A vertex counts where the edge is within its reach, away from the edge's ends, and a boundary edge that begins or
/// ends at it runs along the edge: a corner that only touches an edge is no crack. As in find_seams, faces that lie on
/// each other are left alone.
std::vector<EdgeSplit> find_edge_splits(const FaceBoundary& boundary);

}  // namespace meander
