/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What lasts before the first iteration of a flow, in the background. Part of meander.h. */
#ifndef MEANDER_OPENING_H
#define MEANDER_OPENING_H

#include "fields.h"
#include "flow.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------ */
/* Opening: surfaces, fields and flows, made in the background                                  */

/* Makes what a run needs before its first iteration on a thread of the library, as meander_flow_start runs a
 * flow: for hosts that must not lend a thread of their own, and stay responsive with meshes of millions of
 * faces. One call at a time: one of meander_opening_start_..., which returns at once, and then
 * meander_opening_wait, which returns what the call of the same name that is made at once would have. What
 * it makes is the same to the last byte.
 *
 * Until meander_opening_wait returns, all that the call was given belongs to it, structs and arrays included:
 * they stay where and as they are. Its outputs are written by meander_opening_wait, and only where that
 * returns MEANDER_STATUS_OK; but arrays that are filled may be written to at any time until then.
 *
 * context   NULL, or a context, which cancels the call and shows its progress, where it has any, from 0 on */
typedef struct meander_opening meander_opening;

/* Makes one that has begun nothing.
 *
 * opening   receives it; destroy it with meander_opening_destroy */
MEANDER_API meander_status meander_opening_create(meander_opening** opening, meander_error* error);

/* Frees an opening; NULL is allowed. What has been begun is cancelled and joined first, and what it has made
 * is freed. */
MEANDER_API void meander_opening_destroy(meander_opening* opening);

/* Begins meander_surface_create. */
MEANDER_API meander_status meander_opening_start_surface(meander_opening* opening, const double* vertices,
                                                         size_t vertex_count, const uint32_t* faces,
                                                         size_t face_count,
                                                         const meander_surface_options* options,
                                                         meander_surface** surface, meander_context* context,
                                                         meander_error* error);

/* Begins meander_flow_create. */
MEANDER_API meander_status meander_opening_start_flow(meander_opening* opening, const meander_surface* surface,
                                                      const meander_seed* seed, const double* density,
                                                      size_t density_count, const meander_flow_options* options,
                                                      meander_flow** flow, meander_context* context,
                                                      meander_error* error);

/* Begins meander_surface_compute_curvature. */
MEANDER_API meander_status meander_opening_start_curvature(meander_opening* opening,
                                                           const meander_surface* surface,
                                                           meander_curvature kind, double smoothing,
                                                           double* values, size_t vertex_count,
                                                           meander_context* context, meander_error* error);

/* Begins meander_surface_compute_directions. */
MEANDER_API meander_status meander_opening_start_directions(meander_opening* opening,
                                                            const meander_surface* surface,
                                                            meander_directions kind, double smoothing,
                                                            double* directions, size_t vertex_count,
                                                            meander_context* context, meander_error* error);

/* Begins meander_surface_measure_extent, which a context cancels before it begins only. */
MEANDER_API meander_status meander_opening_start_extent(meander_opening* opening, const meander_surface* surface,
                                                        const double* density, size_t density_count,
                                                        meander_extent* extent, meander_context* context,
                                                        meander_error* error);

/* 1 while something is being made; 0 when meander_opening_wait would return at once, before anything has been
 * begun, and for NULL. Costs nothing. Any thread, but not after meander_opening_destroy has been called. */
MEANDER_API uint32_t meander_opening_is_running(const meander_opening* opening);

/* Waits for the end of what has been begun.
 *
 * returns   what the call itself would have returned, with its sentence. Refused with
 *           MEANDER_STATUS_INVALID_ARGUMENT where nothing has been begun since the last wait */
MEANDER_API meander_status meander_opening_wait(meander_opening* opening, meander_error* error);

#ifdef __cplusplus
}
#endif

#endif /* MEANDER_OPENING_H */
