/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * meander.h - grow a curve on a triangle mesh until it fills the surface at an even spacing.
 *
 * The method is Noma, Sellan, Sharp, Singh, Jacobson, "Surface-Filling Curve Flows via Implicit
 * Medial Axes", ACM Trans. Graph. 43, 4 (2024), doi 10.1145/3658158; equation numbers are its own.
 *
 * Words: the surface has vertices, edges and faces; the curve has strands (connected components,
 * open or closed), nodes and segments; a segment is a geodesic path between two nodes, straight in
 * every face that it crosses. The radius r is half the spacing asked for between neighbouring strands.
 *
 *     meander_text_read_...            mesh files of text, whose lines are many
 *     meander_polygons_triangulate     the triangles of polygons
 *     meander_mesh_find_faults         what is wrong with a mesh, all of it
 *     meander_surface_create           mesh in; checked, copied, ready for any number of flows
 *     meander_surface_compute_...      its curvature and direction fields, for density and alignment
 *     meander_surface_find_outlines    lines along its boundary, to serve as guides
 *     meander_mesh_find_closest        its points nearest to points in space; also on a surface
 *     meander_extent_estimate_cost     what a run is going to cost, before it begins
 *     meander_flow_create              seed, spacing, density; nothing moves yet
 *     meander_flow_set_...             what else the curve follows, and where its surface goes
 *     meander_flow_step / run          the flow; cancelled from any thread through a meander_context
 *     meander_flow_start / wait        the same run on a thread of the library, with previews
 *     meander_flow_get_polylines       curve out, at any time between steps
 *     meander_flow_round_curve         the same line with round turns, to be drawn
 *     meander_flow_find_gaps           where it leaves the surface empty
 *     meander_flow_cut_surface         the mesh with the curve among its edges
 *
 * Names.    A call named get_ copies what is already known. A call named compute_ or find_ does work
 *           that grows with the mesh or the curve, and does it again in every call; it takes a
 *           context, so that it can be cancelled.
 * Units.    Lengths are in the units of the vertices that the caller passed. Indices start at zero.
 * Memory.   The library keeps no pointer of the caller's after a call returns. What is as long as it
 *           turns out to be is handed out in structs of pointers, whose arrays are freed by one call;
 *           see "Results" below. Everything else goes into the caller's own memory.
 * Structs.  Every struct of the caller's begins with struct_size and is prepared by its _init
 *           function, so that it can grow without breaking programs compiled earlier; see "Structs"
 *           below.
 * Errors.   Every call that can fail returns a meander_status and, if `error` is not NULL, writes
 *           one sentence for people into it: what is wrong, which element, and what to do. On
 *           failure outputs are untouched unless the call says otherwise. The library prints
 *           nothing, throws nothing, and keeps nothing in globals.
 * Threads.  Once created, a surface may be shared by any number of threads and flows. A flow belongs
 *           to one thread at a time, but for meander_flow_is_running. A context may be used from any
 *           thread at any time. From meander_flow_start to meander_flow_wait a thread of the library
 *           runs the flow: it calls nothing of the host's, is never detached, and ends before
 *           meander_flow_wait or meander_flow_destroy returns. Functions on structs alone may be called
 *           from any thread.
 * Bytes.    The same input and options give the same bytes for any number of threads.
 *
 * docs/c-api.md says what stays the same from one version to the next.
 */
#ifndef MEANDER_H
#define MEANDER_H

#include <stddef.h>
#include <stdint.h>

/* Define MEANDER_STATIC to link with a static library. MEANDER_BUILDING is for the library itself. */
#if defined(MEANDER_STATIC)
#define MEANDER_API
#elif defined(_WIN32) && defined(MEANDER_BUILDING)
#define MEANDER_API __declspec(dllexport)
#elif defined(_WIN32)
#define MEANDER_API __declspec(dllimport)
#elif defined(__GNUC__)
#define MEANDER_API __attribute__((visibility("default")))
#else
#define MEANDER_API
#endif

/* The version of this header; meander_version() tells the library's. */
#define MEANDER_VERSION_MAJOR 0
#define MEANDER_VERSION_MINOR 1
#define MEANDER_VERSION_PATCH 0

/* Grows only when a program compiled against an older header would no longer work. What is merely
 * added leaves it as it is. meander_abi_version() tells the library's. */
#define MEANDER_ABI_VERSION 3

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------ */
/* Versions                                                                                     */

/* The library's version, such as "0.1.0"; static storage. Any thread. */
MEANDER_API const char* meander_version(void);

/* The MEANDER_ABI_VERSION that the library was built with. Compare it before any other call: where
 * it differs from the header's, nothing else may be called. Any thread. */
MEANDER_API uint32_t meander_abi_version(void);

/* ------------------------------------------------------------------------------------------ */
/* Structs
 *
 * `struct_size` says how much of a struct the caller knows: the size that it had in the caller's
 * header. Every _init function takes that size, `sizeof` of the struct, fills no more than that, and
 * sets struct_size to it. It returns MEANDER_STATUS_INVALID_ARGUMENT for NULL, and for a size that
 * is smaller than the struct was in the first header of this ABI or larger than 4096.
 *
 *   An older, shorter struct   Fields beyond its end have their defaults; outputs are written up to
 *                              its end and no further.
 *   A newer, longer struct     What lies beyond the fields that the library knows must be zero, as
 *                              _init leaves it, or the call is refused with
 *                              MEANDER_STATUS_INVALID_ARGUMENT: the caller wants something that this
 *                              library cannot do. In outputs it is set to zero.
 *   reserved                   Room for fields to come, in which zero will mean: as before. _init
 *                              sets it to zero, and what is passed in must still be zero. */

/* How the library lays out a struct, so that a binding can compare its own declaration.
 *
 * name      of a struct of this header that is not opaque, such as "meander_seed"
 * layout    receives, up to `capacity` values: sizeof(struct), then the offset of every field in
 *           the order of declaration; may be NULL when capacity is 0
 * returns   1 + the number of fields; 0 if the name is unknown or NULL. Any thread. */
MEANDER_API size_t meander_struct_layout(const char* name, size_t* layout, size_t capacity);

/* ------------------------------------------------------------------------------------------ */
/* Results
 *
 * A call whose outputs are as long as they turn out to be fills a struct of counts and pointers, which
 * its _init function has prepared as any other struct. The arrays belong to the field `result`: they
 * never change, may be read from any thread, and last until it is destroyed, whatever happens to the
 * object that they are of. A pointer is NULL where its array would be empty. A struct that is filled
 * again forgets what it pointed to, so destroy its result first. */

