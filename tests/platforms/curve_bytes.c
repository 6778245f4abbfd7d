/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * curve_bytes [CASE]...
 *
 * Fills small surfaces and prints a line for each: the case, the points, the iterations, and a digest
 * of every byte of the polylines. Libraries of all platforms have to print the same. The meshes are
 * computed by operations that IEEE 754 fixes: no sine, no random numbers of a C library. */
/* clang computes constants fused unless told not to. */
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif

#include <meander/meander.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  const char* name;
  int shape; /* 0: torus, 1: rough sheet */
  int preset;
  double radius, length_power, medial_power;
  int medial_axis; /* -1: the preset's */
  int density;     /* 1: it rises along x, which makes r vary */
  uint32_t iterations; /* 0: to the end */
} Case;

static const Case kCases[] = {
    {"paper_torus", 0, MEANDER_PRESET_PAPER, 0.087, 2, 2, -1, 0, 0},
    {"even_torus", 0, MEANDER_PRESET_EVEN, 0.11, 2, 2, -1, 0, 0},
    {"even_sheet", 1, MEANDER_PRESET_EVEN, 0.03, 2, 2, -1, 0, 0},
    {"even_density", 1, MEANDER_PRESET_EVEN, 0.04, 2, 2, -1, 1, 0},
    {"even_powers", 0, MEANDER_PRESET_EVEN, 0.13, 3.5, 4.5, -1, 0, 80},
    {"paper_sheet", 1, MEANDER_PRESET_PAPER, 0.035, 2, 2, -1, 0, 0},
    {"finest_sheet", 1, MEANDER_PRESET_FINEST, 0.045, 2, 2, -1, 0, 100},
    {"straight_sheet", 1, MEANDER_PRESET_EVEN, 0.045, 2, 2, MEANDER_MEDIAL_AXIS_EUCLIDEAN, 0, 60},
};

enum { AROUND = 40, ACROSS = 20, CELLS = 16 };

static void check(meander_status status, const meander_error* error, const char* what) {
  if (status == MEANDER_STATUS_OK) return;
  fprintf(stderr, "%s: %s: %s\n", what, meander_status_name(status), error->text);
  exit(EXIT_FAILURE);
}

/* The point k of n on the unit circle: four quarters of a rational parametrization. */
static void on_circle(int k, int n, double* x, double* y) {
  const int quarter = n / 4, turn = k / quarter;
  const double t = (double)(k % quarter) / quarter;
  const double c = (1 - t * t) / (1 + t * t), s = 2 * t / (1 + t * t);
  *x = turn == 0 ? c : turn == 1 ? -s : turn == 2 ? -c : s;
  *y = turn == 0 ? s : turn == 1 ? c : turn == 2 ? -s : -c;
}

static void add_quad(uint32_t* faces, size_t* count, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  const uint32_t corners[] = {a, b, c, a, c, d};
  memcpy(faces + 3 * *count, corners, sizeof corners);
  *count += 2;
}

static void make_torus(double* vertices, size_t* vertex_count, uint32_t* faces, size_t* face_count) {
  for (int i = 0; i < AROUND; ++i) {
    for (int j = 0; j < ACROSS; ++j) {
      double x, y, u, v;
      on_circle(i, AROUND, &x, &y);
      on_circle(j, ACROSS, &u, &v);
      double* p = vertices + 3 * (*vertex_count)++;
      p[0] = (1 + 0.4 * u) * x;
      p[1] = (1 + 0.4 * u) * y;
      p[2] = 0.4 * v;
      const uint32_t i1 = (uint32_t)((i + 1) % AROUND), j1 = (uint32_t)((j + 1) % ACROSS);
      add_quad(faces, face_count, (uint32_t)(i * ACROSS + j), i1 * ACROSS + (uint32_t)j, i1 * ACROSS + j1,
               (uint32_t)(i * ACROSS) + j1);
    }
  }
}

