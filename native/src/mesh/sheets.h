// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parts any list of triangles into sheets that are surfaces: says which faces stay neighbours where more than two
// share an edge, and which corners at a vertex belong together.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh_check.h"

namespace meander {

/// An edge by its vertices, the lower one first.
using VertexPair = std::array<uint32_t, 2>;

/// Where more faces than this meet at an edge none of them stays joined there: finding out which continue each other
/// takes time and memory with the square of their number.
inline constexpr size_t kMostAtEdge = 200;

/// What keeps faces from being a surface, and how they come apart there.
struct Sheets {
  std::vector<uint32_t> fan;         ///< per corner 3 f + k: the lowest corner of its fan, which gets its own vertex
  std::vector<VertexPair> crowded;   ///< edges with more than two faces
  std::vector<VertexPair> opened;    ///< edges cut because the surface has only one side there
  std::vector<uint32_t> bow_ties;    ///< vertices where fans meet away from the edges above
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
Sheets find_sheets(std::span<const Eigen::Vector3d> positions, std::span<const Triangle> faces, bool join_flattest);

/// How sharply two faces turn at an edge from a to b: 0 for flat ones, 2 for those that lie on each other; rounded, so
/// that rounding errors do not decide between equal ones.
///
/// c, d   the third corners of the two faces
double turn_at_edge(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                    const Eigen::Vector3d& d);

}  // namespace meander
