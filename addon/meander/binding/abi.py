# SPDX-License-Identifier: GPL-3.0-or-later
"""``meander.h`` as ctypes sees it: enumerations, structs, prototypes.

Every struct and every prototype stands beside the C line that it mirrors, and the tests compare
both sides. Nothing is called here.
"""

from __future__ import annotations

from ctypes import (
    POINTER,
    Structure,
    c_char,
    c_char_p,
    c_double,
    c_int32,
    c_size_t,
    c_uint32,
    c_void_p,
)
from enum import IntEnum
from typing import Any

# The version of the library that this add-on was written for. The library's file name carries it,
# so that an update never meets the old library that a running Blender still has loaded.
VERSION = "0.1.0"

# #define MEANDER_ABI_VERSION 1
ABI_VERSION = 1


# ------------------------------------------------------------------------------------------------
# Enumerations


# enum { MEANDER_OK = 0, ... MEANDER_INTERNAL = 6 };
class Status(IntEnum):
    """What a call returned; `MeanderError.status` is one of these."""

    OK = 0
    INVALID_ARGUMENT = 1
    INVALID_MESH = 2
    INVALID_SEED = 3
    CANCELLED = 4
    OUT_OF_MEMORY = 5
    INTERNAL = 6


# enum { MEANDER_ELEMENT_NONE = 0, ... MEANDER_ELEMENT_SEED_POINT = 4 };
ELEMENT_KINDS = (None, "vertex", "face", "edge", "seed_point")

# enum { MEANDER_PRESET_EVEN = 0, MEANDER_PRESET_PAPER = 1, MEANDER_PRESET_FINEST = 2 };
PRESETS = ("even", "paper", "finest")


# enum { MEANDER_BOUNDARY_CENTRE = 0, MEANDER_BOUNDARY_OBSTACLE = 1 };
class BoundaryRule(IntEnum):
    """How a medial ball ends at the boundary of an open surface."""

    CENTRE = 0
    OBSTACLE = 1


# enum { MEANDER_MEDIAL_AXIS_EUCLIDEAN = 0, MEANDER_MEDIAL_AXIS_GEODESIC = 1 };
class MedialAxis(IntEnum):
    """How distances between strands are measured: through space or along the surface."""

    EUCLIDEAN = 0
    GEODESIC = 1


# enum { MEANDER_STOP_SETTLED = 0, MEANDER_STOP_PAPER = 1 };
class StopRule(IntEnum):
    """When a flow has converged."""

    SETTLED = 0
    PAPER = 1


# enum { MEANDER_CURVATURE_GAUSSIAN = 0, ... MEANDER_CURVATURE_CURVEDNESS = 4 };
CURVATURES = ("gaussian", "mean", "absolute_gaussian", "absolute_mean", "curvedness")

# enum { MEANDER_DIRECTIONS_CURVATURE_MIN = 0, ... MEANDER_DIRECTIONS_SMOOTH = 2 };
DIRECTIONS = ("curvature_min", "curvature_max", "smooth")

# enum { MEANDER_ALIGN_ALONG = 0, MEANDER_ALIGN_ACROSS = 1 };
ALIGNMENTS = ("along", "across")

# enum { MEANDER_RUNNING = 0, ... MEANDER_STOPPED = 4 };
STOP_REASONS = ("running", "converged", "iteration_limit", "stalled", "cancelled")


# ------------------------------------------------------------------------------------------------
# Structs


class ErrorRecord(Structure):
    """typedef struct meander_error"""

    _fields_ = [
        ("struct_size", c_uint32),  # uint32_t struct_size;
        ("status", c_int32),  # int32_t status;
        ("element_kind", c_int32),  # int32_t element_kind;
        ("element_index", c_uint32),  # uint32_t element_index;
        ("element_index2", c_uint32),  # uint32_t element_index2;
        ("text", c_char * 492),  # char text[492];
    ]


class SurfaceOptionsRecord(Structure):
    """typedef struct meander_surface_options"""

    _fields_ = [
        ("struct_size", c_uint32),  # uint32_t struct_size;
        ("drop_degenerate", c_uint32),  # uint32_t drop_degenerate;
        ("split_bow_ties", c_uint32),  # uint32_t split_bow_ties;
        ("cut_non_manifold", c_uint32),  # uint32_t cut_non_manifold;
        ("merge_distance", c_double),  # double merge_distance;
        ("face_mask", c_void_p),  # const uint8_t* face_mask;
        ("vertex_mask", c_void_p),  # const double* vertex_mask;
        ("mask_threshold", c_double),  # double mask_threshold;
        ("threads", c_uint32),  # uint32_t threads;
        ("reserved", c_uint32),  # uint32_t reserved;
    ]


