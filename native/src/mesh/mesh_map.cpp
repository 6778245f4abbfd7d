// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/mesh_map.h"

namespace meander {

MeshMap::Weights MeshMap::weights(uint32_t f, const Weights& w) const {
  if (corners_[f] == kWhole) return w;
  const std::array<Weights, 3>& corner = corner_weights_[corners_[f]];
  Weights sum{};
  for (size_t k = 0; k < 3; ++k) {
    for (size_t j = 0; j < 3; ++j) sum[j] += w[k] * corner[k][j];
  }
  return sum;
}

VertexData<double> MeshMap::of_vertices(std::span<const double> values) const {
  VertexData<double> result(vertices_.size());
  for (size_t v = 0; v < result.size(); ++v) {
    const VertexOrigin& o = vertices_[v];
    result[v] = o.t == 0 ? values[o.a] : (1 - o.t) * values[o.a] + o.t * values[o.b];
  }
  return result;
}

}  // namespace meander
