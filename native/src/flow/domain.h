// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a curve grows on, and what is wanted where.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "base/tell.h"
#include "flow/settings.h"
#include "geodesic/surface_patches.h"
#include "mesh/line_field.h"
#include "mesh/normal_field.h"
#include "mesh/radius_field.h"
#include "mesh/surface_at_scale.h"
#include "seed/even_rows.h"

namespace meander {

/// A surface with the functions on it that drive a flow. All lengths are in the surface's own unit. Owns what it
/// holds; other flows may share the surface.
struct Domain {
  /// `asked`       r on that surface as it is to be in the end
  /// `directions`  that strands are to follow; may be empty
  /// `tell`        is told how far this is
  Domain(std::shared_ptr<const Surface> where, RadiusField asked, LineField directions, const FlowSettings& settings,
         ThreadPool& pool, const Tell& tell = {});
  /// `density` positive, or empty: 1 everywhere.
  Domain(std::shared_ptr<const Surface> where, const VertexData<double>& density, const FlowSettings& settings,
         ThreadPool& pool, const Tell& tell = {})
      : Domain(std::move(where), RadiusField(settings.radius, density), {}, settings, pool, tell) {}

  /// Other directions to follow, of the given surface.
  void follow(LineField field, const FlowSettings& settings, ThreadPool& pool);

  /// Sets r on the way to the spacing asked for: `factor` times the wanted one or, where `curve` has no room for that,
  /// less; see leave_room. What follows the paper has it everywhere.
  void set_radius(double factor, const Curve& curve, const FlowSettings& settings);

  /// Goes on with r `next` times as large as without a correction.
  void correct(double next) noexcept {
    if (next == correction) return;
    for (RadiusField* r : {&radius, whole_radius ? &*whole_radius : nullptr}) {
      if (r) r->rescale(correction, next);
    }
    correction = next;
  }

  /// r by which results are judged, whatever room there is: where strands are to come to rest.
  RadiusField judged_radius() const {
    RadiusField r = whole_radius ? *whole_radius : radius;
    r.rescale(correction, rest);
    return r;
  }

  /// Lengths on the given surface in those of the one that the flow runs on, around a point; 1 where they are the same.
  double stretch_at(const SurfacePoint& p) const {
    return surface == given ? 1 : asked_radius.at(*given, p) / (rest * wanted_radius.at(*surface, p));
  }

  /// The same on a surface that has moved. `settings` are those on that surface, `old_radius` was r before.
  Domain moved_to(std::shared_ptr<const Surface> surface, double old_radius, const FlowSettings& settings,
                  ThreadPool& pool) const;

  /// The same for other settings than `old` ones. `density` as in the constructor; null: as it is. What does not
  /// depend on what has changed is shared.
  Domain revised(const FlowSettings& old, const FlowSettings& settings, const VertexData<double>* density,
                 ThreadPool& pool) const;

  /// What leaves the library is of the surface as it was given, with r as it was asked for there.
  std::shared_ptr<const Surface> given;
  RadiusField asked_radius;
  /// The flow runs on that surface as it is at the scale of the spacing, see at_scale(), where distances are along the
  /// surface; else, and where nothing is rough, it is the same one. There r is as much smaller as lengths are, and as
  /// much larger as strands come to rest nearer to one another.
  std::shared_ptr<const Surface> surface;
  double rest = 1;            ///< FlowSettings::rest()
  double correction = 1;      ///< of r, as strands come nearer to one another here, or less near, than `rest` says
  RadiusField wanted_radius;  ///< r as it is to be in the end, but for the correction,
  RadiusField radius;         ///< and as it is, also while the curve approaches its spacing, or has no room for that:
  std::optional<RadiusField> whole_radius;  ///< then what it would be with room, else nothing
  bool was_moved = false;     ///< with the curve on it
  bool narrow = false;        ///< part of the surface is a narrow strip, see leave_room
  Roughness roughness;
  double expected_length;     ///< of a curve that fills the surface: area over spacing
  LineField directions;       ///< that strands are to follow; may be empty
  bool even_rows = false;     ///< they can, at one spacing all along; see has_even_lines
  std::shared_ptr<const EvenRows> rows;  ///< where these are to lie in a full start; else null
  std::shared_ptr<const BoundaryObstacle> boundary;
  std::shared_ptr<const SurfacePatches> patches;  ///< for MedialAxis::kGeodesic, else null
  std::shared_ptr<const NormalField> normals;     ///< of the given surface, found when they are asked for

 private:
  double look_at_scale(const FlowSettings& settings, ThreadPool& pool, const Tell& tell = {});
  void look_at_lines(const FlowSettings& settings);
};

/// About how many nodes a curve has that fills a surface: one for every kMeanSegment h of its length, area / (2 r),
/// where both lengths shrink with the root of the density. `density_at` is asked for every vertex of every face.
double expected_nodes(const Surface& surface, const FlowSettings& settings,
                      const std::function<double(uint32_t)>& density_at);

}  // namespace meander
