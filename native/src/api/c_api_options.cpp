// SPDX-License-Identifier: GPL-3.0-or-later
//
// The options of a flow: their defaults, the only ones there are, and their ranges.
#include "api/handles.h"

namespace meander {
namespace {

/// require_range for the quotient of two lengths, whose rounding must not refuse the ends themselves.
void require_ratio(double value, double low, double high, const char* name) {
  constexpr double kRounding = 1e-9;
  require_range(value, low * (1 - kRounding), high * (1 + kRounding), name);
}

}  // namespace

FlowSettings checked_settings(const meander_flow_options& o, const Surface& surface) {
  if (!(std::isfinite(o.radius) && o.radius > 0)) {
    refuse("The spacing must be a positive number; it is " + number(2 * o.radius) + ".");
  }
  FlowSettings s;
  s.radius = settle(o.radius / surface.scale());
  if (2 * s.radius > 1 || 4 * s.radius * s.radius > surface.area()) {
    refuse("The spacing " + number(2 * o.radius) + " is larger than the surface (its diagonal is " +
           number(surface.scale()) + "); choose a smaller spacing.");
  }
  if (o.segment_length != 0) require_ratio(o.segment_length / o.radius, 0.01, 1, "segment_length (in units of r)");
  if (o.max_radius != 0) require_ratio(o.max_radius / o.radius, 1.5, 1e6, "max_radius (in units of r)");
  const double default_clamp = o.preset == MEANDER_PRESET_PAPER ? 10 : 3;
  s.segment_length = settle(o.segment_length != 0 ? o.segment_length / surface.scale() : 0.2 * s.radius);
  s.max_radius = settle(o.max_radius != 0 ? o.max_radius / surface.scale() : default_clamp * s.radius);
  require_range(o.length_weight, 0, 1e6, "length_weight");
  require_range(o.bending_weight, 0, 1e6, "bending_weight");
  require_range(o.medial_weight, 1e-6, 1e6, "medial_weight");
  require_range(o.alignment_weight, 0, 1e6, "alignment_weight");
  require_range(o.length_power, 1.5, 8, "length_power");
  require_range(o.medial_power, 2, 8, "medial_power");
  require_range(o.step, 1e-3, 2, "step");
  require_range(o.growth_coarsening, 1, 4, "growth_coarsening");
  require_range(o.start_spacing_factor, 1, 16, "start_spacing_factor");
  require_range(o.polish_bending_weight, 0, 1e6, "polish_bending_weight");
  require_range(o.polish_length_offset, -10, 10, "polish_length_offset");
  require_range(o.polish_length_gain, 0, 100, "polish_length_gain");
  require_range(o.polish_medial_power, 2, 8, "polish_medial_power");
  require(o.polish <= 1, "The option polish must be 0 or 1.");
  require(o.stop_rule <= MEANDER_STOP_PAPER, "The option stop_rule is none of MEANDER_STOP_...");
  require(o.boundary_rule <= MEANDER_BOUNDARY_OBSTACLE, "The option boundary_rule is none of MEANDER_BOUNDARY_...");
  require_range(o.border_distance, 0, 2, "border_distance (in spacings)");
  require(o.boundary_rule == MEANDER_BOUNDARY_CENTRE || o.border_distance == 0.5,
          "A border_distance other than 0.5 needs MEANDER_BOUNDARY_CENTRE; with MEANDER_BOUNDARY_OBSTACLE strands stay "
          "a spacing away from the boundary.");
  require(o.medial_axis <= MEANDER_MEDIAL_AXIS_GEODESIC, "The option medial_axis is none of MEANDER_MEDIAL_AXIS_...");
  require(o.preset <= MEANDER_PRESET_FINEST, "The option preset is none of MEANDER_PRESET_...");
  require(o.iteration_limit >= 1, "The iteration limit must be at least 1.");
  require(o.threads <= 256, "The number of threads must be between 0 (all) and 256.");
  s.length_weight = o.length_weight;
  s.bending_weight = o.bending_weight;
  s.medial_weight = o.medial_weight;
  s.alignment_weight = o.alignment_weight;
  s.length_power = o.length_power;
  s.medial_power = o.medial_power;
  s.step = o.step;
  s.growth_coarsening = o.growth_coarsening;
  s.start_spacing_factor = o.start_spacing_factor;
  s.polish = o.polish != 0;
  s.hairpin_removal_iterations = o.ripening_iterations;
  s.polish_bending_weight = o.polish_bending_weight;
  s.polish_length_offset = o.polish_length_offset;
  s.polish_length_gain = o.polish_length_gain;
  s.polish_medial_power = o.polish_medial_power;
  s.grow_into_empty = s.widen_loops = s.hold_ends = o.preset != MEANDER_PRESET_PAPER;
  s.stop_rule = o.stop_rule == MEANDER_STOP_PAPER ? StopRule::kPaper : StopRule::kSettled;
  s.boundary_rule = o.boundary_rule == MEANDER_BOUNDARY_OBSTACLE ? BoundaryRule::kObstacle : BoundaryRule::kCentre;
  s.border_distance = o.border_distance;
  s.medial_axis = o.medial_axis == MEANDER_MEDIAL_AXIS_GEODESIC ? MedialAxis::kGeodesic : MedialAxis::kEuclidean;
  s.iteration_limit = o.iteration_limit;
  s.threads = o.threads;
  return s;
}

namespace {

/// Sentence `index` about what is allowed but seldom meant; empty beyond the last.
std::string warning(const meander_flow_options& o, uint32_t index) {
  uint32_t found = 0;
  std::string sentence;
  const auto warn = [&](bool holds, const std::string& text) {
    if (holds && found++ == index) sentence = text;
  };
  if (!(std::isfinite(o.radius) && o.radius > 0)) return {};
  const double h = o.segment_length / o.radius, clamp = o.max_radius / o.radius;
  warn(h > 0.4 * (1 + 1e-9) && h <= 1,
       "The segment length is " + number(h) + " of half the spacing; above 0.4 nodes are too far apart to keep strands "
       "at the spacing, so choose at most " + number(0.4 * o.radius) + ".");
  warn(clamp < 2 * (1 - 1e-9) && clamp >= 1.5,
       "The largest medial radius is " + number(clamp) + " times half the spacing; below 2 the curve may not reach "
       "everywhere, so choose at least " + number(2 * o.radius) + ".");
  warn(o.length_weight > 5, "The length weight is " + number(o.length_weight) +
       "; above 5 the curve stays much wider than the spacing, or shrinks to nothing.");
  warn(o.bending_weight > 10, "The bending weight is " + number(o.bending_weight) +
       "; above 10 the curve is too stiff to turn at the spacing and leaves gaps.");
  warn(o.alignment_weight > 5, "The alignment weight is " + number(o.alignment_weight) +
       "; above 5 strands hardly turn round any more, and zigzag across the field instead.");
  return sentence;
}

}  // namespace

}  // namespace meander