static void make_sheet(double* vertices, size_t* vertex_count, uint32_t* faces, size_t* face_count) {
  uint32_t state = 12345;
  for (int j = 0; j <= CELLS; ++j) {
    for (int i = 0; i <= CELLS; ++i) {
      double* p = vertices + 3 * (*vertex_count)++;
      const int inner = i > 0 && j > 0 && i < CELLS && j < CELLS;
      for (int a = 0; a < 3; ++a) {
        state = state * 1664525u + 1013904223u;
        const double shift = inner ? ((double)(state >> 8) / 16777216 - 0.5) * 0.6 / CELLS : 0;
        p[a] = (a == 0 ? (double)i / CELLS : a == 1 ? (double)j / CELLS : 0) + shift;
      }
    }
  }
  for (uint32_t j = 0; j < CELLS; ++j) {
    for (uint32_t i = 0; i < CELLS; ++i) {
      const uint32_t at = j * (CELLS + 1) + i;
      add_quad(faces, face_count, at, at + 1, at + CELLS + 2, at + CELLS + 1);
    }
  }
}

static uint64_t digest(uint64_t hash, const void* data, size_t bytes) {
  const unsigned char* p = data;
  for (size_t k = 0; k < bytes; ++k) hash = (hash ^ p[k]) * 1099511628211u; /* FNV-1a */
  return hash;
}

static void run(const Case* c) {
  static double vertices[3 * AROUND * ACROSS], density[AROUND * ACROSS];
  static uint32_t faces[6 * AROUND * ACROSS];
  size_t vertex_count = 0, face_count = 0;
  meander_polylines curve;
  meander_surface* surface = NULL;
  meander_flow* flow = NULL;
  meander_error error;
  meander_flow_options options;
  meander_flow_statistics statistics;

  if (c->shape == 0) make_torus(vertices, &vertex_count, faces, &face_count);
  if (c->shape == 1) make_sheet(vertices, &vertex_count, faces, &face_count);
  for (size_t v = 0; v < vertex_count; ++v) density[v] = 1 + 2 * vertices[3 * v];
  meander_error_init(&error, sizeof error);
  meander_flow_statistics_init(&statistics, sizeof statistics);
  check(meander_flow_options_init(&options, sizeof options, c->preset), &error, "options");
  options.radius = c->radius;
  options.length_power = c->length_power;
  options.medial_power = c->medial_power;
  if (c->medial_axis >= 0) options.medial_axis = c->medial_axis;
  if (c->iterations > 0) options.iteration_limit = c->iterations;
  check(meander_surface_create(vertices, vertex_count, faces, face_count, NULL, &surface, NULL, &error), &error,
        "surface");
  check(meander_flow_create(surface, NULL, c->density ? density : NULL, c->density ? vertex_count : 0, &options,
                            &flow, NULL, &error), &error, "flow");
  check(meander_flow_run(flow, NULL, &error), &error, "run");
  check(meander_flow_compute_statistics(flow, &statistics, NULL, &error), &error, "statistics");
  check(meander_polylines_init(&curve, sizeof curve), &error, "struct");
  check(meander_flow_get_polylines(flow, &curve, &error), &error, "polylines");
  uint64_t hash = 14695981039346656037u;
  hash = digest(hash, curve.positions, 3 * curve.point_count * sizeof *curve.positions);
  hash = digest(hash, curve.offsets, (curve.strand_count + 1) * sizeof *curve.offsets);
  hash = digest(hash, curve.closed, curve.strand_count);
  printf("%s %u %u %08x%08x\n", c->name, (unsigned)curve.point_count, (unsigned)statistics.iterations,
         (unsigned)(hash >> 32), (unsigned)hash);
  fflush(stdout);
  meander_result_destroy(curve.result);
  meander_flow_destroy(flow);
  meander_surface_destroy(surface);
}

int main(int count, char** names) {
  for (size_t k = 0; k < sizeof kCases / sizeof *kCases; ++k) {
    int wanted = count < 2;
    for (int i = 1; i < count; ++i) wanted |= strcmp(names[i], kCases[k].name) == 0;
    if (wanted) run(&kCases[k]);
  }
  return EXIT_SUCCESS;
}
