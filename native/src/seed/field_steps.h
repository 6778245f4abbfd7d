// SPDX-License-Identifier: GPL-3.0-or-later
//
// Steps along a field of lines, by the midpoint rule.
#pragma once

#include <optional>

#include "curve/curve.h"
#include "geodesic/geodesic_trace.h"
#include "mesh/line_field.h"

namespace meander {

/// Follows a field of lines over a surface. Refers to both; any thread may ask.
class FieldSteps {
 public:
  FieldSteps(const Surface& surface, const LineField& field) : s_(surface), field_(field) {}

  struct Ahead {
    SurfacePoint end;
    Vec2 direction;  ///< of the field there
    Path path;
  };
  /// A step in a direction that the field has at a point, which turns with the field. Nothing where that ends at the
  /// boundary or comes to where the field has no direction, or turns by more than 60 degrees.
  std::optional<Ahead> ahead(const SurfacePoint& from, Vec2 direction, double step) const;

  /// One of the two directions of the field; nothing where it has none.
  std::optional<Vec2> from(const SurfacePoint& p) const;

 private:
  std::optional<Vec2> direction_at(const SurfacePoint& p, Vec2 arriving) const;
  std::optional<Vec2> turn_ahead(const SurfacePoint& p, Vec2 direction, double half) const;

  const Surface& s_;
  const LineField& field_;
};

}  // namespace meander
