/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A flow: its life, its runs, what it is asked for while it lives, and its figures. Part of meander.h. */
#ifndef MEANDER_FLOW_H
#define MEANDER_FLOW_H

#include "flow_options.h"

#ifdef __cplusplus
extern "C" {
#endif

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
  MEANDER_STOP_REASON_STALLED = 3, /* every step is blocked, and some of the surface is empty */
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

#ifdef __cplusplus
}
#endif

#endif /* MEANDER_FLOW_H */
