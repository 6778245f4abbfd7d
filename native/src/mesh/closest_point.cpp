// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/failure.h"
#include "mesh/constants.h"

namespace meander {
namespace {

using Corners = TriangleTree::Corners;

/// Pieces of work of some nanoseconds between two asks.
constexpr uint32_t kWorkPerPoll = 1u << 14;
/// Points that a thread takes at a time.
constexpr size_t kPointGrain = 256;

std::vector<Corners> triangles_of(const Surface& surface) {
  std::vector<Corners> triangles(surface.face_count());
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    for (size_t k = 0; k < 3; ++k) triangles[f][k] = surface.position(surface.face(f)[k]);
  }
  return triangles;
}

/// A place and a unit in which triangles anywhere, of any size, are about as large as 1 and around the origin. The unit
/// is a power of two, so that nothing is rounded by it.
class Frame {
 public:
  explicit Frame(const std::vector<Corners>& triangles) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Corners& corners : triangles) {
      for (const Vec3& p : corners) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    }
    middle_ = 0.5 * low + 0.5 * high;
    const double reach = (0.5 * high - 0.5 * low).maxCoeff();
    std::frexp(reach > 0 ? reach : middle_.cwiseAbs().maxCoeff(), &exponent_);
  }

  Vec3 to_inside(const Vec3& p) const {
    return (p - middle_).unaryExpr([this](double x) { return std::ldexp(x, -exponent_); });
  }
  double length(double inside) const { return std::ldexp(inside, exponent_); }

 private:
  Vec3 middle_;
  int exponent_ = 0;
};

/// `triangles` in the units of the points; `number` what each is called.
ClosestPlaces places_on(std::vector<Corners> triangles, const std::vector<uint32_t>& number,
                        std::span<const double> points, ThreadPool& pool) {
  const Frame frame(triangles);
  for (Corners& corners : triangles) {
    for (Vec3& p : corners) p = frame.to_inside(p);
  }
  const TriangleTree tree(triangles, kThinInMesh, pool.poll(kWorkPerPoll));
  const size_t count = points.size() / 3;
  ClosestPlaces places{std::vector<uint32_t>(count), std::vector<std::array<double, 3>>(count),
                       std::vector<double>(count)};
  pool.for_blocks(count, kPointGrain, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const Vec3 q(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
      const TriangleTree::Nearest place = tree.nearest(frame.to_inside(q));
      places.faces[i] = number[place.triangle];
      places.weights[i] = place.weights;
      places.distances[i] = frame.length(place.distance);
    }
  });
  return places;
}

}  // namespace

ClosestPoint::ClosestPoint(const Surface& surface, const CancelToken& poll)
    : tree_(triangles_of(surface), kThinOnSurface, poll) {}

ClosestPoint::Result ClosestPoint::operator()(const Vec3& q) const {
  const TriangleTree::Nearest place = tree_.nearest(q);
  return {make_point(place.triangle, place.weights[0], place.weights[1], place.weights[2]), place.distance};
}

ClosestPlaces closest_places(std::span<const double> vertices, std::span<const uint32_t> faces,
                             std::span<const double> points, ThreadPool& pool) {
  check_indices(vertices.size() / 3, faces);
  CancelToken poll = pool.poll(kWorkPerPoll);
  std::vector<Corners> triangles;
  std::vector<uint32_t> number;
  for (size_t f = 0; f < faces.size() / 3; ++f) {
    Corners corners;
    for (size_t k = 0; k < 3; ++k) {
      const double* p = &vertices[3 * size_t{faces[3 * f + k]}];
      corners[k] = Vec3(p[0], p[1], p[2]);
    }
    poll();
    if (!std::ranges::all_of(corners, [](const Vec3& p) { return p.allFinite(); })) continue;
    triangles.push_back(corners);
    number.push_back(static_cast<uint32_t>(f));
  }
  if (triangles.empty()) {
    throw Failure(FailureKind::kInvalidMesh,
                  "Every face has a vertex with a coordinate that is not a finite number; repair the mesh.");
  }
  return places_on(std::move(triangles), number, points, pool);
}

ClosestPlaces closest_places(const Surface& surface, std::span<const double> points, ThreadPool& pool) {
  std::vector<Corners> triangles(surface.face_count());
  std::vector<uint32_t> number(surface.face_count());
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    for (size_t k = 0; k < 3; ++k) triangles[f][k] = surface.caller_position(surface.face(f)[k]);
    number[f] = f;
  }
  return places_on(std::move(triangles), number, points, pool);
}

}  // namespace meander
