// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a flow is asked for.
#pragma once

#include <cstdint>

#include "medial/boundary_reach.h"

namespace meander {

/// What ends a flow: its picture has settled, or the paper's limit on the steps (Table 2).
enum class StopRule { kSettled, kPaper };

/// Whether balls are straight through space or along the surface; see MEANDER_MEDIAL_AXIS_...
enum class MedialAxis { kEuclidean, kGeodesic };

/// meander_flow_options, checked; lengths in the surface's own unit. What each means is said there.
struct FlowSettings {
  double radius = 0;
  double segment_length = 0;
  double max_radius = 0;
  double length_weight = 0, bending_weight = 0, medial_weight = 1;
  double alignment_weight = 0;
  double length_power = 2, medial_power = 2;
  double step = 1;
  double growth_coarsening = 1;
  double start_spacing_factor = 1;
  bool polish = false;
  double polish_bending_weight = 0, polish_length_offset = 0, polish_length_gain = 0;
  double polish_medial_power = 2;
  uint32_t hairpin_removal_iterations = 0;
  double hairpin_removal_gentleness = 0;  ///< 0: roughly, 1: gently
  /// Where both sides of a strand are empty no force acts on it: there it is made to grow.
  bool grow_into_empty = false;
  /// Free ends keep r from what is ahead of them, or go on until they do.
  bool hold_ends = false;
  bool widen_loops = false;
  StopRule stop_rule = StopRule::kSettled;
  BoundaryRule boundary_rule = BoundaryRule::kCentre;
  double boundary_distance = 0.5;  ///< of the last strand from the boundary, in (local) spacings
  MedialAxis medial_axis = MedialAxis::kEuclidean;
  double roughness = 1;  ///< how much of the surface's roughness the spacing follows; see Domain::surface
  bool full_start = false;  ///< begin with a curve that fills the surface already
  uint32_t iteration_limit = 1;
  uint32_t threads = 0;

  /// The same on a surface whose unit is `factor` times smaller.
  FlowSettings rescaled(double factor) const;
  /// The same with another r, and lengths that are in proportion to it.
  FlowSettings with_radius(double r) const;

  bool operator==(const FlowSettings&) const = default;
};

}  // namespace meander
