// SPDX-License-Identifier: GPL-3.0-or-later
//
// Flows: from a surface and a seed, step after step.
#include <cmath>

#include "api/caller_mesh.h"
#include "api/flow_options.h"
#include "api/guard.h"
#include "api/seed.h"

using namespace meander;

namespace {

/// Refuses what would not fit the mesh or the machine.
void check_size(const Surface& surface, const FlowSettings& s, const VertexData<double>& density,
                const MeshMap* map) {
  const double nodes = expected_nodes(surface, s, [&](uint32_t v) { return density.empty() ? 1 : density[v]; });
  if (!(nodes <= kMostNodes)) {
    refuse("The curve would need about " + number(nodes) +
           " nodes, and more than 500 million are not supported; choose a larger spacing or a smaller density.");
  }
  for (size_t v = 0; v < density.size(); ++v) {
    if (s.radius <= std::sqrt(density[v])) continue;
    const uint32_t vertex = caller_vertex(map, static_cast<uint32_t>(v));
    throw Failure(FailureKind::kInvalidArgument,
                  "The density " + number(density[v]) + " at vertex " + std::to_string(vertex) +
                      " makes the spacing there larger than the surface; choose a larger density.",
                  ElementKind::kVertex, vertex);
  }
}

meander_stop_reason public_reason(StopReason reason) {
  switch (reason) {
    case StopReason::kRunning: return MEANDER_STOP_REASON_RUNNING;
    case StopReason::kConverged: return MEANDER_STOP_REASON_CONVERGED;
    case StopReason::kIterationLimit: return MEANDER_STOP_REASON_ITERATION_LIMIT;
    case StopReason::kStalled: return MEANDER_STOP_REASON_STALLED;
    case StopReason::kCancelled: return MEANDER_STOP_REASON_CANCELLED;
  }
  return MEANDER_STOP_REASON_RUNNING;
}

}  // namespace

meander_status meander_flow_create(const meander_surface* surface, const meander_seed* seed, const double* density,
                                   size_t density_count, const meander_flow_options* options, meander_flow** flow,
                                   meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require(surface != nullptr, "The surface is NULL.");
    require(flow != nullptr, "The pointer for the flow is NULL.");
    const FlowSettings settings = checked_settings(read_options(options), *surface->surface);
    const VertexData<double> densities = checked_density(density, density_count, *surface);
    check_cancelled(context);
    check_size(*surface->surface, settings, densities, surface->map.get());
    SeedStrands strands;
    if (seed) strands = checked_seed(seed);
    strands.reach /= surface->surface->scale();
    auto made = std::make_unique<meander_flow>();
    made->flow = std::make_unique<Flow>(surface->surface, seed ? &strands : nullptr, densities, settings);
    made->map = surface->map;
    check_cancelled(context);
    *flow = made.release();
  });
}

void meander_flow_destroy(meander_flow* flow) { delete flow; }

meander_status meander_flow_step(meander_flow* flow, meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    if (!flow->flow->step([&] { return cancelled(context); })) {
      throw Failure(FailureKind::kCancelled, "The step was cancelled.");
    }
  });
}

meander_status meander_flow_run(meander_flow* flow, meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    if (context) context->control->begin();
    require_finished(flow->flow->run([&] { return cancelled(context); },
                                     [&](double progress) {
                                       if (context) context->control->tell(*flow->flow, progress);
                                     }));
  });
}

meander_stop_reason meander_flow_stop_reason(const meander_flow* flow) {
  if (!flow || flow->job.started()) return MEANDER_STOP_REASON_RUNNING;
  return public_reason(flow->flow->stop_reason());
}