class SurfaceStatisticsRecord(Structure):
    """typedef struct meander_surface_statistics"""

    _fields_ = [
        ("struct_size", c_uint32),  # uint32_t struct_size;
        ("vertices", c_uint32),  # uint32_t vertices;
        ("faces", c_uint32),  # uint32_t faces;
        ("components", c_uint32),  # uint32_t components;
        ("boundary_loops", c_uint32),  # uint32_t boundary_loops;
        ("turned_faces", c_uint32),  # uint32_t turned_faces;
        ("unused_vertices", c_uint32),  # uint32_t unused_vertices;
        ("merged_vertices", c_uint32),  # uint32_t merged_vertices;
        ("dropped_faces", c_uint32),  # uint32_t dropped_faces;
        ("split_vertices", c_uint32),  # uint32_t split_vertices;
        ("cut_edges", c_uint32),  # uint32_t cut_edges;
        ("masked_faces", c_uint32),  # uint32_t masked_faces;
        ("clipped_faces", c_uint32),  # uint32_t clipped_faces;
        ("reserved", c_uint32),  # uint32_t reserved;
        ("area", c_double),  # double area;
        ("diagonal", c_double),  # double diagonal;
    ]


class SeedRecord(Structure):
    """typedef struct meander_seed"""

    _fields_ = [
        ("struct_size", c_uint32),  # uint32_t struct_size;
        ("strand_count", c_uint32),  # uint32_t strand_count;
        ("points", c_void_p),  # const double* points;
        ("offsets", c_void_p),  # const uint32_t* offsets;
        ("closed", c_void_p),  # const uint8_t* closed;
        ("fixed", c_void_p),  # const uint8_t* fixed;
        ("guides", c_void_p),  # const uint8_t* guides;
        ("loops", c_uint32),  # uint32_t loops;
        ("reserved", c_uint32),  # uint32_t reserved;
    ]


class FlowOptionsRecord(Structure):
    """typedef struct meander_flow_options"""

    _fields_ = [
        ("struct_size", c_uint32),  # uint32_t struct_size;
        ("preset", c_uint32),  # uint32_t preset;
        ("radius", c_double),  # double radius;
        ("segment_length", c_double),  # double segment_length;
        ("max_radius", c_double),  # double max_radius;
        ("length_weight", c_double),  # double length_weight;
        ("bending_weight", c_double),  # double bending_weight;
        ("medial_weight", c_double),  # double medial_weight;
        ("alignment_weight", c_double),  # double alignment_weight;
        ("length_power", c_double),  # double length_power;
        ("medial_power", c_double),  # double medial_power;
        ("step", c_double),  # double step;
        ("growth_coarsening", c_double),  # double growth_coarsening;
        ("start_spacing_factor", c_double),  # double start_spacing_factor;
        ("polish", c_uint32),  # uint32_t polish;
        ("stop_rule", c_uint32),  # uint32_t stop_rule;
        ("polish_bending_weight", c_double),  # double polish_bending_weight;
        ("polish_length_offset", c_double),  # double polish_length_offset;
        ("polish_length_gain", c_double),  # double polish_length_gain;
        ("polish_medial_power", c_double),  # double polish_medial_power;
        ("border_distance", c_double),  # double border_distance;
        ("boundary_rule", c_uint32),  # uint32_t boundary_rule;
        ("iteration_limit", c_uint32),  # uint32_t iteration_limit;
        ("threads", c_uint32),  # uint32_t threads;
        ("ripening_iterations", c_uint32),  # uint32_t ripening_iterations;
        ("medial_axis", c_uint32),  # uint32_t medial_axis;
        ("reserved", c_uint32),  # uint32_t reserved;
    ]


