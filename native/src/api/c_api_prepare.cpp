// SPDX-License-Identifier: GPL-3.0-or-later
//
// The border: surfaces from meshes that are prepared first.
#include "api/handles.h"
#include "base/thread_pool.h"
#include "mesh/mesh_check.h"

using namespace meander;

namespace {

PrepareSettings checked_settings(const meander_surface_options& o, size_t vertex_count, size_t face_count) {
  PrepareSettings s;
  if (!(std::isfinite(o.merge_distance) && o.merge_distance >= 0)) {
    refuse("The merge distance is " + number(o.merge_distance) + "; it must be 0 or a positive number.");
  }
  require(o.drop_degenerate <= 1, "The option drop_degenerate must be 0 or 1.");
  require(o.split_bow_ties <= 1, "The option split_bow_ties must be 0 or 1.");
  require(o.cut_non_manifold <= 1, "The option cut_non_manifold must be 0 or 1.");
  require(o.threads <= 256, "The number of threads must be between 0 (all) and 256.");
  require(std::isfinite(o.mask_threshold), "The mask's threshold must be a finite number.");
  s.merge_distance = o.merge_distance;
  s.drop_degenerate = o.drop_degenerate != 0;
  s.split_bow_ties = o.split_bow_ties != 0;
  s.cut_non_manifold = o.cut_non_manifold != 0;
  s.mask_threshold = o.mask_threshold;
  if (o.face_mask) s.face_mask = {o.face_mask, face_count};
  if (o.vertex_mask) {
    s.vertex_mask = {o.vertex_mask, vertex_count};
    for (size_t v = 0; v < vertex_count; ++v) {
      if (std::isfinite(o.vertex_mask[v])) continue;
      throw Failure(FailureKind::kInvalidArgument,
                    "The mask's value at vertex " + std::to_string(v) + " is not a finite number.",
                    ElementKind::kVertex, static_cast<uint32_t>(v));
    }
  }
  return s;
}

/// The surface of a prepared mesh; what it refuses is said of the caller's mesh.
std::shared_ptr<const Surface> surface_of(const PreparedMesh& mesh, unsigned threads) {
  try {
    return std::make_shared<const Surface>(mesh.vertices, mesh.faces, threads);
  } catch (const Failure& failure) {
    ThreadPool pool(1);
    check_mesh(mesh.vertices, mesh.faces, pool, &mesh.map);  // throws the same with the caller's names
    if (failure.element != ElementKind::kFace) throw;
    const uint32_t face = mesh.map.face(failure.index);
    throw Failure(failure.kind, "Face " + std::to_string(face) + " has no area; dissolve degenerate faces.",
                  ElementKind::kFace, face);
  }
}

}  // namespace

extern "C" {

meander_status meander_surface_options_init(meander_surface_options* options) {
  if (!options) return MEANDER_INVALID_ARGUMENT;
  *options = {};
  options->struct_size = sizeof(meander_surface_options);
  return MEANDER_OK;
}

meander_status meander_surface_create_prepared(const double* vertices, size_t vertex_count, const uint32_t* faces,
                                               size_t face_count, const meander_surface_options* options,
                                               meander_surface** surface, meander_error* error) {
  return guard(error, [&] {
    require_mesh(vertices, vertex_count, faces, face_count, surface);
    require_struct(options, "meander_surface_options");
    const std::span<const double> v(vertices, 3 * vertex_count);
    const std::span<const uint32_t> f(faces, 3 * face_count);
    const PrepareSettings settings = checked_settings(*options, vertex_count, face_count);
    auto made = std::make_unique<meander_surface>();
    if (settings.changes_nothing()) {
      made->surface = std::make_shared<const Surface>(v, f, options->threads);
    } else {
      check_numbers(v, f);
      PreparedMesh mesh = prepare_mesh(v, f, settings);
      made->surface = surface_of(mesh, options->threads);
      made->prepared = mesh.counts;
      made->map = std::make_shared<const MeshMap>(std::move(mesh.map));
    }
    *surface = made.release();
    return MEANDER_OK;
  });
}

}  // extern "C"