typedef struct meander_result meander_result;

/* Frees all arrays of a struct. NULL, as _init leaves it, is allowed. Any thread. */
MEANDER_API void meander_result_destroy(meander_result* result);

/* ------------------------------------------------------------------------------------------ */
/* Status and errors                                                                            */

typedef int32_t meander_status;
enum {
  MEANDER_STATUS_OK = 0,
  MEANDER_STATUS_INVALID_ARGUMENT = 1, /* a NULL, a size, an option out of its range */
  MEANDER_STATUS_INVALID_MESH = 2,     /* the mesh cannot be used; the element says where */
  MEANDER_STATUS_INVALID_SEED = 3,     /* off the surface, crossing or touching itself, too short */
  MEANDER_STATUS_CANCELLED = 4,        /* the context was cancelled; everything is intact, and a flow
                                          can continue */
  MEANDER_STATUS_OUT_OF_MEMORY = 5,
  MEANDER_STATUS_INTERNAL = 6          /* a defect of the library; the sentence says what to report */
};

/* A short name of a status, such as "invalid mesh"; never NULL; static storage. Any thread. */
MEANDER_API const char* meander_status_name(meander_status status);

/* What the indices of an error count. */
typedef uint32_t meander_element;
enum {
  MEANDER_ELEMENT_NONE = 0,
  MEANDER_ELEMENT_VERTEX = 1,    /* index of a vertex */
  MEANDER_ELEMENT_FACE = 2,      /* index of a face */
  MEANDER_ELEMENT_EDGE = 3,      /* index of one end vertex; element_index2 is the other */
  MEANDER_ELEMENT_SEED_POINT = 4 /* index of a seed point; element_index2 is another one where two
                                    segments meet, or else the same */
};

/* Filled by the library when a call fails, untouched when it succeeds. Owned by the caller; may be
 * NULL in every call. One whose struct_size is too small to be valid receives nothing. */
typedef struct meander_error {
  uint32_t struct_size; /* set by meander_error_init */
  meander_status status;
  meander_element element_kind;
  uint32_t element_index;
  uint32_t element_index2;
  char text[492]; /* UTF-8, zero-terminated, one sentence */
  uint64_t reserved[4];
} meander_error;

/* Prepares an error; see "Structs".
 *
 * error        receives struct_size and zeros
 * struct_size  sizeof(meander_error) */
MEANDER_API meander_status meander_error_init(meander_error* error, size_t struct_size);

/* ------------------------------------------------------------------------------------------ */
/* Context: progress and cancel                                                                 */

typedef struct meander_context meander_context;

/* Creates a context that is not cancelled.
 *
 * context   receives it; destroy it with meander_context_destroy. Any thread. */
MEANDER_API meander_status meander_context_create(meander_context** context, meander_error* error);

/* Frees a context; NULL is allowed. No call may be using it, except a run that was started with it:
 * that continues, and then only meander_flow_destroy can cancel it. */
MEANDER_API void meander_context_destroy(meander_context* context);

/* Asks every call that was given this context to return MEANDER_STATUS_CANCELLED soon: a flow within
 * one iteration, mostly within a small part of it, other calls before they begin and at the points
 * that their descriptions name. Everything is then as it was before the call, or before the iteration.
 * Sticky and idempotent; NULL is ignored. Any thread. */
MEANDER_API void meander_context_cancel(meander_context* context);

/* Takes a cancel back, so that the context can be used again, and sets its progress to 0. NULL is
 * ignored. Any thread; no call may be using the context. */
MEANDER_API void meander_context_reset(meander_context* context);

/* How far the present run of a flow is, as a share of the expected work: in [0, 1], never falling
 * during one run, 1 when the run has ended for whatever reason. It is an estimate: while the curve grows
 * it follows the length of the curve towards the length that is expected to fill the surface, and then
 * the iterations. Updated once an iteration, by meander_flow_run, by a started run and by
 * meander_flow_step, whose steps are one run until a reset; 0 before the first run, after a reset, and for
 * NULL. Any thread. */
MEANDER_API double meander_context_progress(const meander_context* context);

/* What the present run of a flow is about. */
typedef uint32_t meander_phase;
enum {
  MEANDER_PHASE_NONE = 0,            /* no iteration yet */
  MEANDER_PHASE_GROWTH = 1,          /* the curve becomes longer until it fills the surface */
  MEANDER_PHASE_HAIRPIN_REMOVAL = 2, /* its hairpins are drawn in; see hairpin_removal_iterations */
  MEANDER_PHASE_POLISH = 3           /* it becomes even, and comes to rest */
};

/* The phase that the last iteration of the present run has left the flow in. Updated with the
 * progress; MEANDER_PHASE_NONE before the first run, after a reset, and for NULL. Without a polish, as
 * in the preset paper, all of a run is growth. Any thread. */
MEANDER_API meander_phase meander_context_phase(const meander_context* context);

/* ------------------------------------------------------------------------------------------ */
/* Files                                                                                        */

/* What meander_text_read_polygons reads. */
typedef uint32_t meander_text;
enum {
  MEANDER_TEXT_OBJ_FACES = 0, /* v and f lines of a Wavefront OBJ file */
  MEANDER_TEXT_OBJ_LINES = 1, /* its v and l lines */
  MEANDER_TEXT_STL = 2        /* loops of an STL file; every corner has a point of its own */
};

/* The points and polygons of a text. */
typedef struct meander_polygons {
  uint32_t struct_size; /* set by meander_polygons_init */
  uint32_t reserved32;
  size_t point_count;
  size_t corner_count;
  size_t polygon_count;     /* faces, or lines of the kind l */
  size_t left_out;          /* faces with fewer than three corners, which are not among the polygons */
  const double* positions;  /* double[3 * point_count]; NaN and infinite where the text says so */
  const uint32_t* corners;  /* uint32_t[corner_count]: points, from 0, of one polygon after another */
  const uint64_t* ends;     /* uint64_t[polygon_count]: where the corners of each polygon end */
  const uint32_t* lines;    /* uint32_t[polygon_count]: the line of the text in which it begins, from 1 */
  meander_result* result;
  uint64_t reserved[4];
} meander_polygons;

/* Prepares polygons; see "Structs". */
MEANDER_API meander_status meander_polygons_init(meander_polygons* polygons, size_t struct_size);

