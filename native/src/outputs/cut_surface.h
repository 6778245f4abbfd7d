// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface cut along the curve as it leaves the library: in the units and the indices of the caller's mesh.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/cancel_token.h"
#include "curve/curve.h"
#include "mesh/mesh_map.h"

namespace meander {

/// The arrays of meander_cut; see the header.
struct CutSurface {
  std::vector<Vec3> positions;
  std::vector<double> distances;
  std::vector<uint32_t> vertex_faces;
  std::vector<std::array<double, 3>> vertex_weights;

  std::vector<std::array<uint32_t, 3>> faces;
  std::vector<uint32_t> origins, strands, regions;
  std::vector<int32_t> sides, nearest_sides;
  std::vector<std::array<double, 3>> along, face_distances;
  std::vector<std::array<std::array<double, 3>, 3>> corner_weights;

  std::vector<uint32_t> line_vertices, line_strands;
  std::vector<double> arc_lengths;
  std::vector<uint64_t> offsets{0};
  std::vector<uint8_t> closed;
  std::vector<double> lengths;
};

/// Cuts a surface along a curve. `detail`, in the caller's units, and `middle_lines`: see meander_flow_cut_surface.
/// `map` may be null. `cancel` is asked all the while; throws Failure(FailureKind::kCancelled) where it stops this.
CutSurface cut_surface(const Surface& surface, const MeshMap* map, const Curve& curve, double detail,
                       bool middle_lines, const CancelToken& cancel = {});

}  // namespace meander
