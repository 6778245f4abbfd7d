// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a run is going to cost, before it begins.
#pragma once

#include <cstdint>

#include "flow/settings.h"
#include "mesh/surface.h"
#include "mesh/vertex_data.h"

namespace meander {

/// See meander_extent. In whatever unit the settings are that it is used with.
struct Extent {
  uint32_t faces = 0;
  double length_area = 0, node_area = 0;
  double edge_density = 0;
  double curvature = 0;
};

/// See meander_cost.
struct Cost {
  double nodes = 0, points = 0;
  double length = 0;
  double memory = 0;  ///< bytes
  double processor_seconds = 0;
};

/// Of a surface in its own unit; no density: 1 everywhere.
Extent measured_extent(const Surface& surface, const VertexData<double>& density);

/// Of a run to its own end; infinite where there is no number for it.
Cost expected_cost(const Extent& extent, const FlowSettings& settings);

}  // namespace meander
