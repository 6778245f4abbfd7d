/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A surface: what a mesh becomes, what is wrong with one, and its nearest points. Part of meander.h. */
#ifndef MEANDER_SURFACE_H
#define MEANDER_SURFACE_H

#include "library.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------ */
/* Surface                                                                                      */

typedef struct meander_surface meander_surface;

/* What to do with a mesh before it is checked, for a mesh with faults or for a part of one. Always
 * start from meander_surface_options_init, which sets everything to 0: nothing is done, and the
 * check is strict. The work is done in this order: face_mask, merging, drop_doubled, dissolving, welding,
 * vertex_mask, the cutting of edges and the splitting of vertices, smallest_part; meander_surface_statistics counts it.
 *
 * drop_degenerate, make_manifold and weld_distance together make a surface of any list of triangles
 * with an area and finite coordinates, and leave a mesh without faults as it is, to the last bit. */
typedef struct meander_surface_options {
  uint32_t struct_size;      /* set by meander_surface_options_init */
  uint32_t drop_degenerate;  /* 1: faces without area are dissolved: one with two corners in the same
                                place shrinks to an edge; one with a corner on its longest edge goes,
                                and the face beyond that edge is divided there. Of faces with the same
                                three vertices one is kept */
  uint32_t split_bow_ties;   /* 1: a vertex where fans of faces meet becomes one vertex for each fan */
  uint32_t cut_non_manifold; /* 1: an edge with more than two faces is cut, so that each of them ends
                                in a boundary there */
  double merge_distance;     /* vertices this close to one with a lower index become that one, and
                                faces that lose a corner to it are dropped; 0: none. Mesh units, >= 0 */
  const uint8_t* face_mask;  /* uint8_t[face_mask_count]: faces with 0 are left out; or NULL */
  const double* vertex_mask; /* double[vertex_mask_count], finite: what lies below mask_threshold is
                                cut away along straight lines across faces; or NULL */
  size_t face_mask_count;    /* the number of faces of the mesh; 0 for NULL */
  size_t vertex_mask_count;  /* the number of vertices of the mesh; 0 for NULL */
  double mask_threshold;     /* finite */
  uint32_t threads;          /* 0: as many as the machine has; at most 256; the result is the same */
  uint32_t make_manifold;    /* 1: whatever keeps faces from being a surface is parted there: bow-ties
                                as split_bow_ties does; an edge with more than two faces, where pairs
                                that continue each other stay joined (those whose orientation agrees
                                first, of these those that are joined elsewhere, of these the
                                flattest) and the rest ends, or with cut_non_manifold or more than
                                200 faces all of it; and a component that cannot be oriented, where
                                two faces that are wound alike lie folded on each other, or else
                                along a line */
  double weld_distance;      /* boundary edges whose ends are this close to those of another, and
                                closer than a quarter of every edge there, become one with it, unless
                                the faces lie on each other; boundary edges with a vertex of another
                                boundary on them are split there before; 0: none. Mesh units, >= 0 */
  double smallest_part;      /* components whose bounding box has a diagonal below this are left out;
                                0: none. Mesh units, >= 0 */
  const uint32_t* polygons;  /* uint32_t[polygons_count]: of which polygon each face is a part, any
                                numbers; or NULL. Only drop_doubled asks */
  size_t polygons_count;     /* the number of faces of the mesh; 0 for NULL */
  uint32_t drop_doubled;     /* 1: of polygons whose outlines lie between the same places (within 1e-7
                                of the size of the mesh), wound alike or not, one is kept, whatever
                                their vertices and triangles. Without `polygons`, and besides, faces in
                                one plane that continue each other where no other meets them are one.
                                Polygons stay, unless they are wound alike or have a free edge, where
                                each closes a surface with vertices of its own */
  uint32_t reserved32;
  uint64_t reserved[1];
} meander_surface_options;

/* Fills in the defaults; see "Structs".
 *
 * options      receives them
 * struct_size  sizeof(meander_surface_options) */
MEANDER_API meander_status meander_surface_options_init(meander_surface_options* options,
                                                        size_t struct_size);

