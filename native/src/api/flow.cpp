// SPDX-License-Identifier: GPL-3.0-or-later
//
// Flows: from a surface and a seed, step after step.
#include <algorithm>
#include <cmath>
#include <functional>

#include "api/caller_mesh.h"
#include "api/constants.h"
#include "api/flow_options.h"
#include "api/found.h"
#include "api/guard.h"
#include "api/lasting.h"
#include "api/lent_progress.h"
#include "api/seed.h"

using namespace meander;

namespace {

using DensityAt = std::function<double(uint32_t)>;

/// Of every vertex; empty: 1.
DensityAt density_at(const VertexData<double>& density) {
  return [&density](uint32_t v) { return density.empty() ? 1 : density[v]; };
}

/// That of a flow as it is.
DensityAt density_at(const Flow& flow) {
  return [&flow](uint32_t v) {
    const double share = flow.settings().radius / flow.asked_radius().at(v);
    return share * share;
  };
}

/// Refuses what would not fit the mesh or the machine.
void check_size(const Surface& surface, const FlowSettings& s, const DensityAt& density, const MeshMap* map) {
  const double nodes = expected_nodes(surface, s, density);
  if (!(nodes <= kMostNodes)) {
    refuse("The curve would need about " + number(nodes) +
           " nodes, and more than 500 million are not supported; choose a larger spacing or a smaller density.");
  }
  for (uint32_t v = 0; v < surface.vertex_count(); ++v) {
    // A settled radius of the whole surface is no larger than half of it.
    if (s.radius <= std::sqrt(density(v)) * (1 + kDensityRounding)) continue;
    const uint32_t vertex = caller_vertex(map, v);
    throw Failure(FailureKind::kInvalidArgument,
                  "The density " + number(density(v)) + " at vertex " + std::to_string(vertex) +
                      " makes the spacing there larger than the surface; choose a larger density.",
                  ElementKind::kVertex, vertex);
  }
}

}  // namespace

meander_stop_reason meander::stop_reason_of(const Flow& flow) {
  switch (flow.stop_reason()) {
    case StopReason::kRunning: return MEANDER_STOP_REASON_RUNNING;
    case StopReason::kConverged: return MEANDER_STOP_REASON_CONVERGED;
    case StopReason::kIterationLimit: return MEANDER_STOP_REASON_ITERATION_LIMIT;
    case StopReason::kStalled: return MEANDER_STOP_REASON_STALLED;
    case StopReason::kCancelled: return MEANDER_STOP_REASON_CANCELLED;
  }
  return MEANDER_STOP_REASON_RUNNING;
}

std::unique_ptr<meander_flow> meander::new_flow(const meander_surface* surface, const meander_seed* seed,
                                                const double* density, size_t density_count,
                                                const meander_flow_options* options, const CancelToken& cancel,
                                                const Tell& tell) {
  require(surface != nullptr, "The surface is NULL.");
  const FlowSettings settings = checked_settings(read_options(options), *surface->surface);
  const VertexData<double> densities =
      checked_density(density, density_count, *surface->surface, surface->map.get());
  cancel.now();
  check_size(*surface->surface, settings, density_at(densities), surface->map.get());
  SeedStrands strands;
  if (seed) strands = checked_seed(seed);
  strands.max_distance /= surface->surface->scale();
  auto made = std::make_unique<meander_flow>();
  made->flow =
      std::make_unique<Flow>(surface->surface, seed ? &strands : nullptr, densities, settings, cancel, tell);
  made->map = surface->map;
  cancel.now();
  return made;
}

meander_status meander_flow_create(const meander_surface* surface, const meander_seed* seed, const double* density,
                                   size_t density_count, const meander_flow_options* options, meander_flow** flow,
                                   meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require(flow != nullptr, "The pointer for the flow is NULL.");
    const LentProgress lent(context);
    *flow = new_flow(surface, seed, density, density_count, options, cancel_of(context), lent.tell()).release();
  });
}

void meander_flow_destroy(meander_flow* flow) { delete flow; }

meander_status meander_flow_step(meander_flow* flow, meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    const auto tell = [&](double share) {
      if (!context) return;
      RunControl& control = *context->control;
      control.tell(*flow->flow, std::max(control.progress.load(), share));
    };
    if (!flow->flow->step(cancel_of(context), tell)) {
      throw Failure(FailureKind::kCancelled, "The step was cancelled.");
    }
    tell(flow->flow->progress());
  });
}

meander_status meander_flow_run(meander_flow* flow, meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    if (context) context->control->begin();
    require_finished(flow->flow->run(cancel_of(context),
                                     [&](double progress) {
                                       if (context) context->control->tell(*flow->flow, progress);
                                     }));
  });
}

meander_status meander_flow_set_radius(meander_flow* flow, double radius, meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    Flow& f = *flow->flow;
    const FlowSettings settings = f.settings().with_radius(checked_radius(radius, f.surface()));
    check_size(f.surface(), settings, density_at(f), flow->map.get());
    f.revise(settings);
  });
}

meander_status meander_flow_set_density(meander_flow* flow, const double* density, size_t density_count,
                                        meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    Flow& f = *flow->flow;
    const VertexData<double> densities = checked_density(density, density_count, f.surface(), flow->map.get());
    check_size(f.surface(), f.settings(), density_at(densities), flow->map.get());
    f.revise(f.settings(), &densities);
  });
}

meander_status meander_flow_set_options(meander_flow* flow, const meander_flow_options* options,
                                        meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    Flow& f = *flow->flow;
    const FlowSettings settings = checked_settings(read_options(options), f.surface());
    check_size(f.surface(), settings, density_at(f), flow->map.get());
    f.revise(settings);
  });
}

meander_stop_reason meander_flow_stop_reason(const meander_flow* flow) {
  if (!flow || flow->job.started()) return MEANDER_STOP_REASON_RUNNING;
  return stop_reason_of(*flow->flow);
}