/* Reads the points and polygons in the text of a mesh file; all else in it is passed over.
 *
 * text      of any encoding that has ASCII in it, such as UTF-8; lines end with \n, \r or both
 * size      in bytes
 * kind      MEANDER_TEXT_...
 * polygons  prepared by meander_polygons_init; receives them
 *
 * Refused with MEANDER_STATUS_INVALID_MESH, naming the line: a v line without three numbers; an f or l
 * line with what is no reference to a vertex, or to one that is not there; an l line of one vertex; a
 * text that ends within a triangle. Any thread. */
MEANDER_API meander_status meander_text_read_polygons(const char* text, size_t size, meander_text kind,
                                                      meander_polygons* polygons, meander_error* error);

/* Reads numbers that stand in a text between blanks and ends of lines, until something else stands there,
 * or there is no more room.
 *
 * text      as in meander_text_read_polygons
 * size      in bytes
 * numbers   receives double[count]
 * capacity  room in `numbers`
 * count     receives how many
 * end       receives where in the text the reading stopped: behind the last number where there is no more
 *           room, or before what is none. Any thread. */
MEANDER_API meander_status meander_text_read_numbers(const char* text, size_t size, double* numbers,
                                                     size_t capacity, size_t* count, size_t* end,
                                                     meander_error* error);

/* Writes rows of numbers as text, such as the points of a curve as lines of a file: with the bytes of C's
 * printf in the locale "C".
 *
 * pattern       zero-terminated, what a row is: text in which each column has one of these forms, in their
 *               order: %d, a whole number, what is behind the point left out; %.Ng and %.Nf, N significant
 *               digits and N decimals; %.Nr, as %.Nf but without zeros at the end of the decimals, without
 *               a point before none, and without the sign of 0. N is from 0 to 17. A doubled % stands for
 *               one. What is not finite is nan, inf or -inf
 * values        double[row_count * column_count], row by row
 * column_count  as many as the pattern has numbers, at least 1
 * text          receives char[size], not zero-terminated
 * capacity      room in `text`. 330 bytes a number and the length of the pattern are enough for any row
 * size          receives how many bytes were written
 * rows          receives how many rows were written: all, or as many as there was room for, and none in
 *               part; call again with the others. Any thread. */
MEANDER_API meander_status meander_text_write_rows(const char* pattern, const double* values,
                                                   size_t row_count, size_t column_count, char* text,
                                                   size_t capacity, size_t* size, size_t* rows,
                                                   meander_error* error);

/* Triangles that polygons were divided into. */
typedef struct meander_triangles {
  uint32_t struct_size; /* set by meander_triangles_init */
  uint32_t reserved32;
  size_t count;
  const uint32_t* corners;  /* uint32_t[3 * count]: three vertices each, wound as their polygon */
  const uint32_t* polygons; /* uint32_t[count]: the polygon of each triangle, rising */
  meander_result* result;
  uint64_t reserved[4];
} meander_triangles;

/* Prepares triangles; see "Structs". */
MEANDER_API meander_status meander_triangles_init(meander_triangles* triangles, size_t struct_size);

/* Divides polygons into triangles, as Blender does: concave ones, ones that are not quite flat, and ones
 * with holes that bridges join to their rim. A polygon of n corners gives n - 2 triangles, or fewer where
 * it goes to a vertex and straight back.
 *
 * vertices       double[3 * vertex_count]; may be NaN or infinite
 * vertex_count   at most 2^30
 * corners        uint32_t[corner_count]: vertices of one polygon after another. A polygon with one that is
 *                not there is fanned from its first corner, for meander_surface_create to name
 * corner_count   at most 2^32 - 1
 * ends           uint64_t[polygon_count], never falling, the last one corner_count: where the corners of
 *                each polygon end. Polygons of fewer than three corners give no triangles
 * polygon_count  at most 2^30
 * triangles      prepared by meander_triangles_init; receives them. Any thread. */
MEANDER_API meander_status meander_polygons_triangulate(const double* vertices, size_t vertex_count,
                                                        const uint32_t* corners, size_t corner_count,
                                                        const uint64_t* ends, size_t polygon_count,
                                                        meander_triangles* triangles,
                                                        meander_error* error);

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
/* Surface: fields and outlines                                                                 */

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

/* ------------------------------------------------------------------------------------------ */
/* Flow: seed                                                                                   */

/* Strands to start from, in space. Every point is moved to the nearest point of the surface, and
 * consecutive points are joined by geodesics. Refused with MEANDER_STATUS_INVALID_SEED: a point
 * farther than `max_distance` from the surface; strands that cross or touch themselves or each other on the
 * surface; a closed strand with fewer than 3 different points, an open one with fewer than 2;
 * consecutive points on different components. Sentences count seed points as `points` does, from 0.
 *
 * Far from the surface, two points that are close together may have their nearest points on two sheets
 * of it. Such a jump is no failure; meander_flow_statistics says how far points were moved, and where
 * the seed jumps.
 *
 * An open strand of two fixed points, a stroke from one to the other, is led around guides that its
 * shortest path would meet; it is refused where they separate the two points.
 *
 * Guides are strands that stay as they are laid, while the others keep the spacing from them as from
 * each other. They are part of the curve: they come out with it, and figures of the whole curve count
 * them; those of the spacing and of convergence leave them out. Guides may cross and touch each other
 * and themselves, but nothing that grows may touch one. At least one strand must grow.
 *
 * Guides that reach from boundary to boundary, that are closed or that form a network divide the
 * surface into regions, and what grows in one never enters another. `fill_regions` gives every region
 * and component that has no growing strand, and is not too narrow for one, a small closed strand such
 * as a flow without a seed starts from, after the seed's own strands. */
typedef struct meander_seed {
  uint32_t struct_size;    /* set by meander_seed_init */
  uint32_t fill_regions;   /* 1: regions without a growing strand get a small closed one */
  size_t point_count;      /* at most 2^30 */
  size_t strand_count;     /* at least 1 */
  const double* points;    /* double[3 * point_count], finite, in the caller's units, strand after strand */
  const uint64_t* offsets; /* uint64_t[strand_count + 1], from 0 to point_count, never falling: strand s
                              has the points offsets[s] .. offsets[s + 1] - 1 */
  const uint8_t* closed;   /* uint8_t[strand_count]: 1 closed, 0 open */
  const uint8_t* fixed;    /* uint8_t[point_count]: 1 never moves; NULL: none */
  const uint8_t* guides;   /* uint8_t[strand_count]: 1 is a guide; NULL: none */
  double max_distance;     /* how far from the surface a point may be, finite, in the caller's units; a
                              local r is always allowed, so that 0 means that */
  uint64_t reserved[3];
} meander_seed;

