/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a flow begins with, and what it will cost. Part of meander.h. */
#ifndef MEANDER_FLOW_OPTIONS_H
#define MEANDER_FLOW_OPTIONS_H

#include "surface.h"

#ifdef __cplusplus
extern "C" {
#endif

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

#ifdef __cplusplus
}
#endif

#endif /* MEANDER_FLOW_OPTIONS_H */
