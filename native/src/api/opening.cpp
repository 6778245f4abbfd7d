// SPDX-License-Identifier: GPL-3.0-or-later
//
// What lasts before the first iteration, on a thread of the library's.
#include <utility>

#include "api/guard.h"
#include "api/lasting.h"

using namespace meander;

namespace {

void require_free(const meander_opening* opening) {
  require(opening != nullptr, "The opening is NULL.");
  require(!opening->job.started(), "Something has been begun already; call meander_opening_wait first.");
}

/// Begins work(cancel, tell) on the thread.
template <class Work>
void begin(meander_opening* opening, meander_context* context, Work work) {
  const std::shared_ptr<RunControl> control = context ? context->control : nullptr;
  opening->job.search(
      [work, told = control.get()](const CancelToken& cancel) {
        work(cancel, told ? Tell([told](double share) { told->progress = share; }) : Tell());
      },
      control);
}

}  // namespace

meander_status meander_opening_create(meander_opening** opening, meander_error* error) {
  return guard(error, [&] {
    require(opening != nullptr, "The pointer for the opening is NULL.");
    *opening = std::make_unique<meander_opening>().release();
  });
}

void meander_opening_destroy(meander_opening* opening) { delete opening; }

meander_status meander_opening_start_surface(meander_opening* opening, const double* vertices, size_t vertex_count,
                                             const uint32_t* faces, size_t face_count,
                                             const meander_surface_options* options, meander_surface** surface,
                                             meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require_free(opening);
    require(surface != nullptr, "The pointer for the surface is NULL.");
    begin(opening, context, [=](const CancelToken& cancel, const Tell& tell) {
      opening->surface = new_surface(vertices, vertex_count, faces, face_count, options, cancel, tell);
    });
    opening->surface_place = surface;
  });
}

meander_status meander_opening_start_flow(meander_opening* opening, const meander_surface* surface,
                                          const meander_seed* seed, const double* density, size_t density_count,
                                          const meander_flow_options* options, meander_flow** flow,
                                          meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require_free(opening);
    require(flow != nullptr, "The pointer for the flow is NULL.");
    begin(opening, context, [=](const CancelToken& cancel, const Tell& tell) {
      opening->flow = new_flow(surface, seed, density, density_count, options, cancel, tell);
    });
    opening->flow_place = flow;
  });
}

meander_status meander_opening_start_curvature(meander_opening* opening, const meander_surface* surface,
                                               meander_curvature kind, double smoothing, double* values,
                                               size_t vertex_count, meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require_free(opening);
    begin(opening, context, [=](const CancelToken& cancel, const Tell&) {
      compute_curvature(surface, kind, smoothing, values, vertex_count, cancel);
    });
  });
}

meander_status meander_opening_start_directions(meander_opening* opening, const meander_surface* surface,
                                                meander_directions kind, double smoothing, double* directions,
                                                size_t vertex_count, meander_context* context,
                                                meander_error* error) {
  return guard(error, [&] {
    require_free(opening);
    begin(opening, context, [=](const CancelToken& cancel, const Tell&) {
      compute_directions(surface, kind, smoothing, directions, vertex_count, cancel);
    });
  });
}

meander_status meander_opening_start_extent(meander_opening* opening, const meander_surface* surface,
                                            const double* density, size_t density_count, meander_extent* extent,
                                            meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require_free(opening);
    begin(opening, context, [=](const CancelToken& cancel, const Tell&) {
      cancel.now();
      measure_extent(surface, density, density_count, extent);
    });
  });
}

uint32_t meander_opening_is_running(const meander_opening* opening) {
  return opening && opening->job.running() ? 1 : 0;
}

meander_status meander_opening_wait(meander_opening* opening, meander_error* error) {
  return guard(error, [&] {
    require(opening != nullptr, "The opening is NULL.");
    require(opening->job.started(),
            "Nothing has been begun; call meander_opening_start_surface or another of them first.");
    meander_surface** surface = std::exchange(opening->surface_place, nullptr);
    meander_flow** flow = std::exchange(opening->flow_place, nullptr);
    opening->job.wait();
    if (surface) *surface = opening->surface.release();
    if (flow) *flow = opening->flow.release();
  });
}
