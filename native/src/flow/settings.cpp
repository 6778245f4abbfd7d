// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/settings.h"

namespace meander {

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
