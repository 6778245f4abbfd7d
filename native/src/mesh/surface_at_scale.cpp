// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/surface_at_scale.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/eigen.h"
#include "mesh/constants.h"
#include "mesh/heat_flow.h"
#include "mesh/roughness.h"
#include "mesh/space_average.h"

namespace meander {
namespace {

constexpr uint32_t kVerticesPerPoll = 1u << 16;

double doubled_area(const Triangle& t, const VertexData<Vec3>& p) {
  return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm();
}

/// Takes the corners of faces that have lost their area back towards where they were, until none has.
void keep_areas(const Surface& surface, VertexData<Vec3>& positions, CancelToken poll) {
  for (int attempt = 0;; ++attempt) {
    std::vector<uint8_t> back(positions.size(), 0);
    bool any = false;
    for (uint32_t f = 0; f < surface.face_count(); ++f) {
      poll();
      if (doubled_area(surface.face(f), positions) > 0) continue;
      any = true;
      for (const uint32_t v : surface.face(f)) back[v] = 1;
    }
    if (!any) return;
    for (uint32_t v = 0; v < positions.size(); ++v) {
      if (!back[v]) continue;
      const Vec3& given = surface.position(v);
      positions[v] = attempt < kMostHalvings ? Surface::on_grid(0.5 * (positions[v] + given)) : given;
    }
  }
}

/// The root of the ratio of the areas around every vertex.
VertexData<double> shrinkage_between(const Surface& given, const Surface& smoothed, const RadiusField& radius,
                                     CancelToken poll) {
  using Sums = std::array<double, 2>;
  const auto n = static_cast<uint32_t>(given.vertex_count());
  std::vector<Sums> areas(n, Sums{0, 0});
  for (uint32_t f = 0; f < given.face_count(); ++f) {
    poll();
    for (const uint32_t v : given.face(f)) {
      areas[v][0] += given.face_area(f) / 3;
      areas[v][1] += smoothed.face_area(f) / 3;
    }
  }
  VertexData<double> shrinkage(n, 0);
  average_over_radius<2>(
      given, radius, kAreaCubes, poll, [&](uint32_t v) { return areas[v]; },
      [](const std::vector<Sums>&) { return true; },
      [&](uint32_t v, const Sums& sums, double share) {
        shrinkage[v] += share * (sums[0] > 0 ? std::sqrt(sums[1] / sums[0]) : 1);
      });
  return shrinkage;
}

double mean_over(const Surface& surface, const VertexData<double>& values) {
  double sum = 0;
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    for (const uint32_t v : surface.face(f)) sum += surface.face_area(f) / 3 * values[v];
  }
  return sum / surface.area();
}

}  // namespace

SurfaceAtScale at_scale(std::shared_ptr<const Surface> given, const RadiusField& radius, double followed,
                        ThreadPool& pool, const Tell& looks, const Tell& smooths) {
  SurfaceAtScale result{given, {}, {}};
  if (followed >= 1) return result;
  const CancelToken poll = pool.poll(kVerticesPerPoll);
  const size_t n = given->vertex_count(), faces = given->face_count();
  TellingPoll looking(poll, kVerticesPerPoll, 2 * faces + 3 * n, looks);
  const VertexData<double> rough = roughness(*given, radius, kSmoothRoughness, looking.token());
  if (rough.empty()) return result;
  VertexData<double> width(rough.size(), 0);  // in r
  for (uint32_t v = 0; v < width.size(); ++v) {
    const double above = std::max(0.0, rough[v] - kSmoothRoughness);
    width[v] = (1 - followed) * kSmoothingWidth * above / (above + kHalfwayRoughness);
  }
  result.roughness.mean = mean_over(*given, rough);
  result.roughness.smoothing = mean_over(*given, width);
  for (uint32_t v = 0; v < width.size(); ++v) width[v] *= radius.at(v);
  VertexData<Vec3> positions = smoothed_positions(*given, width, pool, part_of(smooths, 0, kPositionsSmoothed));
  for (uint32_t v = 0; v < positions.size(); ++v) {
    positions[v] = width[v] > 0 ? Surface::on_grid(positions[v]) : given->position(v);
  }
  keep_areas(*given, positions, poll);
  result.surface = std::make_shared<const Surface>(given->with_positions(std::move(positions), pool));
  result.roughness.stretch = std::sqrt(given->area() / result.surface->area());
  if (smooths) smooths(kSmoothedLaidOut);
  TellingPoll measuring(poll, kVerticesPerPoll, faces + 2 * n, part_of(smooths, kSmoothedLaidOut, 1));
  result.shrinkage = shrinkage_between(*given, *result.surface, radius, measuring.token());
  return result;
}

}  // namespace meander
