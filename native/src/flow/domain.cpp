// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/domain.h"

#include <utility>

#include "flow/constants.h"
#include "flow/room.h"
#include "geodesic/patch_comparison.h"

namespace meander {
namespace {

std::shared_ptr<const BoundaryObstacle> sampled_boundary(const Surface& surface, const FlowSettings& settings) {
  return std::make_shared<const BoundaryObstacle>(surface, kBoundarySampling * settings.segment_length,
                                                 settings.medial_axis == MedialAxis::kGeodesic);
}

std::shared_ptr<const SurfacePatches> patches_for(const Surface& surface, const RadiusField& radius,
                                                  const FlowSettings& settings, ThreadPool& pool,
                                                  const Tell& tell = {}) {
  if (settings.medial_axis != MedialAxis::kGeodesic) return nullptr;
  return std::make_shared<const SurfacePatches>(
      compared_patches(surface, radius, settings.max_radius / settings.radius, pool, tell));
}

/// The shares of a domain's time that have passed when it is seen whether the surface is rough, and when it has been
/// smoothed where it is. As nothing tells before whether it is, the first lies in the middle between what it would be
/// with and without that.
struct ScaleShares {
  double looked, smoothed;
};

ScaleShares shares_of_scale(const Surface& surface, const RadiusField& radius) {
  const auto faces = static_cast<double>(surface.face_count());
  const PatchTimes patches = times_of_patches(surface, radius);
  const double looking = kLookingFace * faces, smoothing = kSmoothingFace * faces;
  const double after = patches.cutting + patches.comparing;
  const double looked = (looking / (looking + after) + looking / (looking + smoothing + after)) / 2;
  return {looked, looked + (1 - looked) * smoothing / (smoothing + after)};
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
  double weighted_area = 0;
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    const Triangle& t = surface.face(f);
    weighted_area += surface.face_area(f) * (density_at(t[0]) + density_at(t[1]) + density_at(t[2])) / 3;
  }
  return weighted_area / (2 * settings.radius * kMeanSegment * settings.segment_length);
}

Domain::Domain(std::shared_ptr<const Surface> where, RadiusField asked, LineField field, const FlowSettings& settings,
               ThreadPool& pool, const Tell& tell)
    : given(std::move(where)),
      asked_radius(std::move(asked)),
      surface(given),
      wanted_radius(asked_radius),
      radius(wanted_radius),
      directions(std::move(field)),
      normals(std::make_shared<const NormalField>(*given, settings.radius)) {
  const double scaled = look_at_scale(settings, pool, tell);
  boundary = sampled_boundary(*surface, settings);
  patches = patches_for(*surface, wanted_radius, settings, pool, part_of(tell, scaled, 1));
  if (tell) tell(1);
  look_at_lines(settings);
}

void Domain::set_radius(double factor, const Curve& curve, const FlowSettings& settings) {
  RadiusField whole = wanted_radius;
  whole.set_multiple(wanted_radius, factor * correction);
  RadiusField next = whole;
  const bool may_be_less = settings.stop_rule != StopRule::kPaper && settings.boundary_distance <= 0.5;
  const Room room = may_be_less ? leave_room(*surface, curve, next) : Room{};
  narrow = room.narrow;
  if (room.smaller) {
    whole_radius = std::move(whole);
  } else {
    whole_radius.reset();
  }
  radius = std::move(next);
}

/// Finds the surface at the scale of r as it is asked for, and what follows from both. Returns how much of the domain's
/// time has passed then.
double Domain::look_at_scale(const FlowSettings& settings, ThreadPool& pool, const Tell& tell) {
  const bool along_surface = settings.medial_axis == MedialAxis::kGeodesic;
  const ScaleShares shares = tell ? shares_of_scale(*given, asked_radius) : ScaleShares{0, 0};
  SurfaceAtScale found = at_scale(given, asked_radius, along_surface ? settings.roughness : 1, pool,
                                  part_of(tell, 0, shares.looked), part_of(tell, shares.looked, shares.smoothed));
  surface = std::move(found.surface);
  roughness = found.roughness;
  rest = settings.rest(!directions.empty());
  wanted_radius.set_multiple(RadiusField::multiplied(asked_radius, found.shrinkage), 1 / rest);
  radius = wanted_radius;
  expected_length = filling_length(*surface, wanted_radius);
  return surface == given ? shares.looked : shares.smoothed;
}

void Domain::look_at_lines(const FlowSettings& settings) {
  even_rows = !asked_radius.varies() && has_even_lines(*surface, directions);
  rows.reset();
  if (!even_rows || !settings.full_start || !settings.polish) return;
  rows = std::make_shared<const EvenRows>(*surface, directions, wanted_radius.most(), settings.boundary_distance, rest);
}

Domain Domain::moved_to(std::shared_ptr<const Surface> where, double old_radius, const FlowSettings& settings,
                        ThreadPool& pool) const {
  RadiusField asked = asked_radius;
  asked.rescale(old_radius, settings.radius);
  Domain moved(std::move(where), std::move(asked), directions, settings, pool);
  moved.directions.ride(*surface, *moved.surface);
  moved.look_at_lines(settings);
  return moved;
}

void Domain::follow(LineField field, const FlowSettings& settings, ThreadPool& pool) {
  if (surface != given) field.ride(*given, *surface);
  directions = std::move(field);
  const double before = std::exchange(rest, settings.rest(!directions.empty()));
  if (rest != before) {
    for (RadiusField* r : {&wanted_radius, &radius}) r->rescale(rest, before);
    if (whole_radius) whole_radius->rescale(rest, before);
    expected_length = filling_length(*surface, wanted_radius);
    patches = patches_for(*surface, wanted_radius, settings, pool);
  }
  look_at_lines(settings);
}

Domain Domain::revised(const FlowSettings& old, const FlowSettings& settings, const VertexData<double>* density,
                       ThreadPool& pool) const {
  Domain next = *this;
  if (density) {
    next.asked_radius = RadiusField(settings.radius, *density);
  } else {
    next.asked_radius.rescale(old.radius, settings.radius);
  }
  const bool same_radius = next.asked_radius == asked_radius;
  const bool same_scale =
      same_radius && settings.roughness == old.roughness && settings.medial_axis == old.medial_axis &&
      settings.rest(!directions.empty()) == rest;
  if (!same_scale) next.look_at_scale(settings, pool);
  next.radius = next.wanted_radius;
  const bool same_surface = next.surface == surface;
  if (!same_surface) next.directions.ride(*surface, *next.surface);
  if (!same_surface || settings.segment_length != old.segment_length) {
    next.boundary = sampled_boundary(*next.surface, settings);
  }
  const bool same_clamp = settings.max_radius / settings.radius == old.max_radius / old.radius;
  if (!same_surface || next.wanted_radius != wanted_radius || !same_clamp || settings.medial_axis != old.medial_axis) {
    next.patches = patches_for(*next.surface, next.wanted_radius, settings, pool);
  }
  next.look_at_lines(settings);
  if (settings.radius != old.radius) next.normals = std::make_shared<const NormalField>(*given, settings.radius);
  return next;
}

}  // namespace meander
