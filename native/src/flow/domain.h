// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a curve grows on, and what is wanted where.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <utility>

#include "flow/settings.h"
#include "geodesic/surface_patches.h"
#include "mesh/line_field.h"
#include "mesh/normal_field.h"
#include "mesh/radius_field.h"

namespace meander {

/// A surface with the functions on it that drive a flow. All lengths are in the surface's own unit. Owns what it
/// holds; other flows may share the surface.
struct Domain {
  /// `wanted`  r as it is to be in the end
  Domain(std::shared_ptr<const Surface> where, RadiusField wanted, const FlowSettings& settings, ThreadPool& pool);
  /// `density` positive, or empty: 1 everywhere.
  Domain(std::shared_ptr<const Surface> where, const VertexData<double>& density, const FlowSettings& settings,
         ThreadPool& pool)
      : Domain(std::move(where), RadiusField(settings.radius, density), settings, pool) {}

  /// The same on a surface that has moved. `settings` are those on that surface, `old_radius` was r before.
  Domain moved_to(std::shared_ptr<const Surface> surface, double old_radius, const FlowSettings& settings,
                  ThreadPool& pool) const;

  /// The same for other settings than `old` ones. `density` as in the constructor; null: as it is. What does not
  /// depend on what has changed is shared.
  Domain revised(const FlowSettings& old, const FlowSettings& settings, const VertexData<double>* density,
                 ThreadPool& pool) const;

  std::shared_ptr<const Surface> surface;
  RadiusField wanted_radius;  ///< r as it is to be in the end,
  RadiusField radius;         ///< and as it is while the curve approaches its spacing
  double expected_length;     ///< of a curve that fills the surface: area over spacing
  LineField directions;       ///< that strands are to follow; may be empty
  std::shared_ptr<const BoundaryObstacle> boundary;
  std::shared_ptr<const SurfacePatches> patches;  ///< for MedialAxis::kGeodesic, else null
  std::shared_ptr<const NormalField> normals;     ///< found when they are asked for
};

/// More nodes than this are refused, for want of memory.
inline constexpr double kMostNodes = 5e8;

/// About how many nodes a curve has that fills a surface: one for every 1.4 h of its length, area / (2 r), where both
/// lengths shrink with the root of the density. `density_at` is asked for every vertex of every face.
double expected_nodes(const Surface& surface, const FlowSettings& settings,
                      const std::function<double(uint32_t)>& density_at);

}  // namespace meander
