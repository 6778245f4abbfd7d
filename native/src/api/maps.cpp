// SPDX-License-Identifier: GPL-3.0-or-later
//
// Images of a surface that is cut along the curve.
#include <algorithm>
#include <cmath>

#include "api/constants.h"
#include "api/guard.h"
#include "api/structs.h"
#include "base/thread_pool.h"
#include "outputs/map_distances.h"
#include "outputs/map_pixels.h"

using namespace meander;

namespace {

template <class Value>
std::span<const Value> array_of(const Value* values, size_t count) {
  require(values != nullptr || count == 0, "An array of the cut is NULL.");
  return {values, count};
}

MapOfCut checked_cut(const meander_cut& c) {
  MapOfCut cut;
  cut.positions = array_of(c.positions, 3 * c.vertex_count);
  cut.distances = array_of(c.distances, c.vertex_count);
  cut.faces = array_of(c.faces, 3 * c.face_count);
  cut.strands = array_of(c.strands, c.face_count);
  cut.along = array_of(c.along, 3 * c.face_count);
  cut.face_distances = array_of(c.face_distances, 3 * c.face_count);
  cut.line_vertices = array_of(c.line_vertices, c.point_count);
  cut.arc_lengths = array_of(c.arc_lengths, c.point_count);
  cut.offsets = array_of(c.offsets, c.strand_count + 1);
  cut.line_strands = array_of(c.line_strands, c.strand_count);
  cut.closed = array_of(c.closed, c.strand_count);
  cut.lengths = array_of(c.lengths, c.strand_count);
  const auto is_vertex = [&](uint32_t v) { return v < c.vertex_count; };
  require(std::ranges::all_of(cut.faces, is_vertex) && std::ranges::all_of(cut.line_vertices, is_vertex),
          "A face or the line of the cut has a vertex that is not there.");
  require(std::ranges::is_sorted(cut.offsets) && cut.offsets.back() <= c.point_count,
          "The offsets of the cut must never fall, nor be more than its points.");
  require(std::ranges::all_of(cut.line_strands, [](uint32_t s) { return s < (1u << 30); }),
          "A strand of the cut has a number of more than 2^30.");
  return cut;
}

}  // namespace

meander_status meander_map_find_pixels(const double* drawing, size_t face_count, uint32_t side, uint32_t margin,
                                       uint32_t threads, int32_t* nearest, float* weights, size_t* covered,
                                       size_t* twice, meander_context* context, meander_error* error) {
  return guard(error, [&] {
    require(face_count <= size_t{1} << 30, "There are more than 2^30 faces.");
    require(side >= 1 && side <= kLargestImage, "The side of an image must be from 1 to 32768 pixels.");
    require((drawing || face_count == 0) && nearest && weights, "An array of the drawing or of its pixels is NULL.");
    require(covered && twice, "A pointer for the number of pixels is NULL.");
    require_threads(threads);
    check_cancelled(context);
    ThreadPool pool = ThreadPool(threads).with(cancel_of(context));
    const size_t pixels = size_t{side} * side;
    const PixelCounts counts =
        find_pixels({drawing, 6 * face_count}, margin, {side, {nearest, pixels}, {weights, 3 * pixels}}, pool);
    check_cancelled(context);
    *covered = counts.covered;
    *twice = counts.twice;
  });
}

meander_status meander_cut_find_places(const meander_cut* cut, double distance, const int32_t* nearest,
                                       const float* weights, size_t point_count, uint32_t threads, double* distances,
                                       double* away, uint32_t* strands, double* along, meander_context* context,
                                       meander_error* error) {
  return guard(error, [&] {
    require_struct(cut);
    require(point_count <= size_t{1} << 30, "There are more than 2^30 places; ask for some of them at a time.");
    require((nearest && weights) || point_count == 0, "An array of the places is NULL.");
    require(std::isfinite(distance) && distance > 0, "The farthest distance must be a positive number.");
    require_threads(threads);
    MapOfCut known = checked_cut(read_struct(cut));
    known.farthest = distance;
    const auto face_count = static_cast<int64_t>(known.strands.size());
    require(std::all_of(nearest, nearest + point_count, [&](int32_t f) { return f >= -1 && f < face_count; }),
            "A place lies in a face that is not there.");
    require(std::all_of(weights, weights + 3 * point_count, [](float w) { return std::isfinite(w); }),
            "A weight of a place is not finite.");
    check_cancelled(context);
    ThreadPool pool = ThreadPool(threads).with(cancel_of(context));
    const PlacesOfMap found{{distances, distances ? point_count : 0},
                            {away, away ? 3 * point_count : 0},
                            {strands, strands ? point_count : 0},
                            {along, along ? point_count : 0}};
    measure_places(known, {nearest, point_count}, {weights, 3 * point_count}, found, pool);
    check_cancelled(context);
  });
}

meander_status meander_cut_measure_distances(const meander_cut* cut, double distance, const int32_t* nearest,
                                             const float* weights, size_t point_count, uint32_t threads,
                                             double* distances, double* away, meander_context* context,
                                             meander_error* error) {
  if (!distances && point_count > 0) {
    return guard(error, [] { refuse("An array of the places is NULL."); });
  }
  return meander_cut_find_places(cut, distance, nearest, weights, point_count, threads, distances, away, nullptr,
                                 nullptr, context, error);
}
