// SPDX-License-Identifier: GPL-3.0-or-later
//
// What mesh files of text hold, and the triangles of polygons.
#include <algorithm>

#include "api/guard.h"
#include "mesh/mesh_text.h"
#include "mesh/polygon_triangles.h"

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

meander_status meander_text_read_polygons(const char* text, size_t size, meander_text kind, double* positions,
                                          size_t position_capacity, size_t* position_count, uint32_t* corners,
                                          size_t corner_capacity, size_t* corner_count, uint64_t* ends, uint32_t* lines,
                                          size_t polygon_capacity, size_t* polygon_count, size_t* left_out,
                                          meander_error* error) {
  return guard(error, [&] {
    require(text != nullptr || size == 0, "The text is NULL.");
    require(kind <= MEANDER_TEXT_STL, "There is no such kind of text.");
    require(position_count && corner_count && polygon_count && left_out, "A pointer for a count is NULL.");
    require(position_capacity <= SIZE_MAX / 3, "There is no room for so many points.");
    TextPolygons found;
    found.positions = room(positions, 3 * position_capacity);
    found.corners = room(corners, corner_capacity);
    found.ends = room(ends, polygon_capacity);
    if (lines) found.lines = {lines, polygon_capacity};
    read_text({text, size}, static_cast<TextKind>(kind), found);
    *position_count = found.position_count;
    *corner_count = found.corner_count;
    *polygon_count = found.polygon_count;
    *left_out = found.left_out;
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

meander_status meander_polygons_triangulate(const double* vertices, size_t vertex_count, const uint32_t* corners,
                                            size_t corner_count, const uint64_t* ends, size_t polygon_count,
                                            uint32_t* triangles, uint32_t* polygons, size_t capacity, size_t* count,
                                            meander_error* error) {
  return guard(error, [&] {
    constexpr size_t kMost = size_t{1} << 30;
    require(count != nullptr, "The pointer for the count is NULL.");
    require(vertex_count <= kMost && polygon_count <= kMost && corner_count < UINT32_MAX,
            "There are more vertices or polygons than the library takes.");
    require((vertices || !vertex_count) && (corners || !corner_count) && (ends || !polygon_count),
            "An array of the polygons is NULL.");
    const std::span<const uint64_t> limits(ends, polygon_count);
    require(std::ranges::is_sorted(limits) && (limits.empty() ? corner_count == 0 : limits.back() == corner_count),
            "The ends of the polygons must never fall, and the last one is the number of corners.");
    const PolygonTriangles found =
        triangulate_polygons({vertices, 3 * vertex_count}, {corners, corner_count}, limits);
    const size_t made = found.polygons.size();
    if (made <= capacity) require(triangles != nullptr || made == 0, "The array for the triangles is NULL.");
    *count = made;
    if (made > capacity) return;
    std::ranges::copy(found.corners, triangles);
    if (polygons) std::ranges::copy(found.polygons, polygons);
  });
}
