// SPDX-License-Identifier: GPL-3.0-or-later
//
// What lasts before the first iteration of a flow, for the calls that do it at once, and for an opening.
#pragma once

#include <memory>

#include "api/handles.h"
#include "base/cancel_token.h"
#include "base/tell.h"

namespace meander {

// Arguments are those of the calls of the header. All throw Failure, where `cancel` stops them too.

std::unique_ptr<meander_surface> new_surface(const double* vertices, size_t vertex_count, const uint32_t* faces,
                                             size_t face_count, const meander_surface_options* options,
                                             const CancelToken& cancel, const Tell& tell);

std::unique_ptr<meander_flow> new_flow(const meander_surface* surface, const meander_seed* seed,
                                       const double* density, size_t density_count,
                                       const meander_flow_options* options, const CancelToken& cancel,
                                       const Tell& tell);

void compute_curvature(const meander_surface* surface, meander_curvature kind, double smoothing, double* values,
                       size_t vertex_count, const CancelToken& cancel);

void compute_directions(const meander_surface* surface, meander_directions kind, double smoothing,
                        double* directions, size_t vertex_count, const CancelToken& cancel);

void measure_extent(const meander_surface* surface, const double* density, size_t density_count,
                    meander_extent* extent);

}  // namespace meander
