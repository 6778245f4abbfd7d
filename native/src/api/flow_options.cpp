// SPDX-License-Identifier: GPL-3.0-or-later
#include "api/flow_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "api/constants.h"
#include "api/guard.h"
#include "api/structs.h"

namespace meander {
namespace {

/// require_range for the quotient of two lengths.
void require_ratio(double value, double low, double high, const char* name) {
  require_range(value, low * (1 - kRatioRounding), high * (1 + kRatioRounding), name);
}

void require_radius(double radius) {
  if (std::isfinite(radius) && radius > 0) return;
  refuse("The spacing must be a positive number; it is " + number(2 * radius) + ".");
}

/// `radius` is that of the options in a unit of which `scale` of the caller's are one.
void set_lengths(const meander_flow_options& o, double radius, double scale, FlowSettings& s) {
  s.radius = radius;
  if (o.segment_length != 0) require_ratio(o.segment_length / o.radius, 0.01, 1, "segment_length (in units of r)");
  if (o.max_radius != 0) require_ratio(o.max_radius / o.radius, 1.5, 1e6, "max_radius (in units of r)");
  require_range(o.max_radius_factor, 1.5, 1e6, "max_radius_factor");
  s.segment_length = settle(o.segment_length != 0 ? o.segment_length / scale : kUsualSegment * s.radius);
  s.max_radius = settle(o.max_radius != 0 ? o.max_radius / scale : o.max_radius_factor * s.radius);
}

double checked(double value, const SettingRange& range) {
  require_range(value, range.least, range.greatest, range.name.data());
  return value;
}

/// The fields of kOptions, in its order.
constexpr auto kFields = [] {
  std::array<double meander_flow_options::*, std::size(kOptions)> fields{};
  for (size_t k = 0; k < fields.size(); ++k) {
    for (const NumberField& number : kNumbersOfFlowOptions) {
      if (number.name == kOptions[k].name) fields[k] = number.field;
    }
  }
  return fields;
}();
static_assert(std::ranges::find(kFields, nullptr) == kFields.end(), "an option has a row in kOptions and no field");
static_assert(std::size(kTunings) <= std::size(meander_flow_options{}.tunings));

void set_numbers(const meander_flow_options& o, FlowSettings& s) {
  for (size_t k = 0; k < std::size(kOptions); ++k) s.*kOptions[k].value = checked(o.*kFields[k], kOptions[k]);
  for (size_t k = 0; k < std::size(kTunings); ++k) s.*kTunings[k].value = checked(o.tunings[k], kTunings[k]);
}

void set_flags(const meander_flow_options& o, FlowSettings& s) {
  require_flag(o.grow_into_empty, "grow_into_empty");
  require_flag(o.widen_loops, "widen_loops");
  require_flag(o.hold_ends, "hold_ends");
  require_flag(o.polish, "polish");
  s.grow_into_empty = o.grow_into_empty != 0;
  s.widen_loops = o.widen_loops != 0;
  s.hold_ends = o.hold_ends != 0;
  s.polish = o.polish != 0;
}

void set_rules(const meander_flow_options& o, FlowSettings& s) {
  require(o.stop_rule <= MEANDER_STOP_RULE_PAPER, "The option stop_rule is none of MEANDER_STOP_RULE_...");
  require(o.boundary_rule <= MEANDER_BOUNDARY_RULE_OBSTACLE,
          "The option boundary_rule is none of MEANDER_BOUNDARY_RULE_...");
  require(o.boundary_rule == MEANDER_BOUNDARY_RULE_CENTRE || o.boundary_distance == 0.5,
          "A boundary_distance other than 0.5 needs MEANDER_BOUNDARY_RULE_CENTRE; with MEANDER_BOUNDARY_RULE_OBSTACLE "
          "strands stay a spacing away from the boundary.");
  require(o.medial_axis <= MEANDER_MEDIAL_AXIS_GEODESIC, "The option medial_axis is none of MEANDER_MEDIAL_AXIS_...");
  require(o.start <= MEANDER_START_FULL, "The option start is none of MEANDER_START_...");
  require(o.iteration_limit >= 1, "The iteration limit must be at least 1.");
  require_threads(o.threads);
  s.stop_rule = o.stop_rule == MEANDER_STOP_RULE_PAPER ? StopRule::kPaper : StopRule::kSettled;
  s.boundary_rule = o.boundary_rule == MEANDER_BOUNDARY_RULE_OBSTACLE ? BoundaryRule::kObstacle : BoundaryRule::kCentre;
  s.medial_axis = o.medial_axis == MEANDER_MEDIAL_AXIS_GEODESIC ? MedialAxis::kGeodesic : MedialAxis::kEuclidean;
  s.full_start = o.start == MEANDER_START_FULL;
  s.hairpin_removal_iterations = o.hairpin_removal_iterations;
  s.variation = o.variation;
  s.iteration_limit = o.iteration_limit;
  s.threads = o.threads;
}

void set_all_but_lengths(const meander_flow_options& o, FlowSettings& s) {
  set_numbers(o, s);
  set_flags(o, s);
  set_rules(o, s);
}

/// Where a tuning is in the struct.
size_t index_of_tuning(std::string_view name) {
  const auto* const found = std::ranges::find(kTunings, name, &SettingRange::name);
  if (found != std::end(kTunings)) return static_cast<size_t>(found - kTunings);
  std::string names;
  for (const SettingRange& tuning : kTunings) names += (names.empty() ? "" : ", ") + std::string(tuning.name);
  refuse("There is no tuning '" + std::string(name.substr(0, 80)) + "'; there are " + names + ".");
}

/// What is allowed but seldom meant, one sentence each.
std::vector<std::string> warnings_of(const meander_flow_options& o) {
  std::vector<std::string> sentences;
  if (!(std::isfinite(o.radius) && o.radius > 0)) return sentences;
  const double h = o.segment_length / o.radius, clamp = o.max_radius / o.radius;
  if (h > 0.4 * (1 + 1e-9) && h <= 1) {
    sentences.push_back("The segment length is " + number(h / 2) +
                        " of the spacing; above 0.2 nodes are too far apart to keep strands at the spacing, so "
                        "choose at most " + number(0.4 * o.radius) + ".");
  }
  if (clamp < 2 * (1 - 1e-9) && clamp >= 1.5) {
    sentences.push_back("The largest medial radius is " + number(clamp / 2) +
                        " times the spacing; below 1 the curve may not reach everywhere, so choose at least " +
                        number(2 * o.radius) + ".");
  }
  const auto warn_above = [&](double weight, double most, const char* name, const char* consequence) {
    if (!(weight > most)) return;
    sentences.push_back(std::string("The ") + name + " is " + number(weight) + "; above " + number(most) + consequence);
  };
  warn_above(o.length_weight, 5, "length weight",
             " the curve stays much wider than the spacing, or shrinks to nothing.");
  warn_above(o.bending_weight, 10, "bending weight",
             " the curve is too stiff to turn at the spacing and leaves gaps.");
  if (o.start == MEANDER_START_GROW) {
    warn_above(o.alignment_weight, 5, "alignment weight",
               " strands that grow hardly turn any more, and zigzag across the field instead; a full start does not.");
  }
  return sentences;
}

}  // namespace

meander_flow_options default_options(meander_preset preset) {
  meander_flow_options o{};
  o.struct_size = sizeof o;
  o.preset = preset;
  o.medial_weight = 1;
  o.length_power = o.medial_power = 2;
  o.start_spacing_factor = 1;
  o.boundary_distance = 0.5;
  if (preset == MEANDER_PRESET_PAPER) {
    o.max_radius_factor = 10;
    o.length_weight = 1;
    o.step = 1;
    o.tunings[index_of_tuning("growth_coarsening")] = 1;
    o.tunings[index_of_tuning("polish_medial_power")] = 2;
    o.tunings[index_of_tuning("polish_rest")] = 1;
    o.stop_rule = MEANDER_STOP_RULE_PAPER;
    o.iteration_limit = 300;
    o.roughness = 1;
    return o;
  }
  const bool finest = preset == MEANDER_PRESET_FINEST;
  o.max_radius_factor = 3;
  o.bending_weight = 1;
  o.step = 1.5;
  o.grow_into_empty = o.widen_loops = o.hold_ends = 1;
  o.hairpin_removal_iterations = finest ? 600 : 70;
  o.polish = 1;
  o.polish_bending_weight = 1.2;
  o.medial_axis = MEANDER_MEDIAL_AXIS_GEODESIC;
  o.iteration_limit = finest ? 2500 : 900;
  o.start = finest ? MEANDER_START_FULL : MEANDER_START_GROW;
  o.tunings[index_of_tuning("growth_coarsening")] = finest ? 2.5 : 3;
  o.tunings[index_of_tuning("hairpin_removal_gentleness")] = finest ? 1 : 0;
  o.tunings[index_of_tuning("polish_length_offset")] = finest ? -2.8 : -1.16;
  o.tunings[index_of_tuning("polish_length_gain")] = finest ? 16 : 3;
  o.tunings[index_of_tuning("polish_medial_power")] = 8;
  o.tunings[index_of_tuning("polish_rest")] = kUsualRest;
  return o;
}

meander_flow_options read_options(const meander_flow_options* given) {
  require_struct(given);
  require(given->preset <= MEANDER_PRESET_FINEST, "The option preset is none of MEANDER_PRESET_...");
  return read_struct(given, default_options(given->preset));
}

double checked_radius(double radius, const Surface& surface) {
  require_radius(radius);
  const double r = settle(radius / surface.scale());
  if (2 * r > 1) {
    refuse("The spacing " + number(2 * radius) + " is larger than the surface (its diagonal is " +
           number(surface.scale()) + "); choose a smaller spacing.");
  }
  if (4 * r * r > surface.area()) {
    const double side = surface.scale() * std::sqrt(surface.area());
    refuse("The spacing " + number(2 * radius) +
           " is larger than the side of a square of the surface's area, which is " + number(side) +
           "; choose a smaller spacing.");
  }
  return r;
}

FlowSettings checked_settings(const meander_flow_options& options, const Surface& surface) {
  FlowSettings settings;
  set_lengths(options, checked_radius(options.radius, surface), surface.scale(), settings);
  set_all_but_lengths(options, settings);
  return settings;
}

FlowSettings checked_settings_in_radii(const meander_flow_options& options) {
  require_radius(options.radius);
  FlowSettings settings;
  set_lengths(options, 1, options.radius, settings);
  set_all_but_lengths(options, settings);
  return settings;
}

}  // namespace meander

