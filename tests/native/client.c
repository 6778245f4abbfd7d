/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A client in C99, through the shared library, built twice: c99_client with meander.h, and abi3_client with
 * the declarations of abi3.txt, as a program that was compiled when this ABI was new. What it does works for
 * as long as the ABI number is 3. Also checked is what the header promises about structs of other sizes.
 * Usage: c99_client [VERSION] */
#include "meander.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures = 0;

static void expect(int condition, const char* what) {
  if (!condition) {
    fprintf(stderr, "failed: %s\n", what);
    ++failures;
  }
}

static void must(meander_status status, const meander_error* error, const char* call) {
  if (status != MEANDER_STATUS_OK) {
    fprintf(stderr, "failed: %s: %s: %s\n", call, meander_status_name(status), error->text);
    exit(EXIT_FAILURE);
  }
}

static const double kTetrahedron[] = {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
static const uint32_t kFaces[] = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
/* A loop in the first face. */
static const double kLoop[] = {0.6, 0.6, 0.2, 0.6, 0.2, -0.2, 0.2, 0.6, -0.2};
#define LAST(array) (array)[sizeof(array) / sizeof *(array) - 1]

/* What a library of tomorrow may append to a struct, seen from today. */
typedef struct longer_options {
  meander_flow_options known;
  uint64_t unknown[3];
} longer_options;
typedef struct longer_polylines {
  meander_polylines known;
  const double* unknown;
  uint64_t unknown_count;
} longer_polylines;
typedef struct longer_statistics {
  meander_flow_statistics known;
  uint64_t unknown[3];
} longer_statistics;

static void check_longer_structs(const meander_surface* surface) {
  meander_error error;
  longer_options options;
  longer_statistics statistics;
  longer_polylines curve;
  meander_flow* flow = NULL;
  must(meander_error_init(&error, sizeof error), &error, "meander_error_init");
  memset(&options, 0xff, sizeof options);
  must(meander_flow_options_init(&options.known, sizeof options, MEANDER_PRESET_EVEN), &error,
       "meander_flow_options_init");
  expect(options.known.struct_size == sizeof options, "_init keeps the caller's size");
  expect(options.unknown[0] == 0 && options.unknown[2] == 0, "_init sets the whole struct");
  options.known.radius = 0.2;

  options.unknown[2] = 1;
  expect(meander_flow_create(surface, NULL, NULL, 0, &options.known, &flow, NULL, &error) ==
             MEANDER_STATUS_INVALID_ARGUMENT,
         "what the library does not know is refused");
  expect(flow == NULL && strstr(error.text, "meander_flow_options") != NULL, "the struct is named");
  options.unknown[2] = 0;
  must(meander_flow_create(surface, NULL, NULL, 0, &options.known, &flow, NULL, &error), &error,
       "meander_flow_create");

  memset(&statistics, 0xff, sizeof statistics);
  must(meander_flow_statistics_init(&statistics.known, sizeof statistics), &error,
       "meander_flow_statistics_init");
  statistics.unknown[1] = 7;
  must(meander_flow_compute_statistics(flow, &statistics.known, NULL, &error), &error,
       "meander_flow_compute_statistics");
  expect(statistics.known.strands == 1, "what the library knows is filled");
  expect(statistics.unknown[1] == 0, "what it does not know is 0");

  must(meander_polylines_init(&curve.known, sizeof curve), &error, "meander_polylines_init");
  curve.unknown_count = 7;
  must(meander_flow_get_polylines(flow, &curve.known, &error), &error, "meander_flow_get_polylines");
  expect(curve.known.point_count > 0 && curve.unknown == NULL && curve.unknown_count == 0,
         "arrays that it does not know are NULL and empty");
  meander_result_destroy(curve.known.result);
  meander_flow_destroy(flow);
}

/* Their names may change, so the program asks for one. */
static void check_tunings(meander_flow_options* options) {
  meander_error error;
  double value = 0;
  const char* name = meander_tuning_name(0);
  must(meander_error_init(&error, sizeof error), &error, "meander_error_init");
  if (name == NULL) return;
  must(meander_flow_options_get_tuning(options, name, &value, &error), &error, "get_tuning");
  must(meander_flow_options_set_tuning(options, name, value, &error), &error, "set_tuning");
  expect(meander_flow_options_set_tuning(options, "none", 1, &error) ==
             MEANDER_STATUS_INVALID_ARGUMENT &&
             strstr(error.text, name) != NULL,
         "an unknown tuning is refused by a list of those that there are");
}

/* A reserved field is one that a later header has given a meaning. */
static void check_reserve(const meander_surface* surface) {
  meander_error error;
  meander_flow_options options;
  meander_flow* flow = NULL;
  must(meander_error_init(&error, sizeof error), &error, "meander_error_init");
  must(meander_flow_options_init(&options, sizeof options, MEANDER_PRESET_EVEN), &error,
       "meander_flow_options_init");
  options.radius = 0.2;
  check_tunings(&options);
  /* The last one: the first may have a meaning by the time that this runs. */
  LAST(options.reserved) = 1;
  expect(meander_flow_create(surface, NULL, NULL, 0, &options, &flow, NULL, &error) ==
             MEANDER_STATUS_INVALID_ARGUMENT,
         "a reserved field that is set is refused");
  expect(flow == NULL, "outputs are untouched");
}

static void check_sizes(void) {
  meander_error error;
  meander_flow_options options;
  memset(&error, 0, sizeof error);
  error.struct_size = 3;
  expect(meander_surface_create(NULL, 0, NULL, 0, NULL, NULL, NULL, &error) ==
             MEANDER_STATUS_INVALID_ARGUMENT,
         "NULL is refused");
  expect(error.text[0] == '\0', "an error that was not prepared receives nothing");
  expect(meander_error_init(NULL, sizeof error) == MEANDER_STATUS_INVALID_ARGUMENT, "NULL");
  expect(meander_error_init(&error, sizeof error - 1) == MEANDER_STATUS_INVALID_ARGUMENT &&
             error.struct_size == 3,
         "a size that no header has is refused");
  expect(meander_error_init(&error, 4097) == MEANDER_STATUS_INVALID_ARGUMENT, "so is a wild one");
  expect(meander_flow_options_init(&options, sizeof options, 99) == MEANDER_STATUS_INVALID_ARGUMENT,
         "an unknown preset is refused");
}

static meander_flow* flow_from_a_loop(const meander_surface* surface) {
  static const uint64_t offsets[] = {0, 3};
  static const uint8_t closed[] = {1};
  meander_error error;
  meander_flow_options options;
  meander_seed seed;
  meander_flow* flow = NULL;
  must(meander_error_init(&error, sizeof error), &error, "meander_error_init");
  must(meander_seed_init(&seed, sizeof seed), &error, "meander_seed_init");
  expect(seed.points == NULL && seed.strand_count == 0 && LAST(seed.reserved) == 0, "a seed begins empty");
  seed.point_count = 3;
  seed.strand_count = 1;
  seed.points = kLoop;
  seed.offsets = offsets;
  seed.closed = closed;
  must(meander_flow_options_init(&options, sizeof options, MEANDER_PRESET_PAPER), &error,
       "meander_flow_options_init");
  options.radius = 0.2;
  options.iteration_limit = 12;
  must(meander_flow_create(surface, &seed, NULL, 0, &options, &flow, NULL, &error), &error,
       "meander_flow_create");
  return flow;
}

static void check_curve(const meander_polylines* curve) {
  size_t k;
  expect(curve->point_count > 3 && curve->strand_count == 1 && curve->offsets[1] == curve->point_count,
         "offsets cover all points of the strand");
  expect(curve->closed[0] == 1 && curve->guides[0] == 0, "it stays closed, and is no guide");
  for (k = 0; k < curve->point_count; ++k) {
    const double* p = curve->positions + 3 * k;
    const double faces = fmax(fmax(p[0] + p[1] - p[2], p[0] - p[1] + p[2]),
                              fmax(-p[0] + p[1] + p[2], -p[0] - p[1] - p[2]));
    expect(fabs(faces - 1) < 1e-12, "points lie on the surface");
  }
}

static void run_a_flow(const meander_surface* surface) {
  meander_error error;
  meander_context* context = NULL;
  meander_flow* flow = flow_from_a_loop(surface);
  meander_flow_statistics statistics;
  meander_iteration* records = NULL;
  meander_polylines curve;
  size_t iterations = 0;
  double length;
  must(meander_error_init(&error, sizeof error), &error, "meander_error_init");
  must(meander_context_create(&context, &error), &error, "meander_context_create");
  must(meander_flow_statistics_init(&statistics, sizeof statistics), &error,
       "meander_flow_statistics_init");
  must(meander_flow_step(flow, NULL, &error), &error, "meander_flow_step");
  must(meander_flow_compute_statistics(flow, &statistics, NULL, &error), &error,
       "meander_flow_compute_statistics");
  expect(statistics.iterations == 1 && statistics.closed_strands == 1, "one step is one iteration");
  length = statistics.length;

  must(meander_flow_start(flow, context, &error), &error, "meander_flow_start");
  must(meander_flow_wait(flow, &error), &error, "meander_flow_wait");
  expect(meander_flow_stop_reason(flow) == MEANDER_STOP_REASON_ITERATION_LIMIT, "the limit ends it");
  expect(meander_context_progress(context) == 1, "progress ends at 1");
  must(meander_flow_compute_statistics(flow, &statistics, context, &error), &error,
       "meander_flow_compute_statistics");
  expect(statistics.iterations == 12 && statistics.crossings == 0, "figures");
  expect(statistics.length > length, "the curve grows");

  must(meander_flow_get_history(flow, NULL, sizeof *records, 0, &iterations, &error), &error,
       "meander_flow_get_history");
  expect(iterations == 12, "one record an iteration");
  records = malloc(iterations * sizeof *records);
  if (records == NULL) exit(EXIT_FAILURE);
  must(meander_flow_get_history(flow, records, sizeof *records, iterations, &iterations, &error),
       &error, "meander_flow_get_history");
  expect(records[0].iteration == 1 && records[11].iteration == 12, "records stand side by side");
  free(records);

  must(meander_polylines_init(&curve, sizeof curve), &error, "meander_polylines_init");
  expect(curve.result == NULL && curve.positions == NULL, "a struct points nowhere before the call");
  must(meander_flow_get_polylines(flow, &curve, &error), &error, "meander_flow_get_polylines");
  meander_flow_destroy(flow);
  flow = flow_from_a_loop(surface);
  must(meander_flow_run(flow, NULL, &error), &error, "meander_flow_run");
  check_curve(&curve); /* which outlives its flow */
  meander_result_destroy(curve.result);

  meander_context_cancel(context);
  expect(meander_flow_compute_statistics(flow, &statistics, context, &error) ==
             MEANDER_STATUS_CANCELLED,
         "a cancelled context ends a computation");
  expect(strcmp(meander_status_name(error.status), "cancelled") == 0, "the error says so");
  meander_flow_destroy(flow);
  meander_context_destroy(context);
}

/* An error has a status, an element and a sentence. */
static void check_error(void) {
  const uint32_t faces[] = {0, 1, 2, 0, 3, 4};
  meander_error error;
  meander_surface* surface = NULL;
  must(meander_error_init(&error, sizeof error), &error, "meander_error_init");
  expect(meander_surface_create(kTetrahedron, 4, faces, 2, NULL, &surface, NULL, &error) ==
             MEANDER_STATUS_INVALID_MESH &&
             surface == NULL,
         "a wrong index is refused");
  expect(error.element_kind == MEANDER_ELEMENT_FACE && error.element_index == 1,
         "the face with the wrong index is named");
  expect(error.text[0] != '\0', "the error has a sentence");
}

static void check_version(const char* project) {
  char version[32];
  snprintf(version, sizeof version, "%d.%d.%d", MEANDER_VERSION_MAJOR, MEANDER_VERSION_MINOR,
           MEANDER_VERSION_PATCH);
  expect(strcmp(meander_version(), version) == 0, "the library has the header's version");
  expect(strcmp(version, project) == 0, "the header has the project's version");
}

int main(int argc, char** argv) {
  meander_error error;
  meander_surface_options options;
  meander_surface_statistics statistics;
  meander_surface* surface = NULL;
  if (meander_abi_version() != MEANDER_ABI_VERSION) {
    fprintf(stderr, "the library has another ABI: freeze its header beside this one\n");
    return EXIT_FAILURE;
  }
  if (argc > 1) check_version(argv[1]);
  must(meander_error_init(&error, sizeof error), &error, "meander_error_init");
  must(meander_surface_options_init(&options, sizeof options), &error,
       "meander_surface_options_init");
  options.split_bow_ties = 1;
  must(meander_surface_create(kTetrahedron, 4, kFaces, 4, &options, &surface, NULL, &error), &error,
       "meander_surface_create");
  must(meander_surface_statistics_init(&statistics, sizeof statistics), &error,
       "meander_surface_statistics_init");
  must(meander_surface_get_statistics(surface, &statistics, &error), &error,
       "meander_surface_get_statistics");
  expect(statistics.faces == 4 && statistics.flipped_faces == 0 && statistics.area > 0, "a surface");
  run_a_flow(surface);
  check_longer_structs(surface);
  check_reserve(surface);
  check_sizes();
  check_error();
  meander_surface_destroy(surface);
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
