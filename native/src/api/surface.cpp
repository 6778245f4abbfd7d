// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces: from a mesh, and their figures.
#include <span>

#include "api/guard.h"
#include "api/lasting.h"
#include "api/lent_progress.h"
#include "api/preparation.h"
#include "api/structs.h"

using namespace meander;

std::unique_ptr<meander_surface> meander::new_surface(const double* vertices, size_t vertex_count,
                                                      const uint32_t* faces, size_t face_count,
                                                      const meander_surface_options* options,
                                                      const CancelToken& cancel, const Tell& tell) {
  require_mesh(vertices, vertex_count, faces, face_count);
  meander_surface_options o{};
  if (options) {
    require_struct(options);
    o = read_struct(options);
  }
  cancel.now();
  auto made =
      prepared_surface(std::span(vertices, 3 * vertex_count), std::span(faces, 3 * face_count), o, cancel, tell);
  cancel.now();
  if (tell) tell(1);
  return made;
}

meander_status meander_surface_create(const double* vertices, size_t vertex_count, const uint32_t* faces,
                                      size_t face_count, const meander_surface_options* options,
                                      meander_surface** surface, meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require(surface != nullptr, "The pointer for the surface is NULL.");
    const LentProgress lent(context);
    auto made = new_surface(vertices, vertex_count, faces, face_count, options, cancel_of(context), lent.tell());
    *surface = made.release();
  });
}

void meander_surface_destroy(meander_surface* surface) { delete surface; }

meander_status meander_surface_get_statistics(const meander_surface* surface, meander_surface_statistics* statistics,
                                              meander_error* error) {
  return guard(error, [&] {
    require(surface != nullptr, "The surface is NULL.");
    require_struct(statistics);
    const Surface& s = *surface->surface;
    const PrepareCounts& p = surface->prepared;
    meander_surface_statistics figures{};
    figures.vertices = s.used_vertices();
    figures.faces = static_cast<uint32_t>(s.face_count());
    figures.components = s.component_count();
    figures.boundary_loops = s.boundary_loop_count();
    figures.flipped_faces = s.flipped_count();
    figures.unused_vertices =
        surface->map ? p.unused_vertices : static_cast<uint32_t>(s.vertex_count()) - s.used_vertices();
    figures.merged_vertices = p.merged_vertices;
    figures.dropped_faces = p.dropped_faces;
    figures.split_vertices = p.split_vertices;
    figures.cut_edges = p.cut_edges;
    figures.masked_faces = p.masked_faces;
    figures.clipped_faces = p.clipped_faces;
    figures.welded_edges = p.welded_edges;
    figures.opened_edges = p.opened_edges;
    figures.doubled_faces = p.doubled_faces;
    figures.split_edges = p.split_edges;
    figures.small_parts = p.small_parts;
    figures.area = s.area() * s.scale() * s.scale();
    figures.diagonal = s.scale();
    write_struct(statistics, figures);
  });
}
