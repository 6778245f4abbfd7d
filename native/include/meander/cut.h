/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The surface cut along the curve. Part of meander.h. */
#ifndef MEANDER_CUT_H
#define MEANDER_CUT_H

#include "flow.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A triangle mesh that has the curve among its edges. */
typedef struct meander_cut {
  uint32_t struct_size; /* set by meander_cut_init */
  uint32_t reserved32;
  size_t vertex_count;
  size_t face_count;
  size_t point_count;  /* of the curve */
  size_t strand_count; /* of the curve, without guides */

  const double* positions;       /* double[3 * vertex_count], in the caller's units */
  const double* distances;       /* double[vertex_count]: from the curve, along the surface; 0 on the curve,
                                    infinite on components that no strand runs on. Where the surface bends
                                    by less than 20 degrees on the way it is the straight distance */
  const uint32_t* vertex_faces;  /* uint32_t[vertex_count]: a face that holds the vertex, as passed to
                                    meander_surface_create */
  const double* vertex_weights;  /* double[3 * vertex_count]: weights of that face's vertices in the
                                    caller's order; sum 1 */

  const uint32_t* faces;         /* uint32_t[3 * face_count], oriented as the component's first face */
  const uint32_t* origins;       /* uint32_t[face_count]: the face that it is a part of, as passed to
                                    meander_surface_create */
  const uint32_t* strands;       /* uint32_t[face_count]: the nearest strand, as in meander_polylines;
                                    UINT32_MAX on components that no strand runs on */
  const uint32_t* regions;       /* uint32_t[face_count]: faces have the same number if one can go from one
                                    to the other without crossing the curve; from 0 on */
  const int32_t* sides;          /* int32_t[face_count], 1 or -1: other on the two sides of every edge of
                                    the curve, if that can be on this component of the surface, as it can
                                    where closed strands part a sphere; if not, as nearest_sides. 0 on
                                    components without a strand */
  const int32_t* nearest_sides;  /* int32_t[face_count]: 1 on the left of the nearest strand, in its
                                    direction and seen from outside, -1 on its right, 0 on components
                                    without a strand */
  const double* along;           /* double[3 * face_count]: per corner, the arc length of the nearest place
                                    of the curve from the first point of its strand. It does not jump
                                    within a face, so it may lie a little beyond either end of a closed
                                    strand */
  const double* face_distances;  /* double[3 * face_count]: per corner, from that place */
  const double* corner_weights;  /* double[9 * face_count]: per corner, the weights of the vertices of the
                                    face in `origins` */

  const uint32_t* line_vertices; /* uint32_t[point_count]: the curve as vertices of the cut; each point is
                                    joined to the next one by an edge */
  const double* arc_lengths;     /* double[point_count]: from the first point of the strand */
  const uint64_t* offsets;       /* uint64_t[strand_count + 1]: strand s has the points offsets[s] ..
                                    offsets[s + 1] - 1 */
  const uint32_t* line_strands;  /* uint32_t[strand_count]: which strand of meander_polylines it is */
  const uint8_t* closed;         /* uint8_t[strand_count]: 1 if the last point joins the first (not
                                    repeated) */
  const double* lengths;         /* double[strand_count]: of the whole strand */

  meander_result* result;
  uint64_t reserved[4];
} meander_cut;

/* Prepares a cut; see "Structs". */
MEANDER_API meander_status meander_cut_init(meander_cut* cut, size_t struct_size);

/* Makes a triangle mesh of the same shape as the flow's surface in which every straight piece of the
 * curve is an edge, and finds for all of it the nearest place of the curve: what two-tone colours,
 * reliefs and patterns along the curve need. Every piece lies in one face, so nothing is approximated:
 * each face of the surface is divided by itself, and shared edges alike from both sides. Guides are left
 * out, since they may cross one another.
 *
 * detail        0: only the vertices that the curve calls for. Larger: edges get further vertices until
 *               they are about so long, and faces vertices about so far apart, for fields that follow the
 *               distance. Caller's units; half of r gives a smooth relief
 * middle_lines  1: also the lines halfway between neighbouring turns become edges, so that every face
 *               belongs to one turn and one side of it, and the distance has its ridges on edges; or 0
 * cut           prepared by meander_cut_init; receives the mesh
 * context       or NULL; asked before the work begins and all the while
 *
 * Where the curve comes close to vertices and edges of the surface, faces are thin; none is turned over.
 * Refused with MEANDER_STATUS_INVALID_ARGUMENT: a detail that is negative, not finite, or so small that
 * there would be more than 200 million vertices. */