/* Checks a triangle mesh and builds a surface from it. The mesh may be open or closed, of any genus,
 * and of several components. Faces whose orientation disagrees with that of their component's first
 * face are flipped; vertices that no face uses are ignored.
 *
 * vertices      double[3 * vertex_count], finite where a face uses them, in the caller's units
 * vertex_count  at most 2^30
 * faces         uint32_t[3 * face_count], each below vertex_count
 * face_count    from 1 to 2^30
 * options       NULL: the mesh as it is, by as many threads as the machine has. Its arrays are read
 *               during the call only
 * surface       receives the new surface; destroy it with meander_surface_destroy
 * context       or NULL; asked before the work begins and all the while
 *
 * Whatever the options do, everything else keeps speaking of the mesh as passed here: faces of nodes
 * and gaps, weights, errors, and arrays with one value for each vertex. A merged vertex has the
 * values of the one that it became, so weights of faces at it give points up to merge_distance away
 * from the surface.
 *
 * The edge of a mask is a boundary like any other; where it leaves parts that meet in a vertex, they
 * are separated there. The edge of a vertex_mask runs through a vertex that it would pass within a
 * tenth of an edge. Where two sheets would join at an edge that is cut, because nothing else
 * separates them at either of its ends, they stay joined.
 *
 * Refused with MEANDER_STATUS_INVALID_MESH, naming the first element: no faces, also after masks,
 * merging and smallest_part; a coordinate of a face that is NaN or infinite; an index out of range; a
 * vertex twice in a face; a face without area (its height less than 1e-8 of the size of the whole mesh);
 * an edge with more than two faces; a vertex where fans of faces meet in one point (bow-tie); a component
 * that cannot be oriented (Moebius strip). Lengths matter only relative to the mesh: a mesh times 0.001
 * gives the same curve times 0.001. Any thread. */
MEANDER_API meander_status meander_surface_create(const double* vertices, size_t vertex_count,
                                                  const uint32_t* faces, size_t face_count,
                                                  const meander_surface_options* options,
                                                  meander_surface** surface,
                                                  meander_context* context, meander_error* error);

/* Frees a surface; NULL is allowed. Flows made from it stay usable. */
MEANDER_API void meander_surface_destroy(meander_surface* surface);

typedef struct meander_surface_statistics {
  uint32_t struct_size; /* set by meander_surface_statistics_init */
  uint32_t vertices;    /* used by at least one face */
  uint32_t faces;
  uint32_t components;
  uint32_t boundary_loops;
  uint32_t flipped_faces;   /* whose orientation disagreed with their component's first face */
  uint32_t unused_vertices; /* as passed; no face uses them */
  uint32_t merged_vertices; /* that became another vertex; this and the following: 0 unless asked for */
  uint32_t dropped_faces;   /* without area, doubled, or lost by merging */
  uint32_t split_vertices;  /* added to separate bow-ties, those of a mask included */
  uint32_t cut_edges;       /* that had more than two faces */
  uint32_t masked_faces;    /* left out by a mask as a whole */
  uint32_t clipped_faces;   /* cut by the edge of a vertex_mask */
  uint32_t welded_edges;    /* pairs of boundary edges that became one */
  double area;     /* square units */
  double diagonal; /* of the axis-aligned bounding box */
  uint32_t opened_edges;    /* cut because the surface had only one side there */
  uint32_t doubled_faces;   /* of dropped_faces: they had the vertices of another face */
  uint32_t split_edges;     /* boundary edges with vertices of another boundary on them */
  uint32_t small_parts;     /* components left out because they are smaller than smallest_part */
  uint64_t reserved[4];
} meander_surface_statistics;

/* Prepares the struct; see "Structs".
 *
 * statistics   receives struct_size and zeros
 * struct_size  sizeof(meander_surface_statistics) */
MEANDER_API meander_status meander_surface_statistics_init(meander_surface_statistics* statistics,
                                                           size_t struct_size);

/* Copies the figures of a surface.
 *
 * statistics   prepared by meander_surface_statistics_init; receives them. Any thread. */
MEANDER_API meander_status meander_surface_get_statistics(const meander_surface* surface,
                                                          meander_surface_statistics* statistics,
                                                          meander_error* error);

/* What is wrong with a mesh, and what the two elements of a fault are: a vertex or a face twice, or the
 * two vertices of an edge. */
