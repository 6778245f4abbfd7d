/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fields on a surface, and lines along its boundary. Part of meander.h. */
#ifndef MEANDER_FIELDS_H
#define MEANDER_FIELDS_H

#include "surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What meander_surface_compute_curvature computes at a vertex. */
typedef uint32_t meander_curvature;
enum {
  MEANDER_CURVATURE_GAUSSIAN = 0,          /* angle defect over area */
  MEANDER_CURVATURE_MEAN = 1,              /* (k1 + k2) / 2; positive where the surface bulges outwards */
  MEANDER_CURVATURE_ABSOLUTE_GAUSSIAN = 2, /* |k1 k2|, the absolute value taken before the smoothing */
  MEANDER_CURVATURE_ABSOLUTE_MEAN = 3,     /* |k1 + k2| / 2, likewise */
  MEANDER_CURVATURE_CURVEDNESS = 4         /* sqrt((k1^2 + k2^2) / 2), likewise */
};

/* Curvature of the surface at its vertices, for use as a density (Fig. 23).
 *
 * Gaussian: angle defects. Mean and principal curvatures: the angles between faces, Cohen-Steiner and
 * Morvan, "Restricted Delaunay Triangulations and Normal Cycle", SoCG 2003. Both count per area, so
 * they converge with refinement, and both are 0 across the boundary. Smoothing is one implicit step of
 * diffusion, Desbrun, Meyer, Schroder, Barr, "Implicit Fairing of Irregular Meshes using Diffusion and
 * Curvature Flow", SIGGRAPH 1999, which keeps the integral.
 *
 * curvature     MEANDER_CURVATURE_...
 * smoothing     radius over which values are averaged, in the caller's units; 0: none; at most the
 *               diagonal. About the spacing is a good value
 * values        receives double[vertex_count]: 1 / length^2 for the Gaussian kinds, else 1 / length;
 *               0 at vertices that no face of the surface uses
 * vertex_count  as passed to meander_surface_create
 * context       or NULL; asked before the work begins and all the while
 *
 * Smoothing costs a sparse factorisation. The context is not asked while its unknowns are put in order,
 * which takes a small part of that. Any thread. */
MEANDER_API meander_status meander_surface_compute_curvature(const meander_surface* surface,
                                                             meander_curvature curvature,
                                                             double smoothing, double* values,
                                                             size_t vertex_count,
                                                             meander_context* context,
                                                             meander_error* error);

/* Which directions meander_surface_compute_directions computes. */
typedef uint32_t meander_directions;
enum {
  MEANDER_DIRECTIONS_CURVATURE_MIN = 0, /* in which the surface bends least: along a cylinder */
  MEANDER_DIRECTIONS_CURVATURE_MAX = 1, /* in which it bends most: around a cylinder */
  MEANDER_DIRECTIONS_SMOOTH = 2,        /* the smoothest field of lines */
  MEANDER_DIRECTIONS_BOUNDARY = 3       /* parallel to the boundary, and as smooth as it can be between; zero on
                                           components without a boundary */
};

/* A field of lines on the surface, for meander_flow_set_directions.
 *
 * Curvature: principal directions (as in meander_surface_compute_curvature), averaged over the radius
 * `smoothing` along the surface. Where the surface bends equally in all directions they are undefined,
 * and the neighbourhood decides. Smooth: the least eigenvector of the connection Laplacian of line
 * fields, one for each component, by inverse power iteration; Knoppel, Crane, Pinkall, Schroder,
 * "Globally Optimal Direction Fields", ACM Trans. Graph. 32, 4 (2013). Among equally smooth fields, as
 * on a plane or a sphere, the one closest to the directions of least curvature, else to the x-axis.
 *
 * kind          MEANDER_DIRECTIONS_...
 * smoothing     radius in the caller's units; 0: none; at most the diagonal. Without meaning for
 *               MEANDER_DIRECTIONS_SMOOTH
 * directions    receives double[3 * vertex_count], unit and tangential, signs arbitrary; 0 0 0 where
 *               there is no direction, as at vertices that no face of the surface uses
 * vertex_count  as passed to meander_surface_create
 * context       or NULL; asked before the work begins and all the while, as in
 *               meander_surface_compute_curvature
 *
 * Costs sparse factorisations, about two where there is no smoothing and three where there is. Any
 * thread. */