/* Prepares a seed without strands; see "Structs".
 *
 * seed         receives struct_size and zeros
 * struct_size  sizeof(meander_seed) */
MEANDER_API meander_status meander_seed_init(meander_seed* seed, size_t struct_size);

/* ------------------------------------------------------------------------------------------ */
/* Flow: options                                                                                */

/* The defaults that meander_flow_options_init fills in. */
typedef uint32_t meander_preset;
enum {
  MEANDER_PRESET_EVEN = 0,  /* the default: evenly spaced, few hairpins, no gaps */
  MEANDER_PRESET_PAPER = 1, /* the authors' weights, step and stopping rule */
  MEANDER_PRESET_FINEST = 2 /* more even, with fewer hairpins, in more time: a full start and a longer
                               polish */
};

/* How a medial ball ends at the boundary of an open surface. */
typedef uint32_t meander_boundary_rule;
enum {
  MEANDER_BOUNDARY_RULE_CENTRE = 0,  /* its centre stops at the boundary: strands come to within r of
                                        it, or to boundary_distance */
  MEANDER_BOUNDARY_RULE_OBSTACLE = 1 /* it touches the boundary, as in the paper: strands stay 2 r away */
};

/* How distances between strands are measured. */
typedef uint32_t meander_medial_axis;
enum {
  MEANDER_MEDIAL_AXIS_EUCLIDEAN = 0, /* straight through space, as the preset paper has it: strands on
                                        sheets that lie close together, or pass through each other, keep
                                        clear of one another, as a filament of some width must */
  MEANDER_MEDIAL_AXIS_GEODESIC = 1   /* along the surface, as the other presets have it: every sheet is
                                        filled by itself, and the spacing is kept where the surface bends
                                        sharply */
};

/* When a flow has converged. */
typedef uint32_t meander_stop_rule;
enum {
  MEANDER_STOP_RULE_SETTLED = 0, /* the picture has stopped changing: over some iterations nodes stay
                                    within a small share of the local r, and so does the length */
  MEANDER_STOP_RULE_PAPER = 1    /* |d|_2 / n < 3e-4 r, the test of the authors' own program, in 10
                                    iterations in a row */
};

/* What a curve starts from. */
typedef uint32_t meander_start;
enum {
  MEANDER_START_GROW = 0, /* its seed, or a small loop, which grows until it fills the surface: it winds
                             as coral does */
  MEANDER_START_FULL = 1  /* a curve that fills the surface already, and that the flow only makes even: it
                             walks round evenly spaced streamlines of the field of
                             meander_flow_set_directions or, where there is none, of a smooth one. A strand
                             that is drawn stays, and the rest leaves it on both sides. It is laid in the
                             first iteration; hairpin_removal_iterations count as 0 */
};

/* Options of one flow. Always start from meander_flow_options_init, which is the only place where
 * defaults live. Weights have no unit and mean the same at every scale and segment length. */
typedef struct meander_flow_options {
  uint32_t struct_size;     /* set by meander_flow_options_init */
  meander_preset preset;    /* the one that filled the struct. It decides nothing else but the defaults
                               of fields beyond the end of an older, shorter struct */
  double radius;            /* r, half the spacing; > 0; no default */
  double segment_length;    /* h: nodes are kept between h and 2 h apart; 0: 0.2 r. In [0.01 r, r] */
  double max_radius;        /* r_max, clamp of the medial radius; 0: max_radius_factor r. In
                               [1.5 r, 1e6 r] */
  double max_radius_factor; /* r_max in units of r where max_radius is 0; in [1.5, 1e6] */
  double length_weight;     /* t, weight of eq. 5; in [0, 1e6], as is every bending weight */
  double bending_weight;    /* b, weight of b r^2 sum |t_i - t_(i-1)|^2 / w_i (scaled eq. 12) */
  double medial_weight;     /* factor on alpha = 2 sqrt(2) / r^2 of eq. 9; in [1e-6, 1e6]; 1 keeps the
                               spacing */
  double alignment_weight;  /* beta_F of eq. 11, towards the field of meander_flow_set_directions; in
                               [0, 1e6]; 0: off; about 1 steers, as in the paper */
  double length_power;      /* p of eq. 13, in [1.5, 8]; 2: plain. Scaled so that the whole strand pulls
                               as with 2 */
  double medial_power;      /* q of eq. 13, in [2, 8]; 2: plain. Scaled so that the spacing stays. A
                               polish takes the larger of this and polish_medial_power */
  double step;              /* factor on the displacement of eq. 10; in [0.001, 2] */
  double start_spacing_factor;  /* the curve first fills the surface at this many times the spacing,
                                   which then shrinks to the one asked for (Fig. 25): fewer corners,
                                   more iterations; in [1, 16]; 1: off */
  double boundary_distance;     /* of the last strand from the boundary, in spacings: at 0.5 it is half
                                   as far as its neighbour, at 0 it may run along the boundary; in
                                   [0, 2]. Values other than 0.5 need MEANDER_BOUNDARY_RULE_CENTRE */
  double polish_bending_weight; /* b in the polish; more where a strand turns sharply, so that hairpins
                                   stay round */
  meander_boundary_rule boundary_rule;
  meander_medial_axis medial_axis;
  meander_stop_rule stop_rule;
  uint32_t grow_into_empty; /* 1: where both sides of a strand are empty, so that no force acts on it,
                               it is perturbed and made to grow */
  uint32_t widen_loops;     /* 1: the small closed strands of a flow without a seed, and of fill_regions,
                               begin as circles wider than r where the face is smaller */
  uint32_t hold_ends;       /* 1: free ends keep r from what lies ahead of them, or grow until they do */
  uint32_t hairpin_removal_iterations; /* between growth and polish: in this many iterations the fingers
                               on the shortest runs between hairpins are drawn in, and others grow
                               into the room, while every node also repeats a share of its last step;
                               0: none */
  uint32_t polish;          /* 1: close the gaps at the end with length weights that follow the spacing */
  uint32_t iteration_limit; /* of a run, counted over the life of the flow; at least 1 */
  uint32_t threads;         /* 0: as many as the machine has; at most 256; the result is the same */
  double roughness;         /* how much of the surface's roughness the spacing follows, in [0, 1]. At 0 it
                               is measured on the surface as it is at the scale of the spacing: where it
                               is crumpled below r, vertices are smoothed, and r shrinks as lengths do
                               there. At 1 it is measured on the surface
                               as it is. Only with MEANDER_MEDIAL_AXIS_GEODESIC */
  meander_start start;
  uint32_t variation;       /* another number, another curve of the same settings, the same every time: it
                               begins at another place of every part of the surface, and the lines of a
                               full start run and are joined otherwise. With MEANDER_PRESET_PAPER a curve
                               that grows from a seed is the same in all. Decided when a flow begins;
                               meander_flow_set_options leaves it as it is */
  double tunings[16];       /* of meander_flow_options_set_tuning alone */
  uint64_t reserved[5];
} meander_flow_options;

