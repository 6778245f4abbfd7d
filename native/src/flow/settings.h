// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a flow is asked for.
#pragma once

#include <cstdint>
#include <string_view>

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
  double start_spacing_factor = 1;
  bool polish = false;
  double polish_bending_weight = 0;
  uint32_t hairpin_removal_iterations = 0;
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
  uint32_t variation = 0;   ///< which of the curves of the same settings
  uint32_t iteration_limit = 1;
  uint32_t threads = 0;

  // Tunings, by name in the header.

  /// Before a polish, and in its first iterations, segments are longer than h by this factor.
  double growth_coarsening = 1;
  /// 0 removes hairpins roughly, as it has to be where there are few iterations for it; 1 gently, since in many of them
  /// roughness leaves a curve too dense. See flow/plan.cpp.
  double hairpin_removal_gentleness = 0;
  /// In the polish t_i = clamp(offset - gain (u_i - 1), -1, 3), where u_i is the medial radius in units of r, smoothed
  /// along the curve over 2 r.
  double polish_length_offset = 0, polish_length_gain = 0;
  /// The medial radius at which strands that follow no direction, and are as stiff as the presets have them, come to
  /// rest in a polish, in the median and in r; see rest(). Not used without a polish.
  double polish_rest = 1;
  /// q of eq. 13 in the polish: larger values weigh the worst gaps more; the force at a radius of r is that of q = 2.
  double polish_medial_power = 2;

  /// Where strands come to rest in the end, in the median and in the r that the flow wants; there may be directions
  /// for them to follow.
  double rest(bool directed) const;
  /// What strands of a usual surface come to be apart, over the spacing: 1 unless polish_rest is not the usual one, so
  /// that they are to be nearer or farther apart.
  double usual_spacing(bool directed) const;
  /// The same on a surface whose unit is `factor` times smaller.
  FlowSettings rescaled(double factor) const;
  /// The same with another r, and lengths that are in proportion to it.
  FlowSettings with_radius(double r) const;

  bool operator==(const FlowSettings&) const = default;
};

/// A number among the settings, its name in the header and its range.
struct SettingRange {
  std::string_view name;
  double FlowSettings::*value;
  double least, greatest;
};

/// Those that are fields of meander_flow_options, but for lengths.
inline constexpr SettingRange kOptions[] = {
    {"length_weight", &FlowSettings::length_weight, 0, 1e6},
    {"bending_weight", &FlowSettings::bending_weight, 0, 1e6},
    {"medial_weight", &FlowSettings::medial_weight, 1e-6, 1e6},
    {"alignment_weight", &FlowSettings::alignment_weight, 0, 1e6},
    {"length_power", &FlowSettings::length_power, 1.5, 8},
    {"medial_power", &FlowSettings::medial_power, 2, 8},
    {"step", &FlowSettings::step, 1e-3, 2},
    {"start_spacing_factor", &FlowSettings::start_spacing_factor, 1, 16},
    {"polish_bending_weight", &FlowSettings::polish_bending_weight, 0, 1e6},
    {"boundary_distance", &FlowSettings::boundary_distance, 0, 2},
    {"roughness", &FlowSettings::roughness, 0, 1},
};

/// Those that meander_flow_options_set_tuning sets, in the order of its array.
inline constexpr SettingRange kTunings[] = {
    {"growth_coarsening", &FlowSettings::growth_coarsening, 1, 4},
    {"hairpin_removal_gentleness", &FlowSettings::hairpin_removal_gentleness, 0, 1},
    {"polish_length_offset", &FlowSettings::polish_length_offset, -10, 10},
    {"polish_length_gain", &FlowSettings::polish_length_gain, 0, 100},
    {"polish_medial_power", &FlowSettings::polish_medial_power, 2, 8},
    {"polish_rest", &FlowSettings::polish_rest, 0.5, 1.5},
};

}  // namespace meander
