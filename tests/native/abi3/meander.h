/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The declarations of meander.h as they were when ABI 3 began; what they mean is said there. */
#ifndef MEANDER_H
#define MEANDER_H

#include <stddef.h>
#include <stdint.h>

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

#define MEANDER_VERSION_MAJOR 0
#define MEANDER_VERSION_MINOR 1
#define MEANDER_VERSION_PATCH 0

#define MEANDER_ABI_VERSION 3

#ifdef __cplusplus
extern "C" {
#endif

MEANDER_API const char* meander_version(void);
MEANDER_API uint32_t meander_abi_version(void);
MEANDER_API size_t meander_struct_layout(const char* name, size_t* layout, size_t capacity);

typedef struct meander_result meander_result;

MEANDER_API void meander_result_destroy(meander_result* result);

typedef int32_t meander_status;
enum {
  MEANDER_STATUS_OK = 0,
  MEANDER_STATUS_INVALID_ARGUMENT = 1,
  MEANDER_STATUS_INVALID_MESH = 2,
  MEANDER_STATUS_INVALID_SEED = 3,
  MEANDER_STATUS_CANCELLED = 4,
  MEANDER_STATUS_OUT_OF_MEMORY = 5,
  MEANDER_STATUS_INTERNAL = 6
};

MEANDER_API const char* meander_status_name(meander_status status);

typedef uint32_t meander_element;
enum {
  MEANDER_ELEMENT_NONE = 0,
  MEANDER_ELEMENT_VERTEX = 1,
  MEANDER_ELEMENT_FACE = 2,
  MEANDER_ELEMENT_EDGE = 3,
  MEANDER_ELEMENT_SEED_POINT = 4
};

typedef struct meander_error {
  uint32_t struct_size;
  meander_status status;
  meander_element element_kind;
  uint32_t element_index;
  uint32_t element_index2;
  char text[492];
  uint64_t reserved[4];
} meander_error;

MEANDER_API meander_status meander_error_init(meander_error* error, size_t struct_size);

typedef struct meander_context meander_context;

MEANDER_API meander_status meander_context_create(meander_context** context, meander_error* error);
MEANDER_API void meander_context_destroy(meander_context* context);
MEANDER_API void meander_context_cancel(meander_context* context);
MEANDER_API void meander_context_reset(meander_context* context);
MEANDER_API double meander_context_progress(const meander_context* context);

typedef uint32_t meander_phase;
enum {
  MEANDER_PHASE_NONE = 0,
  MEANDER_PHASE_GROWTH = 1,
  MEANDER_PHASE_HAIRPIN_REMOVAL = 2,
  MEANDER_PHASE_POLISH = 3
};

MEANDER_API meander_phase meander_context_phase(const meander_context* context);

typedef uint32_t meander_text;
enum {
  MEANDER_TEXT_OBJ_FACES = 0,
  MEANDER_TEXT_OBJ_LINES = 1,
  MEANDER_TEXT_STL = 2
};

typedef struct meander_polygons {
  uint32_t struct_size;
  uint32_t reserved32;
  size_t point_count;
  size_t corner_count;
  size_t polygon_count;
  size_t left_out;
  const double* positions;
  const uint32_t* corners;
  const uint64_t* ends;
  const uint32_t* lines;
  meander_result* result;
  uint64_t reserved[4];
} meander_polygons;

MEANDER_API meander_status meander_polygons_init(meander_polygons* polygons, size_t struct_size);
MEANDER_API meander_status meander_text_read_polygons(const char* text, size_t size, meander_text kind,
                                                      meander_polygons* polygons, meander_error* error);
MEANDER_API meander_status meander_text_read_numbers(const char* text, size_t size, double* numbers,
                                                     size_t capacity, size_t* count, size_t* end,
                                                     meander_error* error);

typedef struct meander_triangles {
  uint32_t struct_size;
  uint32_t reserved32;
  size_t count;
  const uint32_t* corners;
  const uint32_t* polygons;
  meander_result* result;
  uint64_t reserved[4];
} meander_triangles;

MEANDER_API meander_status meander_triangles_init(meander_triangles* triangles, size_t struct_size);
MEANDER_API meander_status meander_polygons_triangulate(const double* vertices, size_t vertex_count,
                                                        const uint32_t* corners, size_t corner_count,
                                                        const uint64_t* ends, size_t polygon_count,
                                                        meander_triangles* triangles,
                                                        meander_error* error);

typedef struct meander_surface meander_surface;

typedef struct meander_surface_options {
  uint32_t struct_size;
  uint32_t drop_degenerate;
  uint32_t split_bow_ties;
  uint32_t cut_non_manifold;
  double merge_distance;
  const uint8_t* face_mask;
  const double* vertex_mask;
  size_t face_mask_count;
  size_t vertex_mask_count;
  double mask_threshold;
  uint32_t threads;
  uint32_t make_manifold;
  double weld_distance;
  double smallest_part;
  uint64_t reserved[4];
} meander_surface_options;

MEANDER_API meander_status meander_surface_options_init(meander_surface_options* options,
                                                        size_t struct_size);
MEANDER_API meander_status meander_surface_create(const double* vertices, size_t vertex_count,
                                                  const uint32_t* faces, size_t face_count,
                                                  const meander_surface_options* options,
                                                  meander_surface** surface,
                                                  meander_context* context, meander_error* error);
MEANDER_API void meander_surface_destroy(meander_surface* surface);

typedef struct meander_surface_statistics {
  uint32_t struct_size;
  uint32_t vertices;
  uint32_t faces;
  uint32_t components;
  uint32_t boundary_loops;
  uint32_t flipped_faces;
  uint32_t unused_vertices;
  uint32_t merged_vertices;
  uint32_t dropped_faces;
  uint32_t split_vertices;
  uint32_t cut_edges;
  uint32_t masked_faces;
  uint32_t clipped_faces;
  uint32_t welded_edges;
  double area;
  double diagonal;
  uint32_t opened_edges;
  uint32_t doubled_faces;
  uint32_t split_edges;
  uint32_t small_parts;
  uint64_t reserved[4];
} meander_surface_statistics;

MEANDER_API meander_status meander_surface_statistics_init(meander_surface_statistics* statistics,
                                                           size_t struct_size);
MEANDER_API meander_status meander_surface_get_statistics(const meander_surface* surface,
                                                          meander_surface_statistics* statistics,
                                                          meander_error* error);

typedef uint32_t meander_fault;
enum {
  MEANDER_FAULT_NOT_FINITE = 0,
  MEANDER_FAULT_NO_AREA = 1,
  MEANDER_FAULT_DOUBLED_FACE = 2,
  MEANDER_FAULT_CROWDED_EDGE = 3,
  MEANDER_FAULT_BOW_TIE = 4,
  MEANDER_FAULT_ONE_SIDED = 5,
  MEANDER_FAULT_SEAM = 6
};

typedef struct meander_faults {
  uint32_t struct_size;
  uint32_t reserved32;
  size_t count;
  const uint32_t* kinds;
  const uint32_t* elements;
  meander_result* result;
  uint64_t reserved[4];
} meander_faults;

MEANDER_API meander_status meander_faults_init(meander_faults* faults, size_t struct_size);
MEANDER_API meander_status meander_mesh_find_faults(const double* vertices, size_t vertex_count,
                                                    const uint32_t* faces, size_t face_count,
                                                    double weld_distance, meander_faults* faults,
                                                    meander_context* context, meander_error* error);

typedef uint32_t meander_curvature;
enum {
  MEANDER_CURVATURE_GAUSSIAN = 0,
  MEANDER_CURVATURE_MEAN = 1,
  MEANDER_CURVATURE_ABSOLUTE_GAUSSIAN = 2,
  MEANDER_CURVATURE_ABSOLUTE_MEAN = 3,
  MEANDER_CURVATURE_CURVEDNESS = 4
};

MEANDER_API meander_status meander_surface_compute_curvature(const meander_surface* surface,
                                                             meander_curvature curvature,
                                                             double smoothing, double* values,
                                                             size_t vertex_count,
                                                             meander_context* context,
                                                             meander_error* error);

typedef uint32_t meander_directions;
enum {
  MEANDER_DIRECTIONS_CURVATURE_MIN = 0,
  MEANDER_DIRECTIONS_CURVATURE_MAX = 1,
  MEANDER_DIRECTIONS_SMOOTH = 2,
  MEANDER_DIRECTIONS_BOUNDARY = 3
};

MEANDER_API meander_status meander_surface_compute_directions(const meander_surface* surface,
                                                              meander_directions kind,
                                                              double smoothing, double* directions,
                                                              size_t vertex_count,
                                                              meander_context* context,
                                                              meander_error* error);
MEANDER_API meander_status meander_surface_compute_stroke_directions(
    const meander_surface* surface, const double* points, size_t point_count, const uint64_t* offsets,
    size_t stroke_count, double* directions, size_t vertex_count, meander_context* context,
    meander_error* error);
MEANDER_API meander_status meander_surface_turn_directions(const meander_surface* surface, double* directions,
                                                           const double* angles, size_t vertex_count,
                                                           meander_context* context, meander_error* error);

typedef struct meander_outlines {
  uint32_t struct_size;
  uint32_t reserved32;
  size_t point_count;
  size_t strand_count;
  size_t skipped_count;
  const double* positions;
  const uint64_t* offsets;
  const uint8_t* closed;
  meander_result* result;
  uint64_t reserved[4];
} meander_outlines;

MEANDER_API meander_status meander_outlines_init(meander_outlines* outlines, size_t struct_size);
MEANDER_API meander_status meander_surface_find_outlines(const meander_surface* surface, double distance,
                                                         double spacing, meander_outlines* outlines,
                                                         meander_context* context,
                                                         meander_error* error);

typedef struct meander_seed {
  uint32_t struct_size;
  uint32_t fill_regions;
  size_t point_count;
  size_t strand_count;
  const double* points;
  const uint64_t* offsets;
  const uint8_t* closed;
  const uint8_t* fixed;
  const uint8_t* guides;
  double max_distance;
  uint64_t reserved[3];
} meander_seed;

MEANDER_API meander_status meander_seed_init(meander_seed* seed, size_t struct_size);

typedef uint32_t meander_preset;
enum {
  MEANDER_PRESET_EVEN = 0,
  MEANDER_PRESET_PAPER = 1,
  MEANDER_PRESET_FINEST = 2
};

typedef uint32_t meander_boundary_rule;
enum {
  MEANDER_BOUNDARY_RULE_CENTRE = 0,
  MEANDER_BOUNDARY_RULE_OBSTACLE = 1
};

typedef uint32_t meander_medial_axis;
enum {
  MEANDER_MEDIAL_AXIS_EUCLIDEAN = 0,
  MEANDER_MEDIAL_AXIS_GEODESIC = 1
};

typedef uint32_t meander_stop_rule;
enum {
  MEANDER_STOP_RULE_SETTLED = 0,
  MEANDER_STOP_RULE_PAPER = 1
};

typedef uint32_t meander_start;
enum {
  MEANDER_START_GROW = 0,
  MEANDER_START_FULL = 1
};

typedef struct meander_flow_options {
  uint32_t struct_size;
  meander_preset preset;
  double radius;
  double segment_length;
  double max_radius;
  double max_radius_factor;
  double length_weight;
  double bending_weight;
  double medial_weight;
  double alignment_weight;
  double length_power;
  double medial_power;
  double step;
  double start_spacing_factor;
  double boundary_distance;
  double polish_bending_weight;
  meander_boundary_rule boundary_rule;
  meander_medial_axis medial_axis;
  meander_stop_rule stop_rule;
  uint32_t grow_into_empty;
  uint32_t widen_loops;
  uint32_t hold_ends;
  uint32_t hairpin_removal_iterations;
  uint32_t polish;
  uint32_t iteration_limit;
  uint32_t threads;
  double roughness;
  meander_start start;
  uint32_t reserved32;
  double tunings[16];
  uint64_t reserved[5];
} meander_flow_options;

MEANDER_API meander_status meander_flow_options_init(meander_flow_options* options,
                                                     size_t struct_size, meander_preset preset);
MEANDER_API meander_status meander_flow_options_get_warning(const meander_flow_options* options,
                                                            size_t index, char* text, size_t capacity,
                                                            size_t* size, meander_error* error);
MEANDER_API const char* meander_tuning_name(size_t index);
MEANDER_API meander_status meander_flow_options_set_tuning(meander_flow_options* options,
                                                           const char* name, double value,
                                                           meander_error* error);
MEANDER_API meander_status meander_flow_options_get_tuning(const meander_flow_options* options,
                                                           const char* name, double* value,
                                                           meander_error* error);

typedef struct meander_extent {
  uint32_t struct_size;
  uint32_t faces;
  double length_area;
  double node_area;
  double edge_density;
  double curvature;
  uint64_t reserved[3];
} meander_extent;

MEANDER_API meander_status meander_extent_init(meander_extent* extent, size_t struct_size);
MEANDER_API meander_status meander_surface_measure_extent(const meander_surface* surface,
                                                          const double* density, size_t density_count,
                                                          meander_extent* extent,
                                                          meander_error* error);

typedef struct meander_cost {
  uint32_t struct_size;
  uint32_t reserved32;
  double nodes;
  double points;
  double length;
  double memory;
  double processor_seconds;
  uint64_t reserved[4];
} meander_cost;

MEANDER_API meander_status meander_cost_init(meander_cost* cost, size_t struct_size);
MEANDER_API meander_status meander_extent_estimate_cost(const meander_extent* extent,
                                                        const meander_flow_options* options,
                                                        meander_cost* cost, meander_error* error);

typedef struct meander_flow meander_flow;

MEANDER_API meander_status meander_flow_create(const meander_surface* surface,
                                               const meander_seed* seed, const double* density,
                                               size_t density_count,
                                               const meander_flow_options* options,
                                               meander_flow** flow, meander_context* context,
                                               meander_error* error);
MEANDER_API void meander_flow_destroy(meander_flow* flow);

typedef uint32_t meander_alignment;
enum {
  MEANDER_ALIGNMENT_ALONG = 0,
  MEANDER_ALIGNMENT_ACROSS = 1
};

MEANDER_API meander_status meander_flow_set_directions(meander_flow* flow, const double* directions,
                                                       size_t vertex_count,
                                                       meander_alignment alignment,
                                                       meander_error* error);
MEANDER_API meander_status meander_flow_step(meander_flow* flow, meander_context* context,
                                             meander_error* error);
MEANDER_API meander_status meander_flow_run(meander_flow* flow, meander_context* context,
                                            meander_error* error);

typedef uint32_t meander_stop_reason;
enum {
  MEANDER_STOP_REASON_RUNNING = 0,
  MEANDER_STOP_REASON_CONVERGED = 1,
  MEANDER_STOP_REASON_ITERATION_LIMIT = 2,
  MEANDER_STOP_REASON_STALLED = 3,
  MEANDER_STOP_REASON_CANCELLED = 4
};

MEANDER_API meander_stop_reason meander_flow_stop_reason(const meander_flow* flow);
MEANDER_API meander_status meander_flow_start(meander_flow* flow, meander_context* context,
                                              meander_error* error);
MEANDER_API uint32_t meander_flow_is_running(const meander_flow* flow);
MEANDER_API meander_status meander_flow_wait(meander_flow* flow, meander_error* error);

typedef struct meander_preview {
  uint32_t struct_size;
  uint32_t serial;
  uint32_t iterations;
  uint32_t nodes;
  double length;
  double seconds;
  uint64_t kept;
  size_t point_count;
  size_t strand_count;
  const double* positions;
  const uint64_t* offsets;
  const uint8_t* closed;
  meander_result* result;
  uint64_t reserved[4];
} meander_preview;

MEANDER_API meander_status meander_preview_init(meander_preview* preview, size_t struct_size);
MEANDER_API meander_status meander_flow_keep_growth(meander_flow* flow, double length_step,
                                                    size_t point_limit, meander_error* error);
MEANDER_API meander_status meander_flow_take_preview(meander_flow* flow, meander_preview* preview,
                                                     meander_error* error);
MEANDER_API meander_status meander_flow_set_radius(meander_flow* flow, double radius,
                                                   meander_error* error);
MEANDER_API meander_status meander_flow_set_density(meander_flow* flow, const double* density,
                                                    size_t density_count, meander_error* error);
MEANDER_API meander_status meander_flow_set_options(meander_flow* flow,
                                                    const meander_flow_options* options,
                                                    meander_error* error);
MEANDER_API meander_status meander_flow_set_vertices(meander_flow* flow, const double* vertices,
                                                     size_t vertex_count, meander_context* context,
                                                     meander_error* error);

typedef struct meander_flow_statistics {
  uint32_t struct_size;
  meander_stop_reason stop_reason;
  uint32_t iterations;
  uint32_t nodes;
  uint32_t strands;
  uint32_t closed_strands;
  uint32_t crossings;
  uint32_t polishing;
  uint32_t guides;
  uint32_t empty_components;
  double length;
  double energy;
  double mean_step;
  double spacing_target;
  double spacing_p05;
  double spacing_median;
  double spacing_p95;
  double seconds_total;
  double seconds_medial_axis;
  double seconds_solve;
  double seconds_retract;
  double seconds_reconnect;
  double seconds_crossings;
  double seconds_refine;
  double seed_distance;
  double seed_jump_length;
  uint32_t seed_point;
  uint32_t seed_jumps;
  uint32_t seed_jump_point;
  uint32_t seed_jump_point2;
  double evenness;
  uint32_t small_components;
  float roughness;
  float smoothing;
  float stretch;
  uint64_t reserved[1];
} meander_flow_statistics;

MEANDER_API meander_status meander_flow_statistics_init(meander_flow_statistics* statistics,
                                                        size_t struct_size);
MEANDER_API meander_status meander_flow_compute_statistics(meander_flow* flow,
                                                           meander_flow_statistics* statistics,
                                                           meander_context* context,
                                                           meander_error* error);

typedef struct meander_iteration {
  uint32_t iteration;
  uint32_t nodes;
  double length;
  double mean_step;
  double energy;
  double seconds;
} meander_iteration;

MEANDER_API meander_status meander_flow_get_history(const meander_flow* flow,
                                                    meander_iteration* records, size_t record_size,
                                                    size_t capacity, size_t* count,
                                                    meander_error* error);

typedef struct meander_polylines {
  uint32_t struct_size;
  uint32_t reserved32;
  size_t point_count;
  size_t strand_count;
  const double* positions;
  const uint64_t* offsets;
  const uint8_t* closed;
  const uint8_t* guides;
  meander_result* result;
  uint64_t reserved[4];
} meander_polylines;

MEANDER_API meander_status meander_polylines_init(meander_polylines* polylines, size_t struct_size);
MEANDER_API meander_status meander_flow_get_polylines(const meander_flow* flow,
                                                      meander_polylines* polylines,
                                                      meander_error* error);

typedef struct meander_nodes {
  uint32_t struct_size;
  uint32_t reserved32;
  size_t count;
  const uint32_t* faces;
  const double* barycentrics;
  const double* radii;
  const uint8_t* fixed;
  meander_result* result;
  uint64_t reserved[4];
} meander_nodes;

MEANDER_API meander_status meander_nodes_init(meander_nodes* nodes, size_t struct_size);
MEANDER_API meander_status meander_flow_get_nodes(const meander_flow* flow, meander_nodes* nodes,
                                                  meander_error* error);

typedef uint32_t meander_point_parts;
enum {
  MEANDER_POINT_PARTS_ARC_LENGTHS = 1,
  MEANDER_POINT_PARTS_NORMALS = 2,
  MEANDER_POINT_PARTS_TANGENTS = 4,
  MEANDER_POINT_PARTS_RADII = 8,
  MEANDER_POINT_PARTS_PLACES = 16,
  MEANDER_POINT_PARTS_ALL = 31
};

typedef struct meander_point_data {
  uint32_t struct_size;
  uint32_t reserved32;
  size_t count;
  const double* arc_lengths;
  const double* normals;
  const double* tangents;
  const double* radii;
  const uint32_t* faces;
  const double* barycentrics;
  meander_result* result;
  uint64_t reserved[4];
} meander_point_data;

MEANDER_API meander_status meander_point_data_init(meander_point_data* point_data, size_t struct_size);
MEANDER_API meander_status meander_flow_compute_point_data(meander_flow* flow, meander_point_parts parts,
                                                           meander_point_data* point_data,
                                                           meander_context* context,
                                                           meander_error* error);

typedef struct meander_gaps {
  uint32_t struct_size;
  uint32_t reserved32;
  size_t count;
  const double* positions;
  const double* radii;
  const double* sizes;
  const uint32_t* faces;
  meander_result* result;
  uint64_t reserved[4];
} meander_gaps;

MEANDER_API meander_status meander_gaps_init(meander_gaps* gaps, size_t struct_size);
MEANDER_API meander_status meander_flow_find_gaps(meander_flow* flow, double least_size,
                                                  meander_gaps* gaps, meander_context* context,
                                                  meander_error* error);

typedef struct meander_cut {
  uint32_t struct_size;
  uint32_t reserved32;
  size_t vertex_count;
  size_t face_count;
  size_t point_count;
  size_t strand_count;

  const double* positions;
  const double* distances;
  const uint32_t* vertex_faces;
  const double* vertex_weights;

  const uint32_t* faces;
  const uint32_t* origins;
  const uint32_t* strands;
  const uint32_t* regions;
  const int32_t* sides;
  const int32_t* nearest_sides;
  const double* along;
  const double* face_distances;
  const double* corner_weights;

  const uint32_t* line_vertices;
  const double* arc_lengths;
  const uint64_t* offsets;
  const uint32_t* line_strands;
  const uint8_t* closed;
  const double* lengths;

  meander_result* result;
  uint64_t reserved[4];
} meander_cut;

MEANDER_API meander_status meander_cut_init(meander_cut* cut, size_t struct_size);
MEANDER_API meander_status meander_flow_cut_surface(const meander_flow* flow, double detail,
                                                    uint32_t middle_lines, meander_cut* cut,
                                                    meander_context* context, meander_error* error);

#ifdef __cplusplus
}
#endif

#endif
