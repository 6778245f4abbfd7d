// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the rows of a full start are to lie whose field has even lines: a whole number of them divides the width.
#pragma once

#include <optional>
#include <vector>

#include "mesh/even_lines.h"
#include "mesh/line_field.h"
#include "mesh/surface_point.h"

namespace meander {

/// How far apart lines between pairs of rows are, in r, across a component of such a width in r.
///
/// `margin`  between the boundary and where rows have the half of their distance from it
/// `apart`   how far they are to be
double even_distance(double width, double margin, double apart);

class EvenRows {
 public:
  /// `field`  with even lines on every component, see has_even_lines
  /// `rest`   how far apart strands are to come, in r
  EvenRows(const Surface& surface, const LineField& field, double radius, double boundary_distance, double rest);

  /// From a point across the lines towards the row that is nearest, in the plane of its face: the whole way beside the
  /// row, and less farther away, down to none halfway between two. None where rows have no places, as along a pipe.
  Vec2 towards_row(const Surface& surface, const SurfacePoint& p) const;

  /// How far apart rows are, over how far they are to be; none where they have no places, or there are several
  /// components.
  std::optional<double> spread() const { return spread_; }

  /// Whether rows end at tips of other rows, as those that go round a pipe, and not at the boundary.
  bool go_round() const { return go_round_; }

 private:
  HeightsAcross across_;
  double margin_;
  std::optional<double> spread_;
  bool go_round_ = false;
  std::vector<double> distance_;  // of rows, per component; 0: they have no places
};

}  // namespace meander