class FlowStatisticsRecord(Structure):
    """typedef struct meander_flow_statistics"""

    _fields_ = [
        ("struct_size", c_uint32),  # uint32_t struct_size;
        ("stop_reason", c_uint32),  # uint32_t stop_reason;
        ("iterations", c_uint32),  # uint32_t iterations;
        ("nodes", c_uint32),  # uint32_t nodes;
        ("strands", c_uint32),  # uint32_t strands;
        ("closed_strands", c_uint32),  # uint32_t closed_strands;
        ("crossings", c_uint32),  # uint32_t crossings;
        ("polishing", c_uint32),  # uint32_t polishing;
        ("guides", c_uint32),  # uint32_t guides;
        ("empty_components", c_uint32),  # uint32_t empty_components;
        ("length", c_double),  # double length;
        ("energy", c_double),  # double energy;
        ("mean_step", c_double),  # double mean_step;
        ("spacing_target", c_double),  # double spacing_target;
        ("spacing_p05", c_double),  # double spacing_p05;
        ("spacing_median", c_double),  # double spacing_median;
        ("spacing_p95", c_double),  # double spacing_p95;
        ("seconds_total", c_double),  # double seconds_total;
        ("seconds_medial_axis", c_double),  # double seconds_medial_axis;
        ("seconds_solve", c_double),  # double seconds_solve;
        ("seconds_retract", c_double),  # double seconds_retract;
        ("seconds_reconnect", c_double),  # double seconds_reconnect;
        ("seconds_crossings", c_double),  # double seconds_crossings;
        ("seconds_refine", c_double),  # double seconds_refine;
    ]


class IterationRecord(Structure):
    """typedef struct meander_iteration"""

    _fields_ = [
        ("iteration", c_uint32),  # uint32_t iteration;
        ("nodes", c_uint32),  # uint32_t nodes;
        ("length", c_double),  # double length;
        ("mean_step", c_double),  # double mean_step;
        ("energy", c_double),  # double energy;
        ("seconds", c_double),  # double seconds;
    ]


class PreviewRecord(Structure):
    """typedef struct meander_preview"""

    _fields_ = [
        ("struct_size", c_uint32),  # uint32_t struct_size;
        ("serial", c_uint32),  # uint32_t serial;
        ("iterations", c_uint32),  # uint32_t iterations;
        ("nodes", c_uint32),  # uint32_t nodes;
        ("length", c_double),  # double length;
        ("seconds", c_double),  # double seconds;
    ]


STRUCTS: dict[str, type[Structure]] = {
    "meander_error": ErrorRecord,
    "meander_surface_options": SurfaceOptionsRecord,
    "meander_surface_statistics": SurfaceStatisticsRecord,
    "meander_seed": SeedRecord,
    "meander_flow_options": FlowOptionsRecord,
    "meander_flow_statistics": FlowStatisticsRecord,
    "meander_iteration": IterationRecord,
    "meander_preview": PreviewRecord,
}


# ------------------------------------------------------------------------------------------------
# Prototypes: name -> (result, arguments). Array arguments are void pointers, since `checked_array`
# has seen to what they point to; opaque handles are void pointers as well.