MEANDER_API meander_status meander_flow_cut_surface(const meander_flow* flow, double detail,
                                                    uint32_t middle_lines, meander_cut* cut,
                                                    meander_context* context, meander_error* error);

/* Finds which face of a flat drawing of triangles, such as the UV map of a cut, each pixel of a square image
 * lies in: the last of those that its centre is in. The image is made in bands, by several threads.
 *
 * drawing     double[6 * face_count]: x and y of the three corners of each face, in pixels, whose centres are
 *             whole numbers; y counts rows downwards from the top. Faces without area, and those with a
 *             coordinate that is not finite, are on no pixel
 * face_count  at most 2^30
 * side        of the image, from 1 to 32768 pixels
 * margin      this many pixels around what lies in faces get the face and the weights of their neighbours
 * threads     0: as many as the machine has; at most 256; the result is the same
 * nearest     receives int32_t[side * side]: the face of each pixel, row by row, -1 where there is none
 * weights     receives float[3 * side * side]: weights of the corners of that face, sum 1; 0 where there is none
 * covered     receives how many pixels lie in faces, without the margin
 * twice       receives how many of them lie well inside of more than one face
 * context     or NULL; asked before the work begins and all the while; where it has ended the work, what is in
 *             the arrays means nothing. Any thread. */
MEANDER_API meander_status meander_map_find_pixels(const double* drawing, size_t face_count, uint32_t side,
                                                   uint32_t margin, uint32_t threads, int32_t* nearest,
                                                   float* weights, size_t* covered, size_t* twice,
                                                   meander_context* context, meander_error* error);

/* Finds how far places of a cut surface are from the curve. Between corners that is the distance in space
 * from the nearest place on the curve, in proportion to their own distances where the surface bends on the way.
 *
 * cut        prepared by meander_cut_init, with the arrays that meander_flow_cut_surface gave, or with copies
 *            of them; only positions, distances, faces, strands, along, face_distances and the curve are read
 * distance   the farthest; positive, in the units of the cut
 * nearest    int32_t[point_count]: faces of the cut; -1: none, which has the distance 0
 * weights    float[3 * point_count]: of the corners of these faces; finite
 * point_count  at most 2^30
 * threads    0: as many as the machine has; at most 256; the result is the same
 * distances  receives double[point_count]
 * away       receives double[3 * point_count]: from the nearest place on the curve to each place; or NULL
 * context    or NULL; as for meander_map_find_pixels. Any thread. */
MEANDER_API meander_status meander_cut_measure_distances(const meander_cut* cut, double distance,
                                                         const int32_t* nearest, const float* weights,
                                                         size_t point_count, uint32_t threads,
                                                         double* distances, double* away,
                                                         meander_context* context, meander_error* error);

/* Finds the place on the curve that is nearest to each of some places of a cut surface: of the turn that their
 * face belongs to, or of one that another face at its corners belongs to. The border between two turns is where
 * they are equally near, and is as smooth as the curve.
 *
 * strands    receives uint32_t[point_count]: the strand, as in meander_polylines; UINT32_MAX where no strand
 *            runs; or NULL
 * along      receives double[point_count]: the arc length of the place from the first point of its strand; or
 *            NULL
 * and all else as in meander_cut_measure_distances, but that `distances` may be NULL. Any thread. */
MEANDER_API meander_status meander_cut_find_places(const meander_cut* cut, double distance,
                                                   const int32_t* nearest, const float* weights,
                                                   size_t point_count, uint32_t threads, double* distances,
                                                   double* away, uint32_t* strands, double* along,
                                                   meander_context* context, meander_error* error);

#ifdef __cplusplus
}
#endif

#endif /* MEANDER_CUT_H */
