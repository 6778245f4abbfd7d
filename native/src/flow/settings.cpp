// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/settings.h"

#include <algorithm>

#include "base/elementary.h"
#include "flow/constants.h"

namespace meander {

double FlowSettings::rest(bool directed) const {
  if (!polish) return 1;
  const double stiffness =
      std::clamp(polish_bending_weight / kUsualBending, 1 / kMostStiffness, kMostStiffness);
  const double looser = elementary::pow(stiffness, kLooserWhereStiff);
  if (!directed) return polish_rest * looser;
  const double most = full_start ? kLooserWhereLaid : kLooserWhereGrown;
  const double half = full_start ? kHalfLooserWhereLaid : kHalfLooserWhereGrown;
  const double squared = alignment_weight * alignment_weight;
  return (polish_rest + most * squared / (squared + half * half)) * looser;
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