MEANDER_API meander_status meander_surface_compute_directions(const meander_surface* surface,
                                                              meander_directions kind,
                                                              double smoothing, double* directions,
                                                              size_t vertex_count,
                                                              meander_context* context,
                                                              meander_error* error);

/* The field of lines that is parallel to strokes drawn on the surface and as smooth as possible
 * elsewhere: the minimum of the same energy with the strokes as weights (Knoppel et al. 2013, section
 * 4). Strokes that disagree in one place are averaged there.
 *
 * points        double[3 * point_count], finite, stroke after stroke, in the caller's units; each is
 *               moved to the nearest point of the surface
 * point_count   at most 2^30
 * offsets       uint64_t[stroke_count + 1], from 0 to point_count, never falling: stroke s has the
 *               points offsets[s] .. offsets[s + 1] - 1; one of fewer than 2 points is ignored
 * stroke_count  at least 1
 * directions    receives double[3 * vertex_count] as in meander_surface_compute_directions; 0 0 0 on
 *               components without a stroke
 * vertex_count  as passed to meander_surface_create
 * context       or NULL; asked before the work begins and all the while, as in
 *               meander_surface_compute_curvature. Any thread. */
MEANDER_API meander_status meander_surface_compute_stroke_directions(
    const meander_surface* surface, const double* points, size_t point_count, const uint64_t* offsets,
    size_t stroke_count, double* directions, size_t vertex_count, meander_context* context,
    meander_error* error);

/* Turns the lines of a field, each by an angle of its own: of a direction that is painted.
 *
 * directions    double[3 * vertex_count], finite, in and out: vectors in space of any length, such as
 *               meander_surface_compute_directions gives; each is laid into the surface and turned about
 *               the normal there, counterclockwise as seen from the side that its component's first face
 *               shows. Afterwards they are unit and tangential; 0 0 0 stays, and what stands upright on the
 *               surface becomes it
 * angles        double[vertex_count], radians, within 2^30; lines have no sign, so that pi is 0
 * vertex_count  as passed to meander_surface_create
 * context       or NULL; asked before the work begins and all the while, as in
 *               meander_surface_compute_curvature
 *
 * Where it fails, the directions are as they were. Takes as long as reading the surface. Any thread. */
MEANDER_API meander_status meander_surface_turn_directions(const meander_surface* surface, double* directions,
                                                           const double* angles, size_t vertex_count,
                                                           meander_context* context, meander_error* error);

/* Lines along the boundary. */
typedef struct meander_outlines {
  uint32_t struct_size; /* set by meander_outlines_init */
  uint32_t reserved32;
  size_t point_count;
  size_t strand_count;      /* 0 for a closed surface */
  size_t skipped_count;     /* stretches and strands that were left out */
  const double* positions;  /* double[3 * point_count] */
  const uint64_t* offsets;  /* uint64_t[strand_count + 1], as in meander_polylines */
  const uint8_t* closed;    /* uint8_t[strand_count] */
  meander_result* result;
  uint64_t reserved[4];
} meander_outlines;

/* Prepares outlines; see "Structs". */
MEANDER_API meander_status meander_outlines_init(meander_outlines* outlines, size_t struct_size);

/* Finds lines along the boundary at a distance from it, to be guides of a seed: the other strands
 * then fill the rest, and the boundary is outlined evenly.
 *
 * Stretches that come within half a spacing of another one are left out, since nothing fits between
 * them, and so are strands shorter than three spacings; a line that is interrupted in this manner
 * gives open strands. Lines do not cross. The distance is measured along the surface.
 *
 * distance   in mesh units; from a tenth of the spacing to twice the spacing
 * spacing    of the curve to come, in mesh units; points are about a quarter of it apart
 * outlines   prepared by meander_outlines_init; receives them
 * context    or NULL; asked before the work begins and all the while. Any thread. */
MEANDER_API meander_status meander_surface_find_outlines(const meander_surface* surface, double distance,
                                                         double spacing, meander_outlines* outlines,
                                                         meander_context* context,
                                                         meander_error* error);

#ifdef __cplusplus
}
#endif

#endif /* MEANDER_FIELDS_H */