/* Fills in the defaults of a preset; see "Structs".
 *
 * options      receives them; radius is set to 0 and must be chosen
 * struct_size  sizeof(meander_flow_options)
 * preset       MEANDER_PRESET_...; another value is refused with MEANDER_STATUS_INVALID_ARGUMENT */
MEANDER_API meander_status meander_flow_options_init(meander_flow_options* options,
                                                     size_t struct_size, meander_preset preset);

/* Warns of options that are allowed but rarely intended, one sentence each: segments so long that the
 * spacing suffers (Fig. 15), a clamp so small that the curve may not reach everywhere (Fig. 19), weights
 * far beyond the useful range.
 *
 * options   as for meander_flow_create; a field out of its range gives no warning: creating refuses it
 * index     0 for the first warning
 * text      receives the sentence, UTF-8, zero-terminated, cut to `capacity`; may be NULL when
 *           capacity is 0
 * capacity  room in `text`, in bytes
 * size      receives the bytes that the whole sentence needs, the zero included; 0 when there is no
 *           warning of this index, and then `text` is untouched. Any thread. */
MEANDER_API meander_status meander_flow_options_get_warning(const meander_flow_options* options,
                                                            size_t index, char* text, size_t capacity,
                                                            size_t* size, meander_error* error);

/* ------------------------------------------------------------------------------------------ */
/* Flow: tunings, which are experimental
 *
 * Numbers that shape the curves of a preset. Their names, ranges, meanings and defaults may change with
 * every version, without another ABI: programs that set one are tried again with every version.
 * docs/c-api.md lists those that there are. */

/* The name of a tuning, such as "polish_length_gain"; static storage.
 *
 * index     0 for the first
 * returns   NULL behind the last. Any thread. */
MEANDER_API const char* meander_tuning_name(size_t index);

/* Sets a tuning.
 *
 * options   prepared by meander_flow_options_init
 * name      of a tuning; any other is refused with MEANDER_STATUS_INVALID_ARGUMENT, by a sentence that
 *           lists those that there are
 * value     finite; one out of its range is refused likewise, by a sentence that names the range. Any
 *           thread. */
MEANDER_API meander_status meander_flow_options_set_tuning(meander_flow_options* options,
                                                           const char* name, double value,
                                                           meander_error* error);

/* Tells a tuning: the preset's until another is set.
 *
 * options   prepared by meander_flow_options_init
 * name      as in meander_flow_options_set_tuning
 * value     receives it. Any thread. */
MEANDER_API meander_status meander_flow_options_get_tuning(const meander_flow_options* options,
                                                           const char* name, double* value,
                                                           meander_error* error);

/* ------------------------------------------------------------------------------------------ */
/* Flow: cost                                                                                   */

/* What there is to fill, as far as it decides what a run costs. Measured once, it serves for any
 * options. Who knows the figures may also fill them in: with a density of 1 both areas are the area. */
typedef struct meander_extent {
  uint32_t struct_size; /* set by meander_extent_init */
  uint32_t faces;       /* of the surface */
  double length_area;   /* area of the faces, each times the mean of sqrt(density) at its vertices:
                           over the spacing it is the length of the curve. Square units, >= 0 */
  double node_area;     /* area of the faces, each times the mean density at its vertices: where
                           strands are closer, so are nodes. Square units, >= 0 */
  double edge_density;  /* length of all edges over the area of all faces, a boundary edge counted half.
                           1 / unit, >= 0 */
  double curvature;     /* sum of the angle defects of all vertices inside, in absolute value, over the
                           area of all faces: distances along a surface that is crumpled take longer to
                           measure. Radians / unit^2, >= 0 */
  uint64_t reserved[3];
} meander_extent;

/* Prepares an extent of nothing; see "Structs".
 *
 * extent       receives struct_size and zeros
 * struct_size  sizeof(meander_extent) */
MEANDER_API meander_status meander_extent_init(meander_extent* extent, size_t struct_size);

/* Measures what there is to fill on a surface: what a mask leaves out is no part of it.
 *
 * density        double[density_count] as for meander_flow_create, or NULL for 1 everywhere
 * density_count  the number of vertices passed to meander_surface_create; 0 for NULL
 * extent         prepared by meander_extent_init; receives the figures
 *
 * Reads the surface once. Any thread. */
MEANDER_API meander_status meander_surface_measure_extent(const meander_surface* surface,
                                                          const double* density, size_t density_count,
                                                          meander_extent* extent,
                                                          meander_error* error);

/* What a run to its own end comes to. All are estimates, and infinite where a number cannot hold them. */
typedef struct meander_cost {
  uint32_t struct_size; /* set by meander_cost_init */
  uint32_t reserved32;
  double nodes;
  double points;            /* of the polylines: nodes, and crossings with edges of the mesh */
  double length;            /* of the curve, in the caller's units */
  double memory;            /* most bytes that the library holds at once, the surface included */
  double processor_seconds; /* of one processor like those of docs/performance.md; the threads of a
                               run share them */
  uint64_t reserved[4];
} meander_cost;

/* Prepares the struct; see "Structs".
 *
 * cost         receives struct_size and zeros
 * struct_size  sizeof(meander_cost) */
MEANDER_API meander_status meander_cost_init(meander_cost* cost, size_t struct_size);

