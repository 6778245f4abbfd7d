// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/bent_path.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "geodesic/chart.h"

namespace meander {
namespace {

/// Places on each side, that far apart in lengths of the straight line: the last is seen at an angle of 72 degrees. What
/// is to be found may be narrow.
constexpr int kSidesteps = 48;
constexpr double kSidestep = 1.0 / 32;

/// Legs of a bend are as good where they are farther from the boundary than this, in r; asked at so many places of each.
constexpr double kClearEnough = 0.5;
constexpr int kPlacesOfLeg = 4;

/// How near a straight leg comes to a boundary or a guide, in r, up to kClearEnough.
double clearance(const LineNetwork& network, const SurfacePoint& from, Vec2 leg) {
  double least = kClearEnough;
  for (int k = 0; k <= kPlacesOfLeg; ++k) {
    Path path;
    const Trace there = trace_geodesic(network.surface(), from, (static_cast<double>(k) / kPlacesOfLeg) * leg, path);
    const LineNetwork::Node node = network.make_node(there.end, kNone, 0);
    network.near(node, kClearEnough * node.radius, [](uint32_t line) { return line >= LineNetwork::kBoundary; },
                 [&](uint32_t, double distance) {
                   least = std::min(least, distance / node.radius);
                   return false;
                 });
  }
  return least;
}

}  // namespace

std::optional<Bend> bend_between(const LineNetwork& network, uint32_t from, uint32_t to, PathShortener& shortener) {
  const Surface& s = network.surface();
  const LineNetwork::Node &a = network.nodes()[from], &b = network.nodes()[to];
  const double length = (b.place - a.place).norm();
  const Vec2 chord = length * unit(s.to_plane(a.point.face, b.place - a.place));
  std::optional<Bend> best;
  double least = std::numeric_limits<double>::infinity();
  for (int step = -kSidesteps; step <= kSidesteps; ++step) {
    const Vec2 leg = Vec2{0.5, kSidestep * step} * chord;
    Bend bend;
    const Trace there = trace_geodesic(s, a.point, leg, bend.to);
    if (there.hit_boundary) continue;
    Chart chart = Chart::at(there.end, position(s, there.end));
    if (!chart.advance_to(s, b.point, b.place, 2 * length)) continue;
    const Trace end = trace_geodesic(s, there.end, chart.place, bend.on);
    if (end.hit_boundary) continue;
    const double longer = there.length + end.length;
    if (!(longer / kClearEnough < least)) continue;
    const double cost = longer / std::min(clearance(network, a.point, leg), clearance(network, there.end, chart.place));
    if (!(cost < least)) continue;
    const auto shape_to = shortener.adopt(a.point, there.end, bend.to);
    const auto shape_on = shortener.adopt(there.end, b.point, bend.on);
    if (!shape_to || !shape_on || !(shape_to->length > 0) || !(shape_on->length > 0)) continue;
    least = cost;
    bend.place = there.end;
    bend.shape_to = *shape_to;
    bend.shape_on = *shape_on;
    best = std::move(bend);
  }
  return best;
}

std::optional<PathShape> bent_path(const LineNetwork& network, uint32_t from, uint32_t to, PathShortener& shortener,
                                   Path& path) {
  const Surface& s = network.surface();
  const LineNetwork::Node &a = network.nodes()[from], &b = network.nodes()[to];
  const double length = (b.place - a.place).norm();
  const Vec2 chord = length * unit(s.to_plane(a.point.face, b.place - a.place));
  std::optional<PathShape> best;
  for (int step = -kSidesteps; step <= kSidesteps; ++step) {
    Path legs;
    const Trace there = trace_geodesic(s, a.point, Vec2{0.5, kSidestep * step} * chord, legs);
    if (there.hit_boundary) continue;
    Chart chart = Chart::at(there.end, position(s, there.end));
    if (!chart.advance_to(s, b.point, b.place, 2 * length)) continue;
    trace_geodesic(s, there.end, chart.place, legs);
    const auto shape = shortener.adopt(a.point, b.point, legs);
    if (!shape || !(shape->length > 0) || (best && best->length <= shape->length)) continue;
    best = shape;
    path = std::move(legs);
  }
  return best;
}

}  // namespace meander
