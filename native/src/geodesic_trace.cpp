// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic_trace.h"

#include <array>
#include <cmath>
#include <limits>

namespace meander {
namespace {

/// A walk that crosses more faces than this is cut short: a displacement is at most a few r long, and
/// no sensible mesh puts so many faces there.
constexpr int kMostFaces = 100000;

}  // namespace

Trace trace_geodesic(const Surface& surface, const SurfacePoint& start, Vec2 displacement,
                     std::vector<Crossing>& crossings) {
  const double wanted = norm(displacement);
  Trace trace{start, unit(displacement), 0, false};
  if (!(wanted > 0)) return trace;

  uint32_t f = start.face;
  std::array<double, 3> b{start.weight(0), start.weight(1), start.weight(2)};
  uint32_t entered = kNone;  // the corner opposite the edge through which the walk came
  for (int steps = 0; steps < kMostFaces; ++steps) {
    // Rates of the barycentric coordinates along the direction.
    const Vec2 c1 = surface.corner(f, 1), c2 = surface.corner(f, 2);
    std::array<double, 3> rate;
    rate[2] = trace.direction.y / c2.y;
    rate[1] = (trace.direction.x - rate[2] * c2.x) / c1.x;
    rate[0] = -rate[1] - rate[2];

    uint32_t exit = kNone;
    double distance = wanted - trace.length;
    for (uint32_t k = 0; k < 3; ++k) {
      if (k == entered || !(rate[k] < 0)) continue;
      const double until = b[k] / -rate[k];
      if (until < distance) {
        distance = until;
        exit = k;
      }
    }
    for (uint32_t k = 0; k < 3; ++k) b[k] += distance * rate[k];
    trace.length += distance;
    if (exit == kNone) {
      trace.length = wanted;
      break;
    }
    const uint32_t i = next_corner(exit), j = next_corner(i);
    const HalfEdge e = 3 * f + i;
    const double t = clear_of_ends(b[j] / (b[i] + b[j]));
    const HalfEdge other = surface.twin(e);
    if (other == kNone) {
      trace.hit_boundary = true;
      b[exit] = 0;
      break;
    }
    crossings.push_back({e, t});
    trace.direction = unit(trace.direction * surface.transition(e));
    f = face_of(other);
    const uint32_t k = corner_of(other);
    b[k] = t;  // the twin runs the other way: its start is this edge's end
    b[next_corner(k)] = 1 - t;
    b[prev_corner(k)] = 0;
    entered = prev_corner(k);
  }
  trace.end = make_point(f, b[0], b[1], b[2]);
  return trace;
}

}  // namespace meander
