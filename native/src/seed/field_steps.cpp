// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/field_steps.h"

#include <cmath>

#include "seed/constants.h"

namespace meander {

std::optional<Vec2> FieldSteps::from(const SurfacePoint& p) const {
  const Vec2 line = field_.at(p), direction = unit(line);
  if (!(norm(direction) > 0) || norm(line) < kLeastField) return std::nullopt;
  return direction;
}

std::optional<FieldSteps::Ahead> FieldSteps::ahead(const SurfacePoint& from, Vec2 direction, double step) const {
  const auto turn = turn_ahead(from, direction, 0.5 * step);
  if (!turn) return std::nullopt;
  Ahead ahead;
  const Trace there = trace_geodesic(s_, from, step * (direction * *turn), ahead.path);
  if (there.hit_boundary) return std::nullopt;
  const auto next = direction_at(there.end, there.direction);
  if (!next) return std::nullopt;
  ahead.end = there.end;
  ahead.direction = *next;
  return ahead;
}

/// The direction of the field at a point for a line that arrives there in this one.
std::optional<Vec2> FieldSteps::direction_at(const SurfacePoint& p, Vec2 arriving) const {
  const Vec2 line = field_.at(p);
  if (norm(line) < kLeastField) return std::nullopt;
  const Vec2 along = unit(line);
  const double cosine = dot(along, arriving);
  if (std::abs(cosine) < kMostTurnOfLine) return std::nullopt;
  return cosine < 0 ? -along : along;
}

/// By how much the field turns until half of a step ahead: the midpoint rule.
std::optional<Vec2> FieldSteps::turn_ahead(const SurfacePoint& p, Vec2 direction, double half) const {
  Path path;
  const Trace middle = trace_geodesic(s_, p, half * direction, path);
  const auto there = direction_at(middle.end, middle.direction);
  if (!there) return std::nullopt;
  return *there * conj(middle.direction);
}

}  // namespace meander
