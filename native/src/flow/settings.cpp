// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/settings.h"

#include "flow/constants.h"

namespace meander {

double FlowSettings::rest(bool directed) const {
  if (!polish) return 1;
  if (!directed) return polish_rest;
  const double squared = alignment_weight * alignment_weight;
  return polish_rest + kLooserAlongField * squared / (squared + kHalfLooser * kHalfLooser);
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
