// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/even_rows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/elementary.h"
#include "seed/constants.h"
#include "seed/streamlines.h"

namespace meander {
namespace {

/// Of two whole numbers that are as near the lower one, as where an odd number of strands would fit: a closed line has
/// an even one, and strands that are too far apart look better than ones that are too near.
double nearest_count(double lines) {
  return std::max(std::ceil(lines * (1 - kHalfwayCount) - 0.5), 1.0);
}

/// How far across the lines the boundary leads in all: twice the width where every row ends there.
double across_boundary(const Surface& surface, const std::vector<Vec2>& line) {
  double sum = 0;
  for (const HalfEdge e : surface.boundary()) sum += std::abs(cross(line[face_of(e)], surface.along(e)));
  return sum;
}

}  // namespace

double even_distance(double width, double margin, double apart) {
  return (width - 2 * margin) / nearest_count((width - 2 * margin) / apart);
}

EvenRows::EvenRows(const Surface& surface, const LineField& field, double radius, double boundary_distance,
                   double rest)
    : across_(heights_across(surface, field)), margin_((2 * boundary_distance - 1) * radius) {
  const double wanted = LineSpacing().apart * rest * radius;
  for (size_t k = 0; k < across_.width.size(); ++k) {
    const double apart = even_distance(across_.width[k], margin_, wanted);
    const bool has_places = across_.width[k] > 0 && apart > 0 && across_.gap[k] < kMostStepOfRows * apart;
    distance_.push_back(has_places ? 0.5 * apart : 0);
  }
  if (distance_.size() != 1 || distance_[0] == 0) return;
  spread_ = 2 * distance_[0] / wanted;
  go_round_ = across_boundary(surface, across_.line) < across_.width[0];
}

Vec2 EvenRows::towards_row(const Surface& surface, const SurfacePoint& p) const {
  const uint32_t component = surface.component(p.face);
  const double distance = distance_[component];
  if (!(distance > 0)) return {};
  const double rows = (across_.at(surface, p) - across_.low[component] - margin_) / distance;
  const double turn = 2 * std::numbers::pi;
  // Rows lie halfway between whole numbers.
  const double way = elementary::sin(turn * (rows - std::floor(rows))) / turn * distance;
  const Vec2 line = across_.line[p.face];
  return way * Vec2{-line.y, line.x};
}

}  // namespace meander
