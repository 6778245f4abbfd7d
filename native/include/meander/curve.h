/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The curve of a flow, and what it leaves empty. Part of meander.h. */
#ifndef MEANDER_CURVE_H
#define MEANDER_CURVE_H

#include "flow.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------ */
/* Flow: curve out                                                                              */

/* The curve as full geodesic polylines: nodes and, between them, every point where a segment crosses an
 * edge of the mesh, so that every straight piece lies in one face. */
typedef struct meander_polylines {
  uint32_t struct_size; /* set by meander_polylines_init */
  uint32_t reserved32;
  size_t point_count;
  size_t strand_count;
  const double* positions; /* double[3 * point_count] */
  const uint64_t* offsets; /* uint64_t[strand_count + 1]: strand s has the points offsets[s] ..
                              offsets[s + 1] - 1 */
  const uint8_t* closed;   /* uint8_t[strand_count]: 1 if the last point joins the first, which is not
                              repeated */
  const uint8_t* guides;   /* uint8_t[strand_count]: 1 for a guide, 0 for a strand that grows; see
                              meander_seed */
  meander_result* result;
  uint64_t reserved[4];
} meander_polylines;

/* Prepares polylines; see "Structs". */
MEANDER_API meander_status meander_polylines_init(meander_polylines* polylines, size_t struct_size);

/* Copies the curve. Strands come in the order of the seed's, and keep their places for the life of the
 * flow.
 *
 * polylines   prepared by meander_polylines_init; receives them */
MEANDER_API meander_status meander_flow_get_polylines(const meander_flow* flow,
                                                      meander_polylines* polylines,
                                                      meander_error* error);

/* The nodes as points of the mesh, strand after strand. */
typedef struct meander_nodes {
  uint32_t struct_size; /* set by meander_nodes_init */
  uint32_t reserved32;
  size_t count;
  const uint32_t* faces;      /* uint32_t[count]: index of the face, as passed to meander_surface_create */
  const double* barycentrics; /* double[3 * count]: weights of the face's vertices in the caller's order;
                                 sum 1 */
  const double* radii;        /* double[2 * count]: r+ and r- of the node (eq. 6), clamped at r_max, of
                                 the last medial axis, be it a step's or the statistics' (0 before the
                                 first). Towards a boundary it is no more than the distance of the node
                                 from there, along the surface, plus r (1 - 2 boundary_distance) */
  const uint8_t* fixed;       /* uint8_t[count]: 1 for a node that never moves */
  meander_result* result;
  uint64_t reserved[4];
} meander_nodes;

/* Prepares nodes; see "Structs". */
MEANDER_API meander_status meander_nodes_init(meander_nodes* nodes, size_t struct_size);

/* Copies the nodes.
 *
 * nodes   prepared by meander_nodes_init; receives them */
MEANDER_API meander_status meander_flow_get_nodes(const meander_flow* flow, meander_nodes* nodes,
                                                  meander_error* error);

/* What meander_flow_compute_point_data computes; the sum of those that are wanted. */
typedef uint32_t meander_point_parts;
enum {
  MEANDER_POINT_PARTS_ARC_LENGTHS = 1,
  MEANDER_POINT_PARTS_NORMALS = 2,
  MEANDER_POINT_PARTS_TANGENTS = 4,
  MEANDER_POINT_PARTS_RADII = 8, /* costs a medial axis */
  MEANDER_POINT_PARTS_PLACES = 16, /* faces and barycentrics */
  MEANDER_POINT_PARTS_ALL = 31
};

/* What is known of every point of the polylines, in their order, for ribbons, tool paths and shaders. What
 * was not asked for is NULL. */
typedef struct meander_point_data {
  uint32_t struct_size; /* set by meander_point_data_init */
  uint32_t reserved32;
  size_t count;
  const double* arc_lengths;  /* double[count]: arc length of the strand from its first point */
  const double* normals;      /* double[3 * count]: unit surface normals */
  const double* tangents;     /* double[3 * count]: unit, along the strand, bisecting the angle of the
                                 pieces before and after the point */
  const double* radii;        /* double[2 * count]: r+ and r- of the present curve (eq. 6), clamped at
                                 r_max: half the room to the strand on the right and on the left, in the
                                 direction of the strand and seen from outside; between two nodes in
                                 proportion to arc length */
  const uint32_t* faces;      /* uint32_t[count]: a face that holds the point, as passed to
                                 meander_surface_create */
  const double* barycentrics; /* double[3 * count]: weights of the face's vertices in the caller's order;
                                 sum 1 */
  meander_result* result;
  uint64_t reserved[4];
} meander_point_data;

/* Prepares data of points; see "Structs". */
MEANDER_API meander_status meander_point_data_init(meander_point_data* point_data, size_t struct_size);

/* Computes data of the points of the present curve.
 *
 * parts        MEANDER_POINT_PARTS_..., added up
 * point_data   prepared by meander_point_data_init; receives them
 * context      or NULL; asked before the work begins and all the while */
MEANDER_API meander_status meander_flow_compute_point_data(meander_flow* flow, meander_point_parts parts,
                                                           meander_point_data* point_data,
                                                           meander_context* context,
                                                           meander_error* error);

