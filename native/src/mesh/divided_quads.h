// SPDX-License-Identifier: GPL-3.0-or-later
//
// Quads that were divided into two triangles, each side of them along another diagonal, as where an exporter divides
// every quad from its first corner.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/cancel_token.h"
#include "mesh/edge_groups.h"

namespace meander {

/// Collects what may be quads on four places, and tells those that are there with both diagonals.
///
/// Four triangles on four places are the two sides of a bent quad, or a solid. Those of a solid continue each other
/// across one diagonal at most, or have no more than two faces at any edge, unless somebody says that they are quads.
class DividedQuads {
 public:
  DividedQuads(std::span<const uint32_t> place, std::span<const Triangle> faces)
      : place_(place), faces_(faces), at_many_(faces.size(), 0) {}

  /// Two faces that are one polygon.
  void add_polygon(uint32_t one, uint32_t other);

  /// Two faces, at the half-edges where they continue each other.
  void add_pair(uint32_t one, uint32_t other);

  /// An edge with another number of faces than two.
  void add_edge_of_many(EdgeSides sides, std::span<const uint32_t> half_edges);

  /// Per quad its two faces.
  std::vector<std::pair<uint32_t, uint32_t>> with_both_diagonals(CancelToken poll);

 private:
  struct Quad {
    std::array<uint32_t, 4> places;  ///< rising
    VertexPair diagonal;             ///< by places
    uint32_t one, other;             ///< faces
    bool is_polygon;
  };

  void add(uint32_t one, uint32_t other, bool is_polygon);
  VertexPair edge_at(uint32_t half_edge) const;
  bool are_sides(std::span<const Quad> quads) const;

  std::span<const uint32_t> place_;   // per vertex
  std::span<const Triangle> faces_;
  std::vector<uint8_t> at_many_;      // per face: whether it is at an edge of other than two faces
  std::vector<Quad> quads_;
};

}  // namespace meander
