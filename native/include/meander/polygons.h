/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Meshes as text and as polygons, before they are surfaces. Part of meander.h. */
#ifndef MEANDER_POLYGONS_H
#define MEANDER_POLYGONS_H

#include "library.h"

#ifdef __cplusplus
extern "C" {
#endif

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

#ifdef __cplusplus
}
#endif

#endif /* MEANDER_POLYGONS_H */
