// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parts any list of triangles into sheets that are surfaces: says which faces stay neighbours where more than two
// share an edge, and which corners at a vertex belong together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/eigen.h"
#include "mesh/soup.h"

namespace meander {

/// What keeps faces from being a surface, and how they come apart there.
struct Sheets {
  std::vector<uint32_t> fan;         ///< per corner 3 f + k: the lowest corner of its fan, which gets its own vertex
  std::vector<VertexPair> crowded;   ///< edges with more than two faces
  std::vector<VertexPair> opened;    ///< edges cut because the surface has only one side there
  std::vector<uint8_t> at_cut;       ///< per vertex: whether it is at an edge where faces come apart
};

/// Parts faces, each with three different vertices, into sheets that are manifold and have two sides.
///
/// join_flattest  at an edge with more than two faces those that continue each other stay neighbours: first pairs
///                whose orientation agrees, of these pairs that other edges join as well (so that two solids which
///                touch along an edge stay two), of these the pair with the smallest turn, of equal ones
///                that with the lowest faces. Otherwise, and where there are more than kMostAtEdge, each of them ends
///                there
///
/// Edges with two faces stay as they are, unless the surface has only one side: then it is cut open where two faces
/// that are wound alike lie folded on each other, and if it has one side still, along a line, where orientations that
/// spread from the first face of a component meet.
Sheets find_sheets(Soup& soup, bool join_flattest);

/// Vertices at which fans meet, away from edges where faces come apart, rising.
std::vector<uint32_t> bow_ties(const Soup& soup, const Sheets& sheets);

/// How sharply two faces turn at an edge: 0 for flat ones, 2 for those that lie on each other; rounded, so that
/// rounding errors do not decide between equal ones.
///
/// c, d   the third corners of the two faces
double turn_at_edge(std::span<const Eigen::Vector3d> positions, const VertexPair& edge, uint32_t c, uint32_t d);

}  // namespace meander