using namespace meander;

meander_status meander_flow_options_init(meander_flow_options* options, size_t struct_size, meander_preset preset) {
  if (preset > MEANDER_PRESET_FINEST) return MEANDER_STATUS_INVALID_ARGUMENT;
  return init_struct(options, struct_size, default_options(preset));
}

meander_status meander_flow_options_get_warning(const meander_flow_options* options, size_t index, char* text,
                                                size_t capacity, size_t* size, meander_error* error) {
  return guard(error, [&] {
    require(size != nullptr, "The pointer for the size is NULL.");
    require(text || capacity == 0, "The text is NULL but has a capacity.");
    const std::vector<std::string> sentences = warnings_of(read_options(options));
    *size = index < sentences.size() ? sentences[index].size() + 1 : 0;
    if (*size == 0 || capacity == 0) return;
    const size_t length = std::min(*size, capacity) - 1;
    std::memcpy(text, sentences[index].data(), length);
    text[length] = '\0';
  });
}

const char* meander_tuning_name(size_t index) {
  return index < std::size(kTunings) ? kTunings[index].name.data() : nullptr;
}

meander_status meander_flow_options_set_tuning(meander_flow_options* options, const char* name, double value,
                                               meander_error* error) {
  return guard(error, [&] {
    require_struct(options);
    require(name != nullptr, "The name of the tuning is NULL.");
    const size_t index = index_of_tuning(name);
    options->tunings[index] = checked(value, kTunings[index]);
  });
}

meander_status meander_flow_options_get_tuning(const meander_flow_options* options, const char* name, double* value,
                                               meander_error* error) {
  return guard(error, [&] {
    require_struct(options);
    require(name != nullptr, "The name of the tuning is NULL.");
    require(value != nullptr, "The pointer for the value is NULL.");
    *value = options->tunings[index_of_tuning(name)];
  });
}