/* Estimates what a run costs, before anything of it exists. Arithmetic only.
 *
 * extent    of meander_surface_measure_extent
 * options   as for meander_flow_create; an iteration_limit lowers the seconds, and nothing else
 * cost      prepared by meander_cost_init; receives the figures
 *
 * The curve has a length of area over spacing, its nodes lie at an even distance, and it crosses edges
 * as often as lines that run in all directions do (Crofton). How near that comes was measured with the
 * three presets: docs/performance.md. Other weights, seeds and guides are not in it; a surface whose parts are
 * narrower than the spacing costs less memory, and where very much lies within one spacing a run takes
 * longer than said here.
 *
 * Refused with MEANDER_STATUS_INVALID_ARGUMENT: figures that are negative or not finite, a radius that
 * is no positive number. Any thread. */
MEANDER_API meander_status meander_extent_estimate_cost(const meander_extent* extent,
                                                        const meander_flow_options* options,
                                                        meander_cost* cost, meander_error* error);

/* ------------------------------------------------------------------------------------------ */
/* Flow: life                                                                                   */

typedef struct meander_flow meander_flow;

/* Places a seed on a surface, ready to flow.
 *
 * surface        not NULL; the flow keeps alive what it needs of it
 * seed           NULL: one small closed strand in the middle of the first face of every component; see
 *                widen_loops
 * density        double[density_count], each > 0 and finite, or NULL for 1 everywhere: alpha(v) =
 *                density(v) alpha, so the local spacing is the spacing divided by sqrt(density); at
 *                most a factor of 10,000 between the least and the greatest, the local r nowhere above
 *                the mesh's diagonal, and at most 500 million nodes expected
 * density_count  the number of vertices passed to meander_surface_create; 0 for NULL
 * options        not NULL; prepared by meander_flow_options_init, radius chosen
 * flow           receives the new flow; destroy it with meander_flow_destroy
 * context        or NULL; asked before the work begins and all the while */
MEANDER_API meander_status meander_flow_create(const meander_surface* surface,
                                               const meander_seed* seed, const double* density,
                                               size_t density_count,
                                               const meander_flow_options* options,
                                               meander_flow** flow, meander_context* context,
                                               meander_error* error);

/* Frees a flow; NULL is allowed. A started run is cancelled and joined first, which takes an
 * iteration at most. */
MEANDER_API void meander_flow_destroy(meander_flow* flow);

/* How the curve is to lie relative to a field of lines. */
typedef uint32_t meander_alignment;
enum {
  MEANDER_ALIGNMENT_ALONG = 0, /* parallel to it */
  MEANDER_ALIGNMENT_ACROSS = 1 /* at right angles to it */
};

/* Sets the field of lines that the option alignment_weight refers to (eq. 11, Fig. 21). Without a
 * field the weight does nothing. With a polish, strands that turn across the field count less (by
 * Geman and McClure's error): rows have to end in hairpins. To be called after meander_flow_create
 * and before the first iteration; a second call replaces the first.
 *
 * directions    double[3 * vertex_count]: a vector in space at every vertex, of any length and either
 *               sign. Its part in the surface is the line; the weight is multiplied by the sine of the
 *               angle between the vector and the normal, since what stands up from the surface says
 *               little. 0 0 0, NaN or infinite: no preference there. NULL: takes a field back
 * vertex_count  as passed to meander_surface_create; 0 for NULL
 * alignment     MEANDER_ALIGNMENT_...
 *
 * Refused with MEANDER_STATUS_INVALID_ARGUMENT after the first iteration, and when not one vertex has
 * a direction in the surface. */
MEANDER_API meander_status meander_flow_set_directions(meander_flow* flow, const double* directions,
                                                       size_t vertex_count,
                                                       meander_alignment alignment,
                                                       meander_error* error);

/* Runs one iteration (section 3 of the paper): frames, medial axis, quadratic model, solve,
 * retraction, reconnection, crossing test and back-off, refinement. After it, as before it, no two
 * segments cross or touch, every point is on the surface, and strands and fixed nodes are as seeded.
 *
 * Whatever the failure, the flow keeps the state of the last whole iteration. So it does where the
 * promise above is found broken, which is looked at before a step is kept, as far as it costs next to
 * nothing: that is a defect, MEANDER_STATUS_INTERNAL, whose sentence names the iteration. It ends a run.
 *
 * context   NULL, or a context; when it is cancelled during the step, MEANDER_STATUS_CANCELLED is
 *           returned
 * returns   MEANDER_STATUS_OK also when the flow had converged before: meander_flow_stop_reason says
 *           so, and another step is still taken, so that an interactive host decides when to stop */
MEANDER_API meander_status meander_flow_step(meander_flow* flow, meander_context* context,
                                             meander_error* error);

/* Steps until the flow converges, stalls, is cancelled or has made `iteration_limit` iterations;
 * meander_flow_stop_reason says which.
 *
 * context   NULL, or a context, which cancels the run and shows its progress
 * returns   MEANDER_STATUS_CANCELLED, or another failure, leaves the last whole iteration in place */
MEANDER_API meander_status meander_flow_run(meander_flow* flow, meander_context* context,
                                            meander_error* error);

/* Why a run of a flow ends. */
typedef uint32_t meander_stop_reason;
enum {
  MEANDER_STOP_REASON_RUNNING = 0, /* it would continue */
  MEANDER_STOP_REASON_CONVERGED = 1,
  MEANDER_STOP_REASON_ITERATION_LIMIT = 2,
  MEANDER_STOP_REASON_STALLED = 3, /* every step is blocked, and nothing moves any more */
  MEANDER_STOP_REASON_CANCELLED = 4
};

/* Why a run of this flow would end now, kept up to date by every step and run. Costs nothing.
 * MEANDER_STOP_REASON_RUNNING for NULL, and from meander_flow_start to meander_flow_wait. */
MEANDER_API meander_stop_reason meander_flow_stop_reason(const meander_flow* flow);

/* ------------------------------------------------------------------------------------------ */
/* Flow: a run in the background                                                                */

/* Begins meander_flow_run on a thread of the library and returns at once: the caller's thread copies the
 * curve for the first preview, and does no work that grows with the mesh. For hosts that must not lend a
 * thread of their own, and stay responsive meanwhile; the curve is the same to the last byte.
 *
 * Until meander_flow_wait returns, also when the run has ended by itself, the flow belongs to the
 * run: only meander_flow_is_running, meander_flow_take_preview, meander_flow_stop_reason,
 * meander_flow_wait and meander_flow_destroy may be called; everything else is refused with
 * MEANDER_STATUS_INVALID_ARGUMENT. Afterwards it can be started again.
 *
 * context   NULL, or a context, which cancels the run and shows its progress
 * returns   what keeps the run from beginning; meander_flow_wait reports what happens in it */
