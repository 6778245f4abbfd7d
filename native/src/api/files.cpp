// SPDX-License-Identifier: GPL-3.0-or-later
//
// What mesh files of text hold, rows of numbers as text, and the triangles of polygons.
#include <algorithm>

#include "api/constants.h"
#include "api/guard.h"
#include "api/results.h"
#include "mesh/mesh_text.h"
#include "mesh/polygon_triangles.h"
#include "outputs/row_text.h"

using namespace meander;

static_assert(static_cast<meander_text>(TextKind::kObjLines) == MEANDER_TEXT_OBJ_LINES &&
              static_cast<meander_text>(TextKind::kStl) == MEANDER_TEXT_STL);

namespace {

/// An array of the caller's; one without room may be NULL.
template <class Value>
std::span<Value> room(Value* array, size_t capacity) {
  require(array != nullptr || capacity == 0, "An array that has room is NULL.");
  return {array, capacity};
}

}  // namespace

meander_status meander_text_read_polygons(const char* text, size_t size, meander_text kind, meander_polygons* polygons,
                                          meander_error* error) {
  return guard(error, [&] {
    require(text != nullptr || size == 0, "The text is NULL.");
    require(kind <= MEANDER_TEXT_STL, "There is no such kind of text.");
    require_struct(polygons);
    hand_out(polygons, read_text({text, size}, static_cast<TextKind>(kind)),
             [](const TextPolygons& found, meander_polygons& p) {
               p.point_count = found.point_count();
               p.corner_count = found.corners.size();
               p.polygon_count = found.ends.size();
               p.left_out = found.left_out;
               point_to(p.positions, found.positions);
               point_to(p.corners, found.corners);
               point_to(p.ends, found.ends);
               point_to(p.lines, found.lines);
             });
  });
}

meander_status meander_text_read_numbers(const char* text, size_t size, double* numbers, size_t capacity, size_t* count,
                                         size_t* end, meander_error* error) {
  return guard(error, [&] {
    require(text != nullptr || size == 0, "The text is NULL.");
    require(count && end, "The pointer for the count or the end is NULL.");
    *count = read_numbers({text, size}, room(numbers, capacity), *end);
  });
}

meander_status meander_text_write_rows(const char* pattern, const double* values, size_t row_count,
                                       size_t column_count, char* text, size_t capacity, size_t* size, size_t* rows,
                                       meander_error* error) {
  return guard(error, [&] {
    require(pattern != nullptr, "The pattern of a row is NULL.");
    require(size && rows, "The pointer for the size or the rows is NULL.");
    const RowPattern row(pattern);
    require(column_count > 0 && column_count == row.columns(),
            "A row must have as many columns as its pattern has numbers, and at least one.");
    require(row_count <= SIZE_MAX / column_count, "There are more numbers than memory could hold.");
    const std::span<const double> numbers(values, row_count * column_count);
    require(values != nullptr || numbers.empty(), "The values are NULL.");
    *size = row.write(numbers, room(text, capacity), *rows);
  });
}

meander_status meander_polygons_triangulate(const double* vertices, size_t vertex_count, const uint32_t* corners,
                                            size_t corner_count, const uint64_t* ends, size_t polygon_count,
                                            meander_triangles* triangles, meander_error* error) {
  return guard(error, [&] {
    require_struct(triangles);
    require(vertex_count <= kMostPolygons && polygon_count <= kMostPolygons && corner_count < UINT32_MAX,
            "There are more vertices or polygons than the library takes.");
    require((vertices || !vertex_count) && (corners || !corner_count) && (ends || !polygon_count),
            "An array of the polygons is NULL.");
    const std::span<const uint64_t> limits(ends, polygon_count);
    require(std::ranges::is_sorted(limits) && (limits.empty() ? corner_count == 0 : limits.back() == corner_count),
            "The ends of the polygons must never fall, and the last one is the number of corners.");
    hand_out(triangles, triangulate_polygons({vertices, 3 * vertex_count}, {corners, corner_count}, limits),
             [](const PolygonTriangles& found, meander_triangles& t) {
               t.count = found.polygons.size();
               point_to(t.corners, found.corners);
               point_to(t.polygons, found.polygons);
             });
  });
}
