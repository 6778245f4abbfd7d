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
 *     meander_opening_start_... / wait all of that on a thread of the library
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
 *           see "Results" in library.h. Everything else goes into the caller's own memory.
 * Structs.  Every struct of the caller's begins with struct_size and is prepared by its _init
 *           function, so that it can grow without breaking programs compiled earlier; see "Structs"
 *           in library.h.
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

/* The version of this header; meander_version() tells the library's. */
#define MEANDER_VERSION_MAJOR 0
#define MEANDER_VERSION_MINOR 1
#define MEANDER_VERSION_PATCH 0

/* Grows only when a program compiled against an older header would no longer work. What is merely
 * added leaves it as it is. meander_abi_version() tells the library's. */
#define MEANDER_ABI_VERSION 3

#include "library.h"
#include "polygons.h"
#include "surface.h"
#include "fields.h"
#include "flow_options.h"
#include "flow.h"
#include "opening.h"
#include "curve.h"
#include "cut.h"

#endif /* MEANDER_H */