MEANDER_API meander_status meander_flow_start(meander_flow* flow, meander_context* context,
                                              meander_error* error);

/* 1 while a started run is going; 0 when meander_flow_wait would return at once, before a start, and
 * for NULL. Costs nothing. Any thread, also while another one makes a call on the flow, but for
 * meander_flow_destroy, which must come after the last question. */
MEANDER_API uint32_t meander_flow_is_running(const meander_flow* flow);

/* Waits for the end of a started run.
 *
 * returns   what meander_flow_run would have returned, with its sentence; MEANDER_STATUS_CANCELLED
 *           leaves the last whole iteration in place. Refused with MEANDER_STATUS_INVALID_ARGUMENT
 *           when no run has been started since the last wait */
MEANDER_API meander_status meander_flow_wait(meander_flow* flow, meander_error* error);

/* A copy of the curve of a started run; see meander_flow_take_preview. */
typedef struct meander_preview {
  uint32_t struct_size; /* set by meander_preview_init */
  uint32_t serial;      /* 1 for the curve at the start; every later copy has a greater one. 0: there was
                           none to take, and all other fields are 0 too */
  uint32_t iterations;  /* over the life of the flow */
  uint32_t nodes;
  double length;            /* of the curve */
  double seconds;           /* of all iterations */
  uint64_t kept;            /* copies of growth that come after this one; see meander_flow_keep_growth */
  size_t point_count;
  size_t strand_count;
  const double* positions;  /* this and the following as in meander_polylines */
  const uint64_t* offsets;
  const uint8_t* closed;
  meander_result* result;
  uint64_t reserved[4];
} meander_preview;

/* Prepares a preview; see "Structs". */
MEANDER_API meander_status meander_preview_init(meander_preview* preview, size_t struct_size);

/* Has started runs keep copies of the curve while it grows, for hosts that show how it grew. Growth
 * takes a small part of a run, and on a large mesh is over before a window has been drawn once.
 *
 * length_step  a copy is kept whenever the curve has become longer by this, in the caller's units,
 *              than it was at the copy that was kept last; 0, as in a new flow: none is
 * point_limit  none is kept that would make more points than this of those that have not been taken
 *              out: a point takes 24 bytes
 *
 * meander_flow_take_preview gives them in the order in which they were made. For all starts from
 * now on; each begins with none. Between two runs only. */
MEANDER_API meander_status meander_flow_keep_growth(meander_flow* flow, double length_step,
                                                    size_t point_limit, meander_error* error);

/* Takes out the newest copy of the curve of a started run, until meander_flow_wait: each copy once. The
 * run makes one at the start, and then one after its present iteration whenever the last one has been
 * taken, so a run that nobody watches copies nothing. Never waits for an iteration, only for a copy.
 *
 * preview   prepared by meander_preview_init; receives the copy, or zeros while there is none */
MEANDER_API meander_status meander_flow_take_preview(meander_flow* flow, meander_preview* preview,
                                                     meander_error* error);

/* ------------------------------------------------------------------------------------------ */
/* Flow: other wishes                                                                           */

/* What follows changes what a flow is asked for, while its curve stays and goes on from where it is:
 * a slider that is dragged, a density that is painted. Between two iterations only: a started run is
 * cancelled and waited for first, which takes one iteration, and is then started again.
 *
 * A curve that is still growing, or not even yet, goes on with that. One that has been finished is
 * fitted by iterations of the polish, much sooner than a run from scratch would be. Where the spacing, in
 * the mean along the curve, has changed by much since the curve grew, all such changes taken together,
 * and where the weights of growth change, it grows again, from the curve as it is: as even as one from
 * scratch, in about the same time. Without a polish, as in MEANDER_PRESET_PAPER, it always does.
 *
 * Nothing crosses, strands and fixed nodes are as seeded, and guides stay as drawn. Convergence is
 * judged from here on, and the iteration limit counts from here. What asks for what is there already
 * changes nothing. The same calls between the same iterations give the same bytes for any number of
 * threads. Costs about two iterations. Whatever the failure, the flow is then as before. */

/* Another radius. The local radii, segment_length and max_radius change in proportion.
 *
 * radius    r, half the spacing; > 0 and finite, in the units of the surface as it is now
 *
 * Refused with MEANDER_STATUS_INVALID_ARGUMENT: what meander_flow_create refuses as a radius. */
MEANDER_API meander_status meander_flow_set_radius(meander_flow* flow, double radius,
                                                   meander_error* error);

/* Another density.
 *
 * density        double[density_count], as in meander_flow_create; NULL: 1 everywhere
 * density_count  the number of vertices passed to meander_surface_create; 0 for NULL
 *
 * Refused with MEANDER_STATUS_INVALID_ARGUMENT: what meander_flow_create refuses as a density. */
MEANDER_API meander_status meander_flow_set_density(meander_flow* flow, const double* density,
                                                    size_t density_count, meander_error* error);

/* Other options, the radius among them; the density stays as it is. What only a beginning needs has
 * no effect: start, widen_loops, start_spacing_factor (a wide start that is under way goes on), threads;
 * hairpin_removal_iterations of a curve that began full.
 *
 * options   as for meander_flow_create, all of them: what is not to change must be as it was
 *
 * Refused with MEANDER_STATUS_INVALID_ARGUMENT: what meander_flow_create refuses as options. */
MEANDER_API meander_status meander_flow_set_options(meander_flow* flow,
                                                    const meander_flow_options* options,
                                                    meander_error* error);

/* ------------------------------------------------------------------------------------------ */
/* Flow: a surface that moves                                                                   */

/* Moves the vertices of the flow's surface, for a mesh that is animated: the faces stay as they were
 * passed to meander_surface_create, and their corners move (section 5, Fig. 20). Nodes, fixed ones
 * too, stay on their faces with the same weights of the corners. Segments become straight again,
 * except those of guides, whose lines stay as drawn and are cut further where they stretch. Nothing
 * crosses, and strands are as seeded. r and all other lengths stay the same in the caller's units, as
 * does the density at every vertex, so a surface that grows gets a longer curve in the steps that
 * follow. A few of them a frame keep the spacing even.
 *
 * A curve that fills its surface continues in the polish, with the weights that close gaps, and never
 * grows from scratch; one that is still growing continues to grow. Convergence is judged from here
 * on, and the iteration limit counts from here.
 *
 * The meander_surface that the flow was created on, and other flows on it, stay as they are.
 *
 * vertices      double[3 * vertex_count], finite, in the caller's units, in the order of
 *               meander_surface_create
 * vertex_count  the same as then
 * context       or NULL; asked before the work begins and all the while
 *
 * Refused with MEANDER_STATUS_INVALID_MESH: another number of vertices, a coordinate that is not
 * finite, a face without area; with MEANDER_STATUS_INVALID_ARGUMENT: a surface smaller than the
 * spacing, or so large that the curve would need more than 500 million nodes. Whatever the failure,
 * the flow is then as before. */
