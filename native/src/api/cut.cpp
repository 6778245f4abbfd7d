// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces cut along the curve.
#include <algorithm>
#include <cmath>

#include "api/guard.h"

using namespace meander;

namespace {

/// Copies values, or lists of a fixed number of them, where an array was given.
template <class Value, class Number>
void copy(const std::vector<Value>& values, Number* to) {
  static_assert(sizeof(Value) % sizeof(Number) == 0);
  if (!to) return;
  std::copy_n(reinterpret_cast<const Number*>(values.data()), values.size() * (sizeof(Value) / sizeof(Number)), to);
}

}  // namespace

meander_status meander_flow_cut_surface(const meander_flow* flow, double detail, uint32_t middle_lines,
                                        meander_cut** cut, meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require_idle(flow);
    require(cut != nullptr, "The pointer for the cut is NULL.");
    if (!(std::isfinite(detail) && detail >= 0)) {
      refuse("The detail of a cut must be 0 or a length; it is " + number(detail) + ".");
    }
    require_flag(middle_lines, "middle_lines");
    check_cancelled(context);
    const Flow& f = *flow->flow;
    auto made = std::make_unique<meander_cut>();
    made->surface = cut_surface(f.surface(), flow->map.get(), f.curve(), detail, middle_lines != 0,
                                question(context));
    check_cancelled(context);
    *cut = made.release();
  });
}

void meander_cut_destroy(meander_cut* cut) { delete cut; }

meander_status meander_cut_get_vertices(const meander_cut* cut, double* positions, double* distances, uint32_t* faces,
                                        double* barycentrics, size_t capacity, size_t* count, meander_error* error) {
  return guard(error, [&] {
    require(cut != nullptr, "The cut is NULL.");
    require(count != nullptr, "The pointer for the count is NULL.");
    const CutSurface& s = cut->surface;
    *count = s.positions.size();
    if (*count > capacity) return;
    copy(s.positions, positions);
    copy(s.distances, distances);
    copy(s.vertex_faces, faces);
    copy(s.vertex_weights, barycentrics);
  });
}

meander_status meander_cut_get_faces(const meander_cut* cut, uint32_t* vertices, uint32_t* origins, uint32_t* strands,
                                     uint32_t* regions, int32_t* sides, int32_t* nearest_sides, double* along,
                                     double* distances, double* barycentrics, size_t capacity, size_t* count,
                                     meander_error* error) {
  return guard(error, [&] {
    require(cut != nullptr, "The cut is NULL.");
    require(count != nullptr, "The pointer for the count is NULL.");
    const CutSurface& s = cut->surface;
    *count = s.faces.size();
    if (*count > capacity) return;
    copy(s.faces, vertices);
    copy(s.origins, origins);
    copy(s.strands, strands);
    copy(s.regions, regions);
    copy(s.sides, sides);
    copy(s.nearest_sides, nearest_sides);
    copy(s.along, along);
    copy(s.face_distances, distances);
    copy(s.corner_weights, barycentrics);
  });
}

meander_status meander_cut_get_line(const meander_cut* cut, uint32_t* vertices, double* arc_lengths,
                                    size_t point_capacity, size_t* point_count, uint64_t* offsets, uint32_t* strands,
                                    uint8_t* closed, double* lengths, size_t strand_capacity, size_t* strand_count,
                                    meander_error* error) {
  return guard(error, [&] {
    require(cut != nullptr, "The cut is NULL.");
    require(point_count != nullptr && strand_count != nullptr, "A pointer for a count is NULL.");
    const CutSurface& s = cut->surface;
    *point_count = s.line_vertices.size();
    *strand_count = s.closed.size();
    if (*point_count > point_capacity || *strand_count > strand_capacity) return;
    copy(s.line_vertices, vertices);
    copy(s.arc_lengths, arc_lengths);
    copy(s.offsets, offsets);
    copy(s.line_strands, strands);
    copy(s.closed, closed);
    copy(s.lengths, lengths);
  });
}