/* Computes the curve as it is drawn: with round turns, where the curve itself may turn within a small share of
 * the spacing and a tube along it would pinch. The curve and all that follows from it stay as they are.
 *
 * The line lies on the surface, has the strands of the curve, and crosses and touches itself nowhere, by the
 * exact predicates that the flow has. Guides, fixed nodes and the ends of open strands stay where they are, and
 * so do strands where they run straight. Strands get no nearer to each other than .85 of the spacing, or than they
 * were where that is less. Its points are the nodes, which lie closer to each other in turns, and what the line
 * bends by at edges of the mesh; between two points it may lie .012 of a spacing off the surface's faces.
 *
 * tolerance    how far any place of the line may be from the curve along the surface, as a share of the local
 *              spacing, from 0 to .5; 0: the curve itself, of which points are left out
 * polylines    prepared by meander_polylines_init; receives the line
 * point_data   prepared by meander_point_data_init; receives the data of its points, all of them; or NULL.
 *              The radii are those of the curve beside
 * context      or NULL; asked before the work begins and all the while. Costs a medial axis and about fourteen
 *              moves of the curve. The flow belongs to the calling thread. */
MEANDER_API meander_status meander_flow_round_curve(meander_flow* flow, double tolerance,
                                                    meander_polylines* polylines,
                                                    meander_point_data* point_data,
                                                    meander_context* context, meander_error* error);

/* ------------------------------------------------------------------------------------------ */
/* Flow: gaps                                                                                   */

/* Places that a curve leaves empty, the largest first. */
typedef struct meander_gaps {
  uint32_t struct_size; /* set by meander_gaps_init */
  uint32_t reserved32;
  size_t count;
  const double* positions; /* double[3 * count], on the surface */
  const double* radii;     /* double[count]: distance from the position to the curve, in the caller's units */
  const double* sizes;     /* double[count]: the same in units of the local r, never rising */
  const uint32_t* faces;   /* uint32_t[count]: the face of each position, as passed to
                              meander_surface_create */
  meander_result* result;
  double empty_share;      /* of the surface's area: farther than 1.6 local r from the curve, narrow_share
                              left out. Hardly any of a filled surface is, whatever least_size says */
  double narrow_share;     /* the same where the surface is narrower than a spacing, so that a line and its
                              way back have no room */
  const uint8_t* narrow;   /* uint8_t[count]: 1 where the surface is narrower than a spacing, else 0 */
  uint64_t reserved[1];
} meander_gaps;

/* Prepares gaps; see "Structs". */
MEANDER_API meander_status meander_gaps_init(meander_gaps* gaps, size_t struct_size);

/* Finds the places that the present curve leaves empty. The size of a place is its straight distance from
 * the curve in units of the local r: 1 between strands at the spacing asked for. Every gap is a local
 * maximum of it, and where it lies on the boundary also a maximum along the boundary; no gap's position
 * lies within the radius of a larger one. A long furrow that is too wide gives a row of gaps.
 *
 * The search starts from the nodes' medial balls and from the middles of faces, so it also sees parts
 * of the surface that no strand has reached. Where a place is larger than r_max its size is a lower
 * bound. With MEANDER_MEDIAL_AXIS_EUCLIDEAN it does not see the far side of a sheet thinner than r: the
 * strands of one side cover both. With MEANDER_MEDIAL_AXIS_GEODESIC only what is connected to a place
 * within its ball covers it, and where strands of another sheet are near, sizes end at 3. Where
 * boundary_distance keeps a strip along the boundary empty, only what lies farther from the curve than
 * that calls for is a gap, or empty.
 *
 * A place is narrow where the part of the surface that is connected to it within 4 local r has an area of
 * less than 2 r times its longest extent: a strip of a lesser width, a tube of a lesser girth, the tip of a
 * corner below 57 degrees. So it is where every circle of radius r that lies on the surface has its middle
 * farther than 1.45 local r from the place: beside the point of a corner well below 90 degrees.
 *
 * least_size  how large a place must be to count, in local r, from 1 to 1e6; 0: 1.2
 * gaps        prepared by meander_gaps_init; receives them
 * context     or NULL; asked before the work begins and all the while. Its progress goes from 0 to 1,
 *             and is afterwards what it was
 *
 * Costs one medial axis and a few nearest-point queries a node and face. The curve stays as it is. */
MEANDER_API meander_status meander_flow_find_gaps(meander_flow* flow, double least_size,
                                                  meander_gaps* gaps, meander_context* context,
                                                  meander_error* error);

/* ------------------------------------------------------------------------------------------ */
/* Flow: all of that, in the background                                                         */

/* Begins to find what is told of the present curve on a thread of the library, and returns at once, as
 * meander_flow_start does: until meander_flow_wait the flow belongs to the search. The same as the calls that
 * find one thing each give, with one medial axis for all. Each struct is prepared by its _init function, or NULL
 * where that is not asked for. They are the search's until meander_flow_wait, and filled when that returns
 * MEANDER_STATUS_OK; else they stay as they are. meander_flow_destroy before that fills them or does not.
 *
 * polylines    receives the curve, see meander_flow_get_polylines
 * point_data   receives all data of its points, see meander_flow_compute_point_data
 * statistics   receives its figures, see meander_flow_compute_statistics
 * gaps         receives the places that it leaves empty, of least_size; see meander_flow_find_gaps
 * least_size   in local r, from 1 to 1e6; 0: 1.2
 * drawn        receives the curve as it is drawn, see meander_flow_round_curve
 * drawn_data   receives the data of its points; nothing where drawn is NULL
 * tolerance    of that line, from 0 to .5 of the spacing
 * context      NULL, or a context, which cancels the search and shows its progress
 * returns      what keeps the search from beginning; meander_flow_wait reports what happens in it */
MEANDER_API meander_status meander_flow_start_finding(meander_flow* flow, meander_polylines* polylines,
                                                      meander_point_data* point_data,
                                                      meander_flow_statistics* statistics,
                                                      meander_gaps* gaps, double least_size,
                                                      meander_polylines* drawn,
                                                      meander_point_data* drawn_data, double tolerance,
                                                      meander_context* context, meander_error* error);

#ifdef __cplusplus
}
#endif

#endif /* MEANDER_CURVE_H */
