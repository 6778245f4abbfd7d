// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is known of every point of the polylines: where on the surface, how far along, in which direction, how
// much room on both sides.
#pragma once

#include <cstdint>

#include "flow/flow.h"
#include "mesh/mesh_map.h"

namespace meander {

/// Arrays of the caller's with room for every point, in the order of write_polylines; each may be null.
struct PointArrays {
  double* arc_lengths = nullptr;   ///< from the strand's first point, caller's units
  double* normals = nullptr;       ///< xyz, unit, of the surface
  double* tangents = nullptr;      ///< xyz, unit, along the strand
  double* radii = nullptr;         ///< r+ and r-, caller's units
  uint32_t* faces = nullptr;       ///< the caller's
  double* barycentrics = nullptr;  ///< weights of the face's vertices in the caller's order
};

/// Fills the arrays for a curve on the surface of a flow. radii: those of flow.radii(), which must be up to date, at
/// the nodes, and between them in proportion to the arc length. `map` tells the caller's faces, or is null.
///
/// `node_of`  per node of the curve the node of the flow's curve whose radii it has; null: it is that curve
void write_point_data(const Flow& flow, const Curve& curve, const NodeData<uint32_t>* node_of, const MeshMap* map,
                      const PointArrays& arrays);

}  // namespace meander