typedef uint32_t meander_fault;
enum {
  MEANDER_FAULT_NOT_FINITE = 0,    /* vertex: a coordinate is NaN or infinite */
  MEANDER_FAULT_NO_AREA = 1,       /* face: without area, or with a vertex twice */
  MEANDER_FAULT_DOUBLED_FACE = 2,  /* face: it has the vertices of one with a lower index */
  MEANDER_FAULT_CROWDED_EDGE = 3,  /* edge: it has more than two faces */
  MEANDER_FAULT_BOW_TIE = 4,       /* vertex: fans of faces meet in this point only */
  MEANDER_FAULT_ONE_SIDED = 5,     /* edge: here the surface would have to be cut to have two sides */
  MEANDER_FAULT_SEAM = 6           /* edge: a boundary edge that lies on another one */
};

/* All faults of a mesh. */
typedef struct meander_faults {
  uint32_t struct_size; /* set by meander_faults_init */
  uint32_t reserved32;
  size_t count;
  const uint32_t* kinds;    /* uint32_t[count]: each a meander_fault, rising */
  const uint32_t* elements; /* uint32_t[2 * count] */
  meander_result* result;
  uint64_t reserved[4];
} meander_faults;

/* Prepares faults; see "Structs". */
MEANDER_API meander_status meander_faults_init(meander_faults* faults, size_t struct_size);

/* Finds all faults of a mesh, where meander_surface_create names the first. What is found with the faces
 * of the kinds 1 and 2 and those at a vertex of kind 0 left out is in order of the kinds, and within one
 * in rising order.
 *
 * vertices, vertex_count, faces, face_count   as for meander_surface_create; coordinates may be anything
 * weld_distance   how close boundary edges count as seams, as in meander_surface_options; 0: none do
 * faults          prepared by meander_faults_init; receives them
 * context         or NULL; a cancel ends the work within a tenth of a second, and faults stays as it was
 *
 * Refused with MEANDER_STATUS_INVALID_MESH: no faces, an index out of range. Any thread. */
MEANDER_API meander_status meander_mesh_find_faults(const double* vertices, size_t vertex_count,
                                                    const uint32_t* faces, size_t face_count,
                                                    double weld_distance, meander_faults* faults,
                                                    meander_context* context, meander_error* error);

/* ------------------------------------------------------------------------------------------ */
/* Nearest points                                                                               */

/* The points of a mesh that are nearest to points in space. Exact: of all faces the nearest, to what
 * rounding leaves of lengths in the mesh; of several that are equally near, the one with the lowest index.
 * The mesh may be any list of triangles, with all the faults that meander_mesh_find_faults names, anywhere
 * and of any size. Faces at a vertex that is not finite are left out; one without area counts as the line,
 * or the point, that it is.
 *
 * vertices, vertex_count, faces, face_count   as for meander_surface_create; coordinates may be anything
 * points         double[3 * point_count], finite, in the mesh's units, at any distance from it
 * point_count    at most 2^30
 * threads        0: as many as the machine has; at most 256; the result is the same
 * closest_faces  receives uint32_t[point_count], the face of each nearest point; or NULL
 * weights        receives double[3 * point_count], of the corners of that face, in its order: >= 0, with
 *                the sum 1; or NULL
 * distances      receives double[point_count], in the mesh's units, infinite where that is no double; or
 *                NULL
 * context        or NULL; asked before the work begins and all the while
 *
 * Every call makes a tree of the faces, which takes about as long as looking for as many points.
 *
 * Refused with MEANDER_STATUS_INVALID_MESH: no faces, or none with finite vertices; an index out of range.
 * Any thread. */
MEANDER_API meander_status meander_mesh_find_closest(const double* vertices, size_t vertex_count,
                                                     const uint32_t* faces, size_t face_count,
                                                     const double* points, size_t point_count,
                                                     uint32_t threads, uint32_t* closest_faces,
                                                     double* weights, double* distances,
                                                     meander_context* context, meander_error* error);

/* The same on a surface: what its options have left out is not looked at, faces and weights are those of
 * the mesh as passed to meander_surface_create, and distances are from the surface as it was repaired. */
MEANDER_API meander_status meander_surface_find_closest(const meander_surface* surface,
                                                        const double* points, size_t point_count,
                                                        uint32_t threads, uint32_t* closest_faces,
                                                        double* weights, double* distances,
                                                        meander_context* context, meander_error* error);

#ifdef __cplusplus
}
#endif

#endif /* MEANDER_SURFACE_H */
