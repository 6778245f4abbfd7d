// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/domain.h"

#include <utility>

#include "base/tuning.h"

namespace meander {
namespace {

std::unique_ptr<const BoundaryObstacle> sampled_boundary(const Surface& surface, const FlowSettings& settings) {
  return std::make_unique<const BoundaryObstacle>(surface, tuning::kBoundarySampling * settings.segment_length);
}

double filling_length(const Surface& surface, const RadiusField& radius) {
  if (!radius.varies()) return surface.area() / (2 * radius.at(0));
  double length = 0;
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    double per_area = 0;  // 1 / (2 r), the mean of the corners
    for (const uint32_t v : surface.face(f)) per_area += 1 / (6 * radius.at(v));
    length += surface.face_area(f) * per_area;
  }
  return length;
}

}  // namespace

double expected_nodes(const Surface& surface, const FlowSettings& settings,
                      const std::function<double(uint32_t)>& density_at) {
  constexpr double kMeanSegment = 1.4;  // in h
  double weighted_area = 0;
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    const Triangle& t = surface.face(f);
    weighted_area += surface.face_area(f) * (density_at(t[0]) + density_at(t[1]) + density_at(t[2])) / 3;
  }
  return weighted_area / (2 * settings.radius * kMeanSegment * settings.segment_length);
}

Domain::Domain(std::shared_ptr<const Surface> where, const VertexData<double>& density, const FlowSettings& settings,
               ThreadPool& pool)
    : surface(std::move(where)),
      wanted_radius(settings.radius, density),
      radius(wanted_radius),
      expected_length(filling_length(*surface, wanted_radius)),
      boundary(sampled_boundary(*surface, settings)),
      patches(settings.medial_axis == MedialAxis::kGeodesic
                  ? std::make_unique<const SurfacePatches>(*surface, wanted_radius, pool)
                  : nullptr),
      normals(std::make_unique<const NormalField>(*surface, settings.radius)) {}

Domain Domain::moved_to(std::shared_ptr<const Surface> where, double old_radius, const FlowSettings& settings,
                        ThreadPool& pool) const {
  Domain moved(std::move(where), {}, settings, pool);
  moved.wanted_radius = wanted_radius;
  moved.radius = radius;
  for (RadiusField* field : {&moved.wanted_radius, &moved.radius}) field->rescale(old_radius, settings.radius);
  moved.expected_length = filling_length(*moved.surface, moved.wanted_radius);
  moved.directions = directions;
  moved.directions.ride(*surface, *moved.surface);
  return moved;
}

}  // namespace meander