meander_status meander_flow_options_init(meander_flow_options* options, uint32_t preset) {
  if (!options || preset > MEANDER_PRESET_FINEST) return MEANDER_INVALID_ARGUMENT;
  meander_flow_options o{};
  o.struct_size = sizeof(meander_flow_options);
  o.preset = preset;
  o.medial_weight = 1;
  o.border_distance = 0.5;
  o.length_power = o.medial_power = 2;
  o.start_spacing_factor = 1;
  o.threads = 0;
  o.medial_axis = MEANDER_MEDIAL_AXIS_EUCLIDEAN;
  if (preset == MEANDER_PRESET_PAPER) {
    o.length_weight = 1;
    o.bending_weight = 0;
    o.step = 1;
    o.growth_coarsening = 1;
    o.polish = 0;
    o.stop_rule = MEANDER_STOP_PAPER;
    o.polish_medial_power = 2;
    o.boundary_rule = MEANDER_BOUNDARY_CENTRE;
    o.iteration_limit = 300;
  } else {
    o.length_weight = 0;
    o.bending_weight = 1;
    o.step = 1.5;
    o.growth_coarsening = 2;
    o.polish = 1;
    o.stop_rule = MEANDER_STOP_SETTLED;
    o.polish_bending_weight = 2;
    o.polish_length_offset = -0.84;
    o.polish_length_gain = 1;
    o.polish_medial_power = 6;
    o.boundary_rule = MEANDER_BOUNDARY_CENTRE;
    o.ripening_iterations = 60;
    o.iteration_limit = 600;
  }
  if (preset == MEANDER_PRESET_FINEST) {
    o.polish_bending_weight = 1.5;
    o.polish_length_offset = -0.5;
    o.ripening_iterations = 300;
    o.iteration_limit = 2500;
  }
  *options = o;
  return MEANDER_OK;
}

size_t meander_flow_options_get_warning(const meander_flow_options* options, uint32_t index, char* text,
                                        size_t capacity) {
  if (!options || options->struct_size != sizeof(meander_flow_options)) return 0;
  const std::string sentence = meander::warning(*options, index);
  if (sentence.empty()) return 0;
  if (text && capacity > 0) {
    const size_t length = std::min(sentence.size(), capacity - 1);
    std::memcpy(text, sentence.data(), length);
    text[length] = '\0';
  }
  return sentence.size() + 1;
}
