// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/even_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh/constants.h"

namespace meander {
namespace {

/// The line at a corner of a face, of the sign that makes it the nearer to another one.
Vec2 line_like(const LineField& field, uint32_t f, uint32_t k, Vec2 other) {
  const Vec2 line = unit(field.at({f, Vec2{k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0}}));
  return dot(line, other) < 0 ? -line : line;
}

Vec2 line_of_face(const LineField& field, uint32_t f) { return unit(field.at({f, Vec2{1.0 / 3, 1.0 / 3}})); }

/// What flows out of a face with lines of length 1, whose divergence is how fast they part.
double spreading_in(const Surface& surface, const LineField& field, uint32_t f) {
  const Vec2 middle = line_of_face(field, f);
  double flow = 0;
  for (uint32_t k = 0; k < 3; ++k) {
    const Vec2 mean = line_like(field, f, k, middle) + line_like(field, f, next_corner(k), middle);
    flow += 0.5 * cross(mean, surface.along(3 * f + k));
  }
  return flow;
}

/// The same of an edge, between the faces beside it.
double spreading_at(const Surface& surface, const LineField& field, HalfEdge e) {
  const HalfEdge twin = surface.twin(e);
  const auto line_at = [&](HalfEdge h) {
    const uint32_t f = face_of(h), k = corner_of(h);
    const Vec2 middle = line_of_face(field, f);
    return unit(line_like(field, f, k, middle) + line_like(field, f, next_corner(k), middle));
  };
  const Vec2 here = line_at(e) * surface.transition(e), there = line_at(twin);
  return cross(dot(here, there) < 0 ? here + there : here - there, surface.along(twin));
}

/// A face, its line of the sign of those before it, and how far across these its first corner is.
struct Placed {
  uint32_t face;
  Vec2 line;
  double height;
};

/// The face beyond a half-edge, whose end is at this height.
Placed beyond(const Surface& surface, const LineField& field, Vec2 line, HalfEdge e, double height_of_end) {
  const HalfEdge twin = surface.twin(e);
  const Vec2 there = line_of_face(field, face_of(twin)), carried = line * surface.transition(e);
  Placed next{face_of(twin), dot(there, carried) < 0 ? -there : there, height_of_end};
  // The twin begins at that end; round its face to the first corner.
  for (HalfEdge h = twin; corner_of(h) != 0; h = 3 * next.face + next_corner(corner_of(h))) {
    next.height += cross(next.line, surface.along(h));
  }
  return next;
}

}  // namespace

std::vector<uint8_t> with_even_lines(const Surface& surface, const LineField& field) {
  std::vector<uint8_t> even(surface.component_count(), 0);
  if (field.empty()) return even;
  std::vector<double> flow(even.size(), 0), area(even.size(), 0);
  for (uint32_t f = 0; f < surface.face_count(); ++f) area[surface.component(f)] += surface.face_area(f);
  for (size_t k = 0; k < even.size(); ++k) even[k] = area[k] > 0;
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    const uint32_t component = surface.component(f);
    if (!even[component]) continue;  // no more of it is needed, and on most surfaces a few faces say so
    flow[component] += std::abs(spreading_in(surface, field, f));
    for (HalfEdge e = 3 * f; e < 3 * f + 3; ++e) {
      const HalfEdge twin = surface.twin(e);
      if (twin != kNone && e < twin) flow[component] += std::abs(spreading_at(surface, field, e));
    }
    even[component] = flow[component] < kMostSpreading * std::sqrt(area[component]);
  }
  return even;
}

bool has_even_lines(const Surface& surface, const LineField& field) {
  return !field.empty() && std::ranges::count(with_even_lines(surface, field), 0) == 0;
}

HeightsAcross heights_across(const Surface& surface, const LineField& field) {
  std::vector<double> low(surface.component_count(), std::numeric_limits<double>::infinity());
  std::vector<double> high(low.size(), -std::numeric_limits<double>::infinity());
  std::vector<uint8_t> seen(surface.face_count(), 0);
  HeightsAcross across;
  across.line.resize(surface.face_count());
  across.first.resize(surface.face_count());
  across.gap.assign(low.size(), 0);
  std::vector<Placed> front;
  const auto place = [&](const Placed& placed) {
    seen[placed.face] = 1;
    across.line[placed.face] = placed.line;
    across.first[placed.face] = placed.height;
    front.push_back(placed);
  };
  for (uint32_t first = 0; first < surface.face_count(); ++first) {
    if (seen[first]) continue;
    front.clear();
    place({first, line_of_face(field, first), 0});
    for (size_t k = 0; k < front.size(); ++k) {
      const Placed here = front[k];
      const uint32_t component = surface.component(here.face);
      double height = here.height;
      for (uint32_t c = 0; c < 3; ++c) {
        const HalfEdge e = 3 * here.face + c, twin = surface.twin(e);
        low[component] = std::min(low[component], height);
        high[component] = std::max(high[component], height);
        height += cross(here.line, surface.along(e));
        if (twin == kNone) continue;
        const Placed other = beyond(surface, field, here.line, e, height);
        if (!seen[other.face]) {
          place(other);
        } else {
          double& gap = across.gap[component];
          gap = std::max(gap, std::abs(across.first[other.face] - other.height));
        }
      }
    }
  }
  const double most = kMostSpreading * std::sqrt(surface.area());
  for (size_t k = 0; k < low.size(); ++k) high[k] = across.gap[k] > most ? 0 : high[k] - low[k];
  across.low = std::move(low);
  across.width = std::move(high);
  return across;
}

}  // namespace meander