PROTOTYPES: dict[str, tuple[Any, tuple[Any, ...]]] = {
    # const char* meander_status_name(meander_status status);
    "meander_status_name": (c_char_p, (c_int32,)),
    # const char* meander_version(void);
    "meander_version": (c_char_p, ()),
    # uint32_t meander_abi_version(void);
    "meander_abi_version": (c_uint32, ()),
    # size_t meander_struct_layout(const char* name, size_t* layout, size_t capacity);
    "meander_struct_layout": (c_size_t, (c_char_p, POINTER(c_size_t), c_size_t)),
    # meander_context* meander_context_create(void);
    "meander_context_create": (c_void_p, ()),
    # void meander_context_destroy(meander_context* context);
    "meander_context_destroy": (None, (c_void_p,)),
    # void meander_context_cancel(meander_context* context);
    "meander_context_cancel": (None, (c_void_p,)),
    # void meander_context_reset(meander_context* context);
    "meander_context_reset": (None, (c_void_p,)),
    # double meander_context_progress(const meander_context* context);
    "meander_context_progress": (c_double, (c_void_p,)),
    # meander_status meander_surface_create(const double* vertices, size_t vertex_count,
    #     const uint32_t* faces, size_t face_count, meander_surface** surface,
    #     meander_error* error);
    "meander_surface_create": (
        c_int32,
        (c_void_p, c_size_t, c_void_p, c_size_t, POINTER(c_void_p), POINTER(ErrorRecord)),
    ),
    # meander_status meander_surface_options_init(meander_surface_options* options);
    "meander_surface_options_init": (c_int32, (POINTER(SurfaceOptionsRecord),)),
    # meander_status meander_surface_create_prepared(const double* vertices, size_t vertex_count,
    #     const uint32_t* faces, size_t face_count, const meander_surface_options* options,
    #     meander_surface** surface, meander_error* error);
    "meander_surface_create_prepared": (
        c_int32,
        (
            c_void_p,
            c_size_t,
            c_void_p,
            c_size_t,
            POINTER(SurfaceOptionsRecord),
            POINTER(c_void_p),
            POINTER(ErrorRecord),
        ),
    ),
    # void meander_surface_destroy(meander_surface* surface);
    "meander_surface_destroy": (None, (c_void_p,)),
    # meander_status meander_surface_get_statistics(const meander_surface* surface,
    #     meander_surface_statistics* statistics, meander_error* error);
    "meander_surface_get_statistics": (
        c_int32,
        (c_void_p, POINTER(SurfaceStatisticsRecord), POINTER(ErrorRecord)),
    ),
    # meander_status meander_surface_get_outlines(const meander_surface* surface, double distance,
    #     double spacing, double* positions, size_t point_capacity, size_t* point_count,
    #     uint32_t* offsets, uint8_t* closed, size_t strand_capacity, size_t* strand_count,
    #     uint32_t* skipped, meander_error* error);
    "meander_surface_get_outlines": (
        c_int32,
        (
            c_void_p,
            c_double,
            c_double,
            c_void_p,
            c_size_t,
            POINTER(c_size_t),
            c_void_p,
            c_void_p,
            c_size_t,
            POINTER(c_size_t),
            c_void_p,
            POINTER(ErrorRecord),
        ),
    ),
    # meander_status meander_flow_options_init(meander_flow_options* options, uint32_t preset);
    "meander_flow_options_init": (c_int32, (POINTER(FlowOptionsRecord), c_uint32)),
    # size_t meander_flow_options_get_warning(const meander_flow_options* options, uint32_t index,
    #     char* text, size_t capacity);
    "meander_flow_options_get_warning": (
        c_size_t,
        (POINTER(FlowOptionsRecord), c_uint32, c_char_p, c_size_t),
    ),
    # meander_status meander_surface_get_curvature(const meander_surface* surface, uint32_t kind,
    #     double smoothing, double* values, size_t vertex_count, meander_error* error);
    "meander_surface_get_curvature": (
        c_int32,
        (c_void_p, c_uint32, c_double, c_void_p, c_size_t, POINTER(ErrorRecord)),
    ),
    # meander_status meander_surface_get_directions(const meander_surface* surface, uint32_t kind,
    #     double smoothing, double* directions, size_t vertex_count, meander_error* error);
    "meander_surface_get_directions": (
        c_int32,
        (c_void_p, c_uint32, c_double, c_void_p, c_size_t, POINTER(ErrorRecord)),
    ),
    # meander_status meander_surface_extend_directions(const meander_surface* surface,
    #     const double* points, const uint32_t* offsets, size_t stroke_count, double* directions,
    #     size_t vertex_count, meander_error* error);
    "meander_surface_extend_directions": (
        c_int32,
        (c_void_p, c_void_p, c_void_p, c_size_t, c_void_p, c_size_t, POINTER(ErrorRecord)),
    ),
    # meander_status meander_flow_set_directions(meander_flow* flow, const double* directions,
    #     size_t vertex_count, uint32_t kind, meander_error* error);
    "meander_flow_set_directions": (
        c_int32,
        (c_void_p, c_void_p, c_size_t, c_uint32, POINTER(ErrorRecord)),
    ),
    # meander_status meander_flow_create(const meander_surface* surface, const meander_seed* seed,
    #     const double* density, const meander_flow_options* options, meander_flow** flow,
    #     meander_error* error);
    "meander_flow_create": (
        c_int32,
        (
            c_void_p,
            POINTER(SeedRecord),
            c_void_p,
            POINTER(FlowOptionsRecord),
            POINTER(c_void_p),
            POINTER(ErrorRecord),
        ),
    ),
    # void meander_flow_destroy(meander_flow* flow);
    "meander_flow_destroy": (None, (c_void_p,)),
    # meander_status meander_flow_step(meander_flow* flow, meander_context* context,
    #     meander_error* error);
    "meander_flow_step": (c_int32, (c_void_p, c_void_p, POINTER(ErrorRecord))),
    # meander_status meander_flow_run(meander_flow* flow, meander_context* context,
    #     meander_error* error);
    "meander_flow_run": (c_int32, (c_void_p, c_void_p, POINTER(ErrorRecord))),
    # meander_status meander_flow_start(meander_flow* flow, meander_context* context,
    #     meander_error* error);
    "meander_flow_start": (c_int32, (c_void_p, c_void_p, POINTER(ErrorRecord))),
    # uint32_t meander_flow_is_running(const meander_flow* flow);
    "meander_flow_is_running": (c_uint32, (c_void_p,)),
    # meander_status meander_flow_wait(meander_flow* flow, meander_error* error);
    "meander_flow_wait": (c_int32, (c_void_p, POINTER(ErrorRecord))),
    # meander_status meander_flow_get_preview(meander_flow* flow, meander_preview* preview,
    #     double* positions, double* normals, size_t point_capacity, size_t* point_count,
    #     uint32_t* offsets, uint8_t* closed, size_t strand_capacity, size_t* strand_count,
    #     meander_error* error);
    "meander_flow_get_preview": (
        c_int32,
        (
            c_void_p,
            POINTER(PreviewRecord),
            c_void_p,
            c_void_p,
            c_size_t,
            POINTER(c_size_t),
            c_void_p,
            c_void_p,
            c_size_t,
            POINTER(c_size_t),
            POINTER(ErrorRecord),
        ),
    ),
    # meander_status meander_flow_set_vertices(meander_flow* flow, const double* vertices,
    #     size_t vertex_count, meander_error* error);
    "meander_flow_set_vertices": (c_int32, (c_void_p, c_void_p, c_size_t, POINTER(ErrorRecord))),
    # uint32_t meander_flow_stop_reason(const meander_flow* flow);
    "meander_flow_stop_reason": (c_uint32, (c_void_p,)),
    # meander_status meander_flow_get_statistics(meander_flow* flow,
    #     meander_flow_statistics* statistics, meander_error* error);
    "meander_flow_get_statistics": (
        c_int32,
        (c_void_p, POINTER(FlowStatisticsRecord), POINTER(ErrorRecord)),
    ),
    # meander_status meander_flow_get_history(const meander_flow* flow, meander_iteration* records,
    #     size_t capacity, size_t* count, meander_error* error);
    "meander_flow_get_history": (
        c_int32,
        (c_void_p, POINTER(IterationRecord), c_size_t, POINTER(c_size_t), POINTER(ErrorRecord)),
    ),
    # meander_status meander_flow_get_polylines(const meander_flow* flow, double* positions,
    #     double* normals, size_t point_capacity, size_t* point_count, uint32_t* offsets,
    #     uint8_t* closed, size_t strand_capacity, size_t* strand_count, meander_error* error);
    "meander_flow_get_polylines": (
        c_int32,
        (
            c_void_p,
            c_void_p,
            c_void_p,
            c_size_t,
            POINTER(c_size_t),
            c_void_p,
            c_void_p,
            c_size_t,
            POINTER(c_size_t),
            POINTER(ErrorRecord),
        ),
    ),
    # meander_status meander_flow_get_guides(const meander_flow* flow, uint8_t* guides,
    #     size_t capacity, size_t* count, meander_error* error);
    "meander_flow_get_guides": (
        c_int32,
        (c_void_p, c_void_p, c_size_t, POINTER(c_size_t), POINTER(ErrorRecord)),
    ),
    # meander_status meander_flow_get_nodes(const meander_flow* flow, uint32_t* faces,
    #     double* barycentrics, double* radii, uint8_t* fixed, size_t capacity, size_t* count,
    #     meander_error* error);
    "meander_flow_get_nodes": (
        c_int32,
        (
            c_void_p,
            c_void_p,
            c_void_p,
            c_void_p,
            c_void_p,
            c_size_t,
            POINTER(c_size_t),
            POINTER(ErrorRecord),
        ),
    ),
    # meander_status meander_flow_get_point_data(meander_flow* flow, double* arc_lengths,
    #     double* normals, double* tangents, double* radii, uint32_t* faces,
    #     double* barycentrics, size_t capacity, size_t* count, meander_error* error);
    "meander_flow_get_point_data": (
        c_int32,
        (
            c_void_p,
            c_void_p,
            c_void_p,
            c_void_p,
            c_void_p,
            c_void_p,
            c_void_p,
            c_size_t,
            POINTER(c_size_t),
            POINTER(ErrorRecord),
        ),
    ),
    # meander_status meander_flow_get_gaps(meander_flow* flow, double least_size,
    #     double* positions, double* radii, double* sizes, uint32_t* faces, size_t capacity,
    #     size_t* count, meander_error* error);
    "meander_flow_get_gaps": (
        c_int32,
        (
            c_void_p,
            c_double,
            c_void_p,
            c_void_p,
            c_void_p,
            c_void_p,
            c_size_t,
            POINTER(c_size_t),
            POINTER(ErrorRecord),
        ),
    ),
}
