/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The header from C99, through the shared library, as a client would use it: a mesh, one step,
 * one run, the polylines, and an error that names its element. Usage: c99_step VERSION */
#include <meander/meander.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CELLS 12 /* the mesh is a square of CELLS x CELLS cells, two triangles each */

enum { VERTICES = (CELLS + 1) * (CELLS + 1), FACES = 2 * CELLS * CELLS };

static int failures = 0;

static void expect(int condition, const char* what) {
  if (!condition) {
    fprintf(stderr, "failed: %s\n", what);
    ++failures;
  }
}

static void expect_ok(meander_status status, const meander_error* error, const char* call) {
  if (status != MEANDER_STATUS_OK) {
    fprintf(stderr, "failed: %s: %s: %s\n", call, meander_status_name(status), error->text);
    exit(EXIT_FAILURE);
  }
}

static void fill_square(double* vertices, uint32_t* faces) {
  for (uint32_t row = 0; row <= CELLS; ++row) {
    for (uint32_t column = 0; column <= CELLS; ++column) {
      *vertices++ = (double)column / CELLS;
      *vertices++ = (double)row / CELLS;
      *vertices++ = 0.0;
    }
  }
  for (uint32_t row = 0; row < CELLS; ++row) {
    for (uint32_t column = 0; column < CELLS; ++column) {
      const uint32_t corner = row * (CELLS + 1) + column;
      const uint32_t above = corner + CELLS + 1;
      *faces++ = corner;
      *faces++ = corner + 1;
      *faces++ = above + 1;
      *faces++ = corner;
      *faces++ = above + 1;
      *faces++ = above;
    }
  }
}

static void check_version(const char* project) {
  char version[32];
  snprintf(version, sizeof version, "%d.%d.%d", MEANDER_VERSION_MAJOR, MEANDER_VERSION_MINOR,
           MEANDER_VERSION_PATCH);
  expect(meander_abi_version() == MEANDER_ABI_VERSION, "the library and the header agree");
  expect(strcmp(meander_version(), version) == 0, "the library has the header's version");
  if (project != NULL) {
    expect(strcmp(version, project) == 0, "the header has the project's version");
  }
}

/* A flow on the square, from a smaller one in its middle. */
static meander_flow* make_flow(const double* vertices, const uint32_t* faces) {
  meander_error error;
  meander_error_init(&error, sizeof error);
  const double points[] = {0.35, 0.35, 0.0, 0.65, 0.35, 0.0, 0.65, 0.65, 0.0, 0.35, 0.65, 0.0};
  const uint64_t offsets[] = {0, 4};
  const uint8_t closed[] = {1};
  meander_seed seed;
  expect_ok(meander_seed_init(&seed, sizeof seed), &error, "meander_seed_init");
  seed.point_count = 4;
  seed.strand_count = 1;
  seed.points = points;
  seed.offsets = offsets;
  seed.closed = closed;

  meander_surface* surface = NULL;
  expect_ok(meander_surface_create(vertices, VERTICES, faces, FACES, NULL, &surface, NULL, &error), &error,
            "meander_surface_create");
  meander_flow_options options;
  expect_ok(meander_flow_options_init(&options, sizeof options, MEANDER_PRESET_EVEN), &error,
            "meander_flow_options_init");
  options.radius = 0.05;
  options.iteration_limit = 20;

  meander_flow* flow = NULL;
  expect_ok(meander_flow_create(surface, &seed, NULL, 0, &options, &flow, NULL, &error), &error,
            "meander_flow_create");
  meander_surface_destroy(surface); /* the flow keeps what it needs */
  return flow;
}

static void check_step_and_run(meander_flow* flow) {
  meander_error error;
  meander_error_init(&error, sizeof error);
  expect_ok(meander_flow_step(flow, NULL, &error), &error, "meander_flow_step");

  meander_flow_statistics statistics;
  expect_ok(meander_flow_statistics_init(&statistics, sizeof statistics), &error,
            "meander_flow_statistics_init");
  expect_ok(meander_flow_compute_statistics(flow, &statistics, NULL, &error), &error,
            "meander_flow_compute_statistics");
  expect(statistics.iterations == 1, "one step is one iteration");
  expect(statistics.crossings == 0, "no crossings after a step");
  expect(statistics.strands == 1 && statistics.closed_strands == 1, "the strand stays closed");
  const double length_after_a_step = statistics.length;

  meander_context* context = NULL;
  expect_ok(meander_context_create(&context, &error), &error, "meander_context_create");
  expect_ok(meander_flow_run(flow, context, &error), &error, "meander_flow_run");
  expect(meander_context_progress(context) == 1.0, "progress ends at 1");
  expect_ok(meander_flow_compute_statistics(flow, &statistics, NULL, &error), &error,
            "meander_flow_compute_statistics");
  expect(statistics.crossings == 0, "no crossings after a run");
  expect(statistics.length > length_after_a_step, "the curve grows");
  meander_context_destroy(context);
}

/* A result, whose arrays are the library's until it is destroyed. */
static void check_polylines(meander_flow* flow) {
  meander_error error;
  meander_error_init(&error, sizeof error);
  meander_polylines curve;
  expect_ok(meander_polylines_init(&curve, sizeof curve), &error, "meander_polylines_init");
  expect(curve.result == NULL && curve.positions == NULL, "a struct points nowhere before the call");
  expect_ok(meander_flow_get_polylines(flow, &curve, &error), &error, "meander_flow_get_polylines");
  expect(curve.point_count > 4 && curve.strand_count == 1, "the struct tells the sizes");
  expect(curve.offsets[0] == 0 && curve.offsets[1] == curve.point_count && curve.closed[0] == 1,
         "offsets cover all points of the closed strand");
  expect(curve.guides[0] == 0, "the strand is no guide");
  for (size_t i = 0; i < curve.point_count; ++i) {
    /* The square lies in z = 0 and its vertices are exact there. */
    expect(fabs(curve.positions[3 * i + 2]) < 1e-12, "points lie on the surface");
  }
  meander_result_destroy(curve.result);
}

/* An error has a status, an element and a sentence. */
static void check_error(const double* vertices, uint32_t* faces) {
  meander_error error;
  meander_error_init(&error, sizeof error);
  faces[5] = VERTICES;
  meander_surface* surface = NULL;
  const meander_status status =
      meander_surface_create(vertices, VERTICES, faces, FACES, NULL, &surface, NULL, &error);
  expect(status == MEANDER_STATUS_INVALID_MESH && surface == NULL, "a wrong index is refused");
  expect(error.element_kind == MEANDER_ELEMENT_FACE && error.element_index == 1,
         "the face with the wrong index is named");
  expect(error.text[0] != '\0', "the error has a sentence");
}

int main(int argc, char** argv) {
  static double vertices[3 * VERTICES];
  static uint32_t faces[3 * FACES];
  check_version(argc > 1 ? argv[1] : NULL);
  fill_square(vertices, faces);
  meander_flow* flow = make_flow(vertices, faces);
  check_step_and_run(flow);
  check_polylines(flow);
  meander_flow_destroy(flow);
  check_error(vertices, faces);
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
