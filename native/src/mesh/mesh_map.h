// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the vertices and faces of a prepared mesh come from, so that the caller can keep using the numbers of
// the original mesh.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/vertex_data.h"

namespace meander {

/// From the prepared mesh back to the caller's.
class MeshMap {
 public:
  using Weights = std::array<double, 3>;

  /// At the share t of the edge from the caller's vertex a to b.
  struct VertexOrigin {
    uint32_t a = 0, b = 0;
    double t = 0;
  };

  size_t caller_vertex_count() const { return caller_vertex_count_; }
  const VertexOrigin& vertex_origin(uint32_t v) const { return vertices_[v]; }
  /// The caller's vertex that is nearest along the edge.
  uint32_t vertex(uint32_t v) const { return vertices_[v].t < 0.5 ? vertices_[v].a : vertices_[v].b; }
  uint32_t face(uint32_t f) const { return faces_[f]; }

  /// Weights of the corners of the caller's face, from those of prepared face f.
  Weights weights(uint32_t f, const Weights& w) const;

  /// The values of the prepared vertices; `values` has one for every vertex of the caller's.
  VertexData<double> of_vertices(std::span<const double> values) const;

 private:
  friend class Soup;
  static constexpr uint32_t kWhole = UINT32_MAX;  // a face that is the caller's whole face
  size_t caller_vertex_count_ = 0;
  std::vector<VertexOrigin> vertices_;
  std::vector<uint32_t> faces_;
  std::vector<uint32_t> corners_;  // per face: index into corner_weights_, kWhole for the caller's whole face
  std::vector<std::array<Weights, 3>> corner_weights_;
};

}  // namespace meander
