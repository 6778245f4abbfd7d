// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/bent_path.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "geodesic/chart.h"
#include "seed/constants.h"

namespace meander {
namespace {

/// How far along the straight line the first place is: one in the middle, or two as far from both ends, as beside what
/// is long.
constexpr std::array kBendShares = {1.0 / 2, 1.0 / 4, 1.0 / 6};

/// Straight legs, one after another.
class Legs {
 public:
  double length = 0;

  Legs(const Surface& surface, const SurfacePoint& from) : s_(surface), places_{from} {}

  /// The next one; false where it meets the boundary.
  bool add(Vec2 way) {
    ways_.push_back(way);
    const Trace there = trace_geodesic(s_, places_.back(), way, paths_.emplace_back());
    places_.push_back(there.end);
    length += there.length;
    return !there.hit_boundary;
  }
  /// The same to a point; false also where that is not seen, or farther than `most`.
  bool add_to(const SurfacePoint& p, const Vec3& place, double most) {
    Chart chart = Chart::at(places_.back(), position(s_, places_.back()));
    return chart.advance_to(s_, p, place, most) && add(chart.place);
  }

  /// How near they come to a boundary or a guide, in r, up to kLegsClear.
  double clearance(const LineNetwork& network) const {
    double least = kLegsClear;
    for (size_t leg = 0; leg < ways_.size(); ++leg) {
      for (int k = 0; k <= kPlacesOfLeg; ++k) {
        Path path;
        const Vec2 part = (static_cast<double>(k) / kPlacesOfLeg) * ways_[leg];
        const LineNetwork::Node node = network.make_node(trace_geodesic(s_, places_[leg], part, path).end, kNone, 0);
        network.near(node, kLegsClear * node.radius, [](uint32_t line) { return line >= LineNetwork::kBoundary; },
                     [&](uint32_t, double distance) {
                       least = std::min(least, distance / node.radius);
                       return false;
                     });
      }
    }
    return least;
  }

  /// What they are as legs that end there; nothing where one has no length.
  std::optional<Bend> as_bend(const SurfacePoint& end, PathShortener& shortener) {
    places_.back() = end;
    Bend bend;
    for (size_t leg = 0; leg < ways_.size(); ++leg) {
      const auto shape = shortener.adopt(places_[leg], places_[leg + 1], paths_[leg]);
      if (!shape || !(shape->length > 0)) return std::nullopt;
      bend.legs.push_back({std::move(paths_[leg]), *shape});
    }
    bend.places.assign(places_.begin() + 1, places_.end() - 1);
    return bend;
  }

 private:
  const Surface& s_;
  std::vector<SurfacePoint> places_;
  std::vector<Vec2> ways_;
  std::vector<Path> paths_;
};

}  // namespace

std::optional<Bend> bend_between(const LineNetwork& network, uint32_t from, uint32_t to, PathShortener& shortener,
                                 const std::function<bool(Vec2 leaving, Vec2 arriving)>& may_be) {
  const Surface& s = network.surface();
  const LineNetwork::Node &a = network.nodes()[from], &b = network.nodes()[to];
  const double length = (b.place - a.place).norm();
  const Vec2 ahead = length * unit(s.to_plane(a.point.face, b.place - a.place));
  const Vec2 back = length * unit(s.to_plane(b.point.face, a.place - b.place));
  std::optional<Bend> best;
  double least = std::numeric_limits<double>::infinity();
  for (const double share : kBendShares) {
    for (int step = -kSidesteps; step <= kSidesteps; ++step) {
      Legs legs(s, a.point);
      if (!legs.add(Vec2{share, kSidestep * step} * ahead)) continue;
      if (share < 0.5) {
        Path path;
        const Trace there = trace_geodesic(s, b.point, Vec2{share, -kSidestep * step} * back, path);
        if (there.hit_boundary || !legs.add_to(there.end, position(s, there.end), 2 * length)) continue;
      }
      if (!legs.add_to(b.point, b.place, 2 * length) || !(legs.length / kLegsClear < least)) continue;
      const double cost = legs.length / legs.clearance(network);
      if (!(cost < least)) continue;
      auto bend = legs.as_bend(b.point, shortener);
      if (!bend || !may_be(bend->legs.front().shape.leaving, bend->legs.back().shape.arriving)) continue;
      least = cost;
      best = std::move(bend);
    }
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
