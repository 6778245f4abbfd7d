// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/settings.h"

#include <algorithm>

#include "base/elementary.h"
#include "flow/constants.h"

namespace meander {
namespace {

/// Where strands of these settings come to rest if those that are as stiff as the presets' and follow nothing rest at
/// `free`.
double rest_of(const FlowSettings& settings, double free, bool directed) {
  const double stiffness =
      std::clamp(settings.polish_bending_weight / kUsualBending, 1 / kMostStiffness, kMostStiffness);
  const double looser = elementary::pow(stiffness, kLooserWhereStiff);
  if (!directed) return free * looser;
  const double most = settings.full_start ? kLooserWhereLaid : kLooserWhereGrown;
  const double half = settings.full_start ? kHalfLooserWhereLaid : kHalfLooserWhereGrown;
  const double squared = settings.alignment_weight * settings.alignment_weight;
  return (free + most * squared / (squared + half * half)) * looser;
}

}  // namespace

double FlowSettings::rest(bool directed) const { return polish ? rest_of(*this, polish_rest, directed) : 1; }

double FlowSettings::usual_spacing(bool directed) const {
  return polish ? rest_of(*this, kUsualRest, directed) / rest(directed) : 1;
}

FlowSettings FlowSettings::rescaled(double factor) const {
  FlowSettings settings = *this;
  for (double* length : {&settings.radius, &settings.segment_length, &settings.max_radius}) {
    *length = settle(*length * factor);
  }
  return settings;
}

FlowSettings FlowSettings::with_radius(double r) const {
  FlowSettings settings = *this;
  for (double* length : {&settings.segment_length, &settings.max_radius}) *length = settle(*length / radius * r);
  settings.radius = r;
  return settings;
}

}  // namespace meander
