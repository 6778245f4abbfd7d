// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface moves under the curve (section 5, Fig. 20): nodes ride on their faces, segments become
// straight again, and the flow goes on in the polish.
//
// Points of the curve are weights of a face's corners and shares of an edge, and within a face an affine
// map keeps what lies on which side: a curve without crossings that rides along has none afterwards.
#include <algorithm>
#include <cmath>

#include "base/failure.h"
#include "flow/flow.h"

namespace meander {
namespace {

/// As for a new flow: a curve has about one node for every 1.4 h of its length, area / (2 r).
constexpr double kMostNodes = 5e8, kMeanSegment = 1.4;

}  // namespace

void Flow::set_vertices(std::span<const double> vertices, const MeshMap* map) {
  auto moved = std::make_shared<const Surface>(surface_->deformed(vertices, pool_, map));
  check_size(*moved);
  rescale(surface_->scale() / moved->scale());
  field_.ride(*surface_, *moved);
  direction_cache_.clear();
  steps_.clear();
  normals_.reset();  // before what it refers to
  surface_ = std::move(moved);
  boundary_.emplace(*surface_, 0.5 * settings_.segment_length);

  constexpr size_t kBlock = 512;
  pool_.for_blocks(curve_.size(), kBlock, [&](size_t, size_t begin, size_t end) {
    for (uint32_t i = static_cast<uint32_t>(begin); i < end; ++i) {
      if (!curve_.has_segment(i)) continue;
      curve_.shapes[i] = measure_path(*surface_, curve_.nodes[i], curve_.nodes[curve_.next(i)], curve_.paths[i]);
    }
  });
  retraction_.straighten(*surface_, curve_, pool_, seconds_.move);

  double clamped = 1;
  if (!polishing() && approach_.arrived()) {
    find_radii();
    clamped = clamped_share();
  }
  convergence_.restart(clamped);
  started_at_ = history_.size();
  cancelled_ = false;
  cut_guides();
  refine();
  find_metric();
}

/// Refuses what checked_settings would refuse for a new flow.
void Flow::check_size(const Surface& surface) const {
  const double to_new = surface_->scale() / surface.scale();
  const double r = settings_.radius * to_new;
  if (2 * r > 1 || 4 * r * r > surface.area()) {
    throw Failure(FailureKind::kInvalidArgument,
                  "The surface has shrunk below the spacing (its diagonal is " + number(surface.scale()) +
                      " now); choose a smaller spacing and start a new flow.");
  }
  double nodes = 0;
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    double density = 0;
    for (const uint32_t v : surface.face(f)) {
      const double share = settings_.radius / wanted_radius_.at(v);
      density += share * share / 3;
    }
    nodes += surface.face_area(f) * density / (2 * r * kMeanSegment * settings_.segment_length * to_new);
  }
  if (!(nodes <= kMostNodes)) {
    throw Failure(FailureKind::kInvalidArgument,
                  "The surface has grown so large that the curve would need about " + number(nodes) +
                      " nodes, and more than 500 million are not supported; choose a larger spacing and start "
                      "a new flow.");
  }
}

/// Multiplies every length by which the unit of the surface has become smaller.
void Flow::rescale(double factor) {
  const double old_radius = settings_.radius;
  for (double* length : {&settings_.radius, &settings_.segment_length, &settings_.max_radius}) {
    *length = settle(*length * factor);
  }
  for (RadiusField* field : {&wanted_radius_, &present_radius_}) field->rescale(old_radius, settings_.radius);
  approach_.rescale(factor);
  for (Radii& sides : radii_) {
    for (double& r : sides) r *= factor;
  }
  for (IterationRecord& record : history_) {
    for (double* value : {&record.length, &record.mean_step, &record.energy}) *value *= factor;
  }
}

}  // namespace meander
