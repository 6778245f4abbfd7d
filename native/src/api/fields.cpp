// SPDX-License-Identifier: GPL-3.0-or-later
//
// Curvature and directions of a surface, and the directions that a flow follows.
#include <algorithm>
#include <cmath>

#include "api/caller_mesh.h"
#include "api/constants.h"
#include "api/guard.h"
#include "api/lasting.h"
#include "api/offsets.h"
#include "mesh/fields.h"

using namespace meander;

namespace {

void require_vertices(size_t given, const Surface& surface, const MeshMap* map, const void* array) {
  require(array != nullptr, "The array of the vertices is NULL.");
  const size_t wanted = caller_vertex_count(surface, map);
  if (given == wanted) return;
  refuse("The array has " + std::to_string(given) + " entries; it must have one for each of the " +
         std::to_string(wanted) + " vertices of the surface.");
}

double checked_smoothing(double smoothing, const Surface& surface) {
  if (std::isfinite(smoothing) && smoothing >= 0 && smoothing <= surface.scale()) return smoothing / surface.scale();
  refuse("The smoothing radius is " + number(smoothing) + "; it must be between 0 and the mesh's diagonal, " +
         number(surface.scale()) + ".");
}

/// Calls give(caller's vertex, vertex of the surface) so that every vertex of the caller's that the
/// surface has got is the last time given its own.
template <class Give>
void for_caller_vertices(const Surface& surface, const MeshMap* map, Give&& give) {
  for (const bool own : {false, true}) {  // first those that a cut has made
    for (uint32_t v = 0; v < surface.vertex_count(); ++v) {
      const bool is_own = !map || map->vertex_origin(v).t == 0;
      if (is_own == own) give(caller_vertex(map, v), v);
    }
  }
}

void write(const Surface& surface, const MeshMap* map, const VertexData<Vec3>& directions, double* out) {
  std::fill_n(out, 3 * caller_vertex_count(surface, map), 0.0);
  for_caller_vertices(surface, map, [&](uint32_t theirs, uint32_t v) {
    std::copy_n(directions[v].data(), 3, out + 3 * size_t{theirs});
  });
}

/// `p`, or if it is farther away the point at kFarAway in its direction.
Vec3 within_reach(const Vec3& p, const Surface& surface) {
  const Vec3 from = surface.position(surface.face(0)[0]);
  Vec3 way = p - from;
  const double farthest = way.cwiseAbs().maxCoeff();
  if (farthest <= kFarAway) return p;
  for (double& x : way) x = std::isfinite(farthest) ? x / farthest : std::isinf(x) ? std::copysign(1, x) : 0;
  return from + kFarAway * way;
}

/// Points of strokes in the surface's own space.
std::vector<Vec3> checked_points(const double* points, size_t count, const Surface& surface) {
  std::vector<Vec3> inside;
  for (size_t i = 0; i < count; ++i) {
    const Vec3 p(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    if (!p.allFinite()) {
      refuse("Stroke point " + std::to_string(i) + " has a coordinate that is not a finite number.");
    }
    inside.push_back(within_reach(surface.to_inside(p), surface));
  }
  return inside;
}

VertexData<Vec3> directions_of(const Surface& s, meander_directions kind, double radius,
                               const CancelToken& cancel) {
  switch (kind) {
    case MEANDER_DIRECTIONS_SMOOTH: return smoothest_directions(s, cancel);
    case MEANDER_DIRECTIONS_BOUNDARY: return boundary_directions(s, cancel);
    default: return principal_directions(s, kind == MEANDER_DIRECTIONS_CURVATURE_MAX, radius, cancel);
  }
}

}  // namespace

void meander::compute_curvature(const meander_surface* surface, meander_curvature kind, double smoothing,
                                double* values, size_t vertex_count, const CancelToken& cancel) {
  require(surface != nullptr, "The surface is NULL.");
  require(kind <= MEANDER_CURVATURE_CURVEDNESS, "The curvature is none of MEANDER_CURVATURE_...");
  const Surface& s = *surface->surface;
  const MeshMap* map = surface->map.get();
  require_vertices(vertex_count, s, map, values);
  const double radius = checked_smoothing(smoothing, s);
  const bool gaussian = kind == MEANDER_CURVATURE_GAUSSIAN || kind == MEANDER_CURVATURE_ABSOLUTE_GAUSSIAN;
  const double unit = gaussian ? 1 / (s.scale() * s.scale()) : 1 / s.scale();
  cancel.now();
  const VertexData<double> x = curvature(s, static_cast<CurvatureKind>(kind), radius, cancel);
  cancel.now();
  std::fill_n(values, vertex_count, 0.0);
  for_caller_vertices(s, map, [&](uint32_t theirs, uint32_t v) { values[theirs] = x[v] * unit; });
}

void meander::compute_directions(const meander_surface* surface, meander_directions kind, double smoothing,
                                 double* directions, size_t vertex_count, const CancelToken& cancel) {
  require(surface != nullptr, "The surface is NULL.");
  require(kind <= MEANDER_DIRECTIONS_BOUNDARY, "The kind is none of MEANDER_DIRECTIONS_...");
  const Surface& s = *surface->surface;
  const MeshMap* map = surface->map.get();
  require_vertices(vertex_count, s, map, directions);
  const double radius = checked_smoothing(smoothing, s);
  cancel.now();
  const VertexData<Vec3> found = directions_of(s, kind, radius, cancel);
  cancel.now();
  write(s, map, found, directions);
}

meander_status meander_surface_compute_curvature(const meander_surface* surface, meander_curvature kind,
                                                 double smoothing, double* values, size_t vertex_count,
                                                 meander_context* context, meander_error* error) {
  return guard(error,
               [&] { compute_curvature(surface, kind, smoothing, values, vertex_count, cancel_of(context)); });
}

meander_status meander_surface_compute_directions(const meander_surface* surface, meander_directions kind,
                                                  double smoothing, double* directions, size_t vertex_count,
                                                  meander_context* context, meander_error* error) {
  return guard(error,
               [&] { compute_directions(surface, kind, smoothing, directions, vertex_count, cancel_of(context)); });
}

meander_status meander_surface_compute_stroke_directions(const meander_surface* surface, const double* points,
                                                         size_t point_count, const uint64_t* offsets,
                                                         size_t stroke_count, double* directions,
                                                         size_t vertex_count, meander_context* context,
                                                         meander_error* error) {
  return guard(error, [&] {
    require(surface != nullptr, "The surface is NULL.");
    require(stroke_count >= 1, "There are no strokes; draw at least one.");
    require(points && offsets, "A pointer of the strokes is NULL.");
    const Surface& s = *surface->surface;
    const MeshMap* map = surface->map.get();
    require_vertices(vertex_count, s, map, directions);
    const std::vector<uint32_t> ends = checked_offsets(offsets, stroke_count, point_count, "strokes");
    const std::vector<Vec3> inside = checked_points(points, point_count, s);
    std::vector<Stroke> strokes;
    for (size_t g = 0; g < stroke_count; ++g) {
      strokes.push_back(std::span(inside).subspan(ends[g], ends[g + 1] - ends[g]));
    }
    check_cancelled(context);
    const VertexData<Vec3> found = extended_directions(s, strokes, cancel_of(context));
    check_cancelled(context);
    write(s, map, found, directions);
  });
}

meander_status meander_surface_turn_directions(const meander_surface* surface, double* directions,
                                               const double* angles, size_t vertex_count, meander_context* context,
                                               meander_error* error) {
  return guard(error, [&] {
    require(surface != nullptr, "The surface is NULL.");
    const Surface& s = *surface->surface;
    const MeshMap* map = surface->map.get();
    require_vertices(vertex_count, s, map, directions);
    require(angles != nullptr, "The array of the angles is NULL.");
    for (size_t v = 0; v < vertex_count; ++v) {
      if (std::abs(angles[v]) <= 0x1p30) continue;
      refuse("The angle of vertex " + std::to_string(v) + " is " + number(angles[v]) +
             "; it must be a finite number of radians.");
    }
    for (size_t k = 0; k < 3 * vertex_count; ++k) {
      if (std::isfinite(directions[k])) continue;
      refuse("The direction of vertex " + std::to_string(k / 3) + " is not finite.");
    }
    check_cancelled(context);
    VertexData<Vec3> lines(s.vertex_count(), Vec3::Zero());
    VertexData<double> turns(s.vertex_count(), 0.0);
    for (uint32_t v = 0; v < s.vertex_count(); ++v) {
      const size_t theirs = caller_vertex(map, v);
      lines[v] = Vec3(directions[3 * theirs], directions[3 * theirs + 1], directions[3 * theirs + 2]);
      turns[v] = angles[theirs];
    }
    const VertexData<Vec3> turned = turned_directions(s, lines, turns, cancel_of(context));
    check_cancelled(context);
    write(s, map, turned, directions);
  });
}

meander_status meander_flow_set_directions(meander_flow* flow, const double* directions, size_t vertex_count,
                                           meander_alignment alignment, meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require(alignment <= MEANDER_ALIGNMENT_ACROSS, "The alignment is none of MEANDER_ALIGNMENT_...");
    Flow& f = *flow->flow;
    require(f.history().empty(), "Directions must be set before the first iteration.");
    if (!directions) {
      f.set_field({});
      return;
    }
    const Surface& s = f.surface();
    require_vertices(vertex_count, s, flow->map.get(), directions);
    VertexData<Vec3> vectors(s.vertex_count(), Vec3::Zero());
    for (uint32_t v = 0; v < s.vertex_count(); ++v) {
      // Lines have no sign, so where an edge has been cut the nearer end speaks.
      const double* d = directions + 3 * size_t{caller_vertex(flow->map.get(), v)};
      vectors[v] = Vec3(d[0], d[1], d[2]);
    }
    LineField field(s, vectors, alignment == MEANDER_ALIGNMENT_ACROSS);
    require(!field.empty(), "No vertex has a direction in the surface; give a vector other than 0 0 0 to some.");
    f.set_field(std::move(field));
  });
}
