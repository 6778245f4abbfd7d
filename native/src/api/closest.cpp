// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of a mesh, or of a surface, that are nearest to points in space.
#include <algorithm>
#include <cmath>

#include "api/caller_mesh.h"
#include "api/guard.h"
#include "mesh/closest_point.h"
#include "outputs/polylines.h"

using namespace meander;

namespace {

std::span<const double> checked_points(const double* points, size_t count) {
  require(points != nullptr || count == 0, "The array of the points is NULL.");
  require(count <= size_t{1} << 30, "There are more than 2^30 points; ask for some of them at a time.");
  for (size_t i = 0; i < 3 * count; ++i) {
    if (std::isfinite(points[i])) continue;
    refuse("Point " + std::to_string(i / 3) + " has a coordinate that is not a finite number; leave it out.");
  }
  return {points, 3 * count};
}

void write(const ClosestPlaces& places, uint32_t* faces, double* weights, double* distances) {
  if (faces) std::ranges::copy(places.faces, faces);
  if (distances) std::ranges::copy(places.distances, distances);
  for (const auto& of_point : places.weights) {
    if (weights) weights = std::ranges::copy(of_point, weights).out;
  }
}

}  // namespace

meander_status meander_mesh_find_closest(const double* vertices, size_t vertex_count, const uint32_t* faces,
                                         size_t face_count, const double* points, size_t point_count,
                                         uint32_t threads, uint32_t* closest_faces, double* weights,
                                         double* distances, meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require_mesh(vertices, vertex_count, faces, face_count);
    require_threads(threads);
    const std::span<const double> asked = checked_points(points, point_count);
    check_cancelled(context);
    ThreadPool pool = ThreadPool(threads).with(cancel_of(context));
    const ClosestPlaces places =
        closest_places(std::span(vertices, 3 * vertex_count), std::span(faces, 3 * face_count), asked, pool);
    check_cancelled(context);
    write(places, closest_faces, weights, distances);
  });
}

meander_status meander_surface_find_closest(const meander_surface* surface, const double* points, size_t point_count,
                                            uint32_t threads, uint32_t* closest_faces, double* weights,
                                            double* distances, meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require(surface != nullptr, "The surface is NULL.");
    require_threads(threads);
    const std::span<const double> asked = checked_points(points, point_count);
    check_cancelled(context);
    ThreadPool pool = ThreadPool(threads).with(cancel_of(context));
    const Surface& s = *surface->surface;
    const MeshMap* map = surface->map.get();
    ClosestPlaces places = closest_places(s, asked, pool);
    check_cancelled(context);
    for (size_t i = 0; i < point_count; ++i) {
      places.weights[i] = caller_weights(s, map, places.faces[i], places.weights[i]);
      places.faces[i] = caller_face(map, places.faces[i]);
    }
    write(places, closest_faces, weights, distances);
  });
}
