// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a run is going to cost.
#include "outputs/cost.h"

#include <cmath>

#include "api/flow_options.h"
#include "api/guard.h"
#include "api/lasting.h"
#include "api/seed.h"
#include "api/structs.h"

using namespace meander;

namespace {

/// In units of r: there may be no surface.
Extent checked_extent(const meander_extent* given, double r) {
  require_struct(given);
  const meander_extent e = read_struct(given);
  for (const double figure : {e.length_area, e.node_area, e.edge_density, e.curvature}) {
    require(std::isfinite(figure) && figure >= 0,
            "A figure of the extent is negative or not finite; measure it again.");
  }
  return {e.faces, e.length_area / r / r, e.node_area / r / r, e.edge_density * r, e.curvature * r * r};
}

}  // namespace

void meander::measure_extent(const meander_surface* surface, const double* density, size_t density_count,
                             meander_extent* extent) {
  require(surface != nullptr, "The surface is NULL.");
  require_struct(extent);
  const Surface& s = *surface->surface;
  const Extent inside = measured_extent(s, checked_density(density, density_count, s, surface->map.get()));
  meander_extent figures{};
  figures.faces = inside.faces;
  figures.length_area = inside.length_area * s.scale() * s.scale();
  figures.node_area = inside.node_area * s.scale() * s.scale();
  figures.edge_density = inside.edge_density / s.scale();
  figures.curvature = inside.curvature / s.scale() / s.scale();
  write_struct(extent, figures);
}

meander_status meander_surface_measure_extent(const meander_surface* surface, const double* density,
                                              size_t density_count, meander_extent* extent, meander_error* error) {
  return guard(error, [&] { measure_extent(surface, density, density_count, extent); });
}

meander_status meander_extent_estimate_cost(const meander_extent* extent, const meander_flow_options* options,
                                            meander_cost* cost, meander_error* error) {
  return guard(error, [&] {
    require_struct(cost);
    const meander_flow_options o = read_options(options);
    const FlowSettings settings = checked_settings_in_radii(o);
    const Cost found = expected_cost(checked_extent(extent, o.radius), settings);
    meander_cost figures{};
    figures.nodes = found.nodes;
    figures.points = found.points;
    figures.length = found.length * o.radius;
    figures.memory = found.memory;
    figures.processor_seconds = found.processor_seconds;
    write_struct(cost, figures);
  });
}
