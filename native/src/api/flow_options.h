// SPDX-License-Identifier: GPL-3.0-or-later
//
// The options of a flow.
#pragma once

#include "flow/settings.h"
#include "meander/meander.h"
#include "mesh/surface.h"

namespace meander {

/// The defaults of a preset, the only ones there are; the preset must be one of MEANDER_PRESET_...
meander_flow_options default_options(meander_preset preset);

/// Options of the caller's as this library knows them; throws Failure.
meander_flow_options read_options(const meander_flow_options* given);

/// r in the surface's own unit; throws Failure where it is no length, or has no room on the surface.
double checked_radius(double radius, const Surface& surface);

/// Options as the flow wants them, lengths in the surface's own unit; throws Failure.
FlowSettings checked_settings(const meander_flow_options& options, const Surface& surface);

/// The same without a surface, lengths in units of r; throws Failure.
FlowSettings checked_settings_in_radii(const meander_flow_options& options);

}  // namespace meander