MEANDER_API meander_status meander_flow_set_vertices(meander_flow* flow, const double* vertices,
                                                     size_t vertex_count, meander_context* context,
                                                     meander_error* error);

/* ------------------------------------------------------------------------------------------ */
/* Flow: figures                                                                                */

typedef struct meander_flow_statistics {
  uint32_t struct_size; /* set by meander_flow_statistics_init */
  meander_stop_reason stop_reason;
  uint32_t iterations;
  uint32_t nodes;
  uint32_t strands;
  uint32_t closed_strands;
  uint32_t crossings;        /* pairs of pieces that cross now, counted afresh; 0 */
  uint32_t polishing;        /* 1 after growth, in hairpin removal and the polish */
  uint32_t guides;           /* strands that are guides */
  uint32_t empty_components; /* of the surface, on which no strand grows */
  double length;          /* of the curve */
  double energy;          /* eq. 2 at the present curve: t L + alpha E_M, plus bending and alignment */
  double mean_step;       /* mean length of the displacements of the last iteration */
  double spacing_target;  /* 2 r */
  double spacing_p05;     /* percentiles of twice the medial radius over all nodes and both sides, */
  double spacing_median;  /* where density is not 1 scaled to nominal, so that they compare with */
  double spacing_p95;     /* spacing_target everywhere */
  double seconds_total;
  double seconds_medial_axis;
  double seconds_solve;
  double seconds_retract;
  double seconds_reconnect;
  double seconds_crossings;
  double seconds_refine;
  double seed_distance;      /* how far a point of the seed was moved to the surface, at most */
  double seed_jump_length;   /* of the seed's longest jump, along the surface; 0: it jumps nowhere. A
                                jump is a path between neighbouring points that is longer than twice
                                the way between them as given, by more than two local r */
  uint32_t seed_point;       /* the seed point that was moved by seed_distance */
  uint32_t seed_jumps;       /* jumps of the seed, strokes from one point to another left out */
  uint32_t seed_jump_point;  /* the points before and after the longest jump */
  uint32_t seed_jump_point2;
  double evenness;        /* share of the sides of all nodes on which twice the medial radius is within
                             a fifth of spacing_target, scaled as the percentiles are; in [0, 1] */
  uint32_t small_components; /* of the surface: the diagonal of their bounding box is below spacing_target */
  float roughness;        /* mean over the surface, in radians for a disc of radius r: of the curvature,
                             in absolute value, what cancels out within a few r; 0 where nothing was
                             smoothed */
  float smoothing;        /* mean width of the Gaussian that the surface was smoothed by, in r */
  float stretch;          /* lengths on the surface in those at the scale of the spacing: the root of the
                             ratio of areas; 1 where nothing was smoothed */
  uint64_t reserved[1];
  /* How it began. A part is a strand that grows: one in every component of the surface, or region
   * between guides, or one that was drawn. */
  uint32_t start_asked_full;     /* 1: the flow was created with MEANDER_START_FULL */
  uint32_t start_full_parts;     /* parts that began full; 0 before the first iteration */
  uint32_t start_grown_parts;    /* parts that were to begin full and grow instead, which is the sum of the
                                    next two */
  uint32_t start_no_room_parts;  /* since no line has room, as where the surface is narrower than two
                                    spacings */
  uint32_t start_crossing_parts; /* since nothing could be laid without a crossing */
  uint32_t completed_parts;      /* parts that had grown, and were joined to lines laid in what was still
                                    empty and far from them */
} meander_flow_statistics;

/* Prepares the struct; see "Structs".
 *
 * statistics   receives struct_size and zeros
 * struct_size  sizeof(meander_flow_statistics) */
MEANDER_API meander_status meander_flow_statistics_init(meander_flow_statistics* statistics,
                                                        size_t struct_size);

/* Computes the figures of the present state. Costs one medial axis and one crossing test; the curve
 * stays as it is.
 *
 * statistics   prepared by meander_flow_statistics_init; receives them
 * context      or NULL; asked before the work begins and all the while */
MEANDER_API meander_status meander_flow_compute_statistics(meander_flow* flow,
                                                           meander_flow_statistics* statistics,
                                                           meander_context* context,
                                                           meander_error* error);

/* The record of one iteration; see meander_flow_get_history. */
typedef struct meander_iteration {
  uint32_t iteration; /* from 1 */
  uint32_t nodes;
  double length;
  double mean_step;
  double energy;
  double seconds; /* of this iteration */
} meander_iteration;

/* Copies the records of all iterations so far, oldest first.
 *
 * records      meander_iteration[capacity], or NULL when capacity is 0
 * record_size  sizeof(meander_iteration): how far apart the records are, and how much of each is
 *              written, as with struct_size
 * capacity     room in the array, in records
 * count        receives the number of iterations so far; when it exceeds capacity nothing is copied */
MEANDER_API meander_status meander_flow_get_history(const meander_flow* flow,
                                                    meander_iteration* records, size_t record_size,
                                                    size_t capacity, size_t* count,
                                                    meander_error* error);

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
 * corner below 57 degrees.
 *
 * least_size  how large a place must be to count, in local r, from 1 to 1e6; 0: 1.2
 * gaps        prepared by meander_gaps_init; receives them
 * context     or NULL; asked before the work begins and all the while
 *
 * Costs one medial axis and a few nearest-point queries a node and face. The curve stays as it is. */
MEANDER_API meander_status meander_flow_find_gaps(meander_flow* flow, double least_size,
                                                  meander_gaps* gaps, meander_context* context,
                                                  meander_error* error);

/* ------------------------------------------------------------------------------------------ */
/* Flow: the surface cut along the curve                                                        */

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
 * weights    float[3 * point_count]: of the corners of these faces
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

#endif /* MEANDER_H */
