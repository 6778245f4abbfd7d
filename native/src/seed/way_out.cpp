// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/way_out.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <queue>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "base/elementary.h"
#include "geodesic/chart.h"
#include "seed/constants.h"
#include "seed/link_rules.h"

namespace meander {
namespace {

class WaySearch {
 public:
  WaySearch(const LineNetwork& network, const IsGoal& is_goal, const Takes& takes, PathShortener& shortener,
            size_t& places, CancelToken& poll)
      : network_(network), s_(network.surface()), is_goal_(is_goal), takes_(takes), shortener_(shortener),
        left_(places), poll_(poll) {}

  bool find(std::span<const WayEnd> ends) {
    ends_ = ends;
    for (const WayEnd& end : ends) {
      const LineNetwork::Node& node = network_.nodes()[end.node];
      queue_.push({0, places_.size()});
      places_.push_back({node, 0, kNowhere, end.along, static_cast<uint32_t>(places_.size())});
    }
    while (!queue_.empty() && left_ > 0) {
      const size_t k = queue_.top().second;
      queue_.pop();
      View view = look_around(places_[k].node, places_[k].end);
      if (places_[k].before == kNowhere) view.clear = std::max(view.clear, kNarrowestWay);
      if (view.clear < kNarrowestWay) continue;
      places_[k].clear = view.clear;
      const size_t level = view.clear < kWayStep / 2 ? 2 : view.clear < kWayStep ? 1 : 0;
      const double step = std::ldexp(kWayStep, -static_cast<int>(level)) * places_[k].node.radius;
      if (!visited_.insert(cell(places_[k].node, level, step)).second && places_[k].before != kNowhere) continue;
      --left_;
      poll_();
      if (reach_goal(k, view)) return true;
      if (places_[k].cost < kLongestWay && !(view.is_inside() && places_[k].before != kNowhere)) go_on(k, view, step);
    }
    return false;
  }

 private:
  static constexpr size_t kNowhere = SIZE_MAX;
  struct Place {
    LineNetwork::Node node;
    double cost;    // of the way to it, in r
    size_t before;  // the place from which a step has led there
    Vec2 ahead;     // the direction of that step, at its end
    uint32_t end;   // among those that were given
    double clear = kOpenWay;
  };
  struct View {
    double clear = kOpenWay;  // distance from the boundary, in r
    bool by_boundary = false, by_own = false;  // the boundary is in sight, another part of its own tree
    std::vector<std::pair<double, uint32_t>> goals;
    /// Where lines of its own tree lie side by side there is no way out.
    bool is_inside() const { return by_own && !by_boundary; }
  };
  using Cell = std::tuple<uint32_t, size_t, int64_t, int64_t, int64_t>;

  /// Of places of one patch from which steps are as long.
  static Cell cell(const LineNetwork::Node& node, size_t level, double step) {
    const auto part = [&](double x) { return static_cast<int64_t>(std::floor(x / (kWayGrain * step))); };
    return {node.patch, level, part(node.place.x()), part(node.place.y()), part(node.place.z())};
  }

  View look_around(const LineNetwork::Node& place, uint32_t from) const {
    const LineNetwork::Node& own = network_.nodes()[ends_[from].node];
    View view;
    network_.near(place, kWaySeen * place.radius, [&](uint32_t i, double distance) {
      const LineNetwork::Node& other = network_.nodes()[i];
      const double away = distance / place.radius;
      if (other.line >= LineNetwork::kBoundary) {
        view.clear = std::min(view.clear, away);
        view.by_boundary = true;
      } else if (is_goal_(other.line)) {
        view.goals.emplace_back(distance, i);
      } else if (!(other.line == own.line && std::abs(other.arc - own.arc) < kWayOwnPart)) {
        view.by_own = true;
        if (away < kWayFromLines) view.clear = 0;
      }
      return false;
    });
    std::ranges::sort(view.goals);
    return view;
  }

  void go_on(size_t k, const View& view, double step) {
    for (size_t i = 0; i < kWayDirections; ++i) {
      const Place& here = places_[k];
      const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kWayDirections;
      const Vec2 direction = Vec2{elementary::cos(angle), elementary::sin(angle)} * here.ahead;
      if (here.before == kNowhere && !may_leave(ends_[here.end], direction)) continue;
      Path path;
      const Trace there = trace_geodesic(s_, here.node.point, step * direction, path);
      if (there.hit_boundary) continue;
      const double cost = here.cost + step / here.node.radius * kOpenWay / view.clear;
      queue_.push({cost, places_.size()});
      places_.push_back({network_.make_node(there.end, here.node.line, 0), cost, k, there.direction, here.end});
    }
  }

  static bool may_leave(const WayEnd& end, Vec2 direction) {
    const double cosine = dot(direction, end.along);
    return end.tip ? cosine > kLast.ahead : std::abs(cosine) < kLast.sideways;
  }

  bool reach_goal(size_t k, const View& view) {
    for (size_t i = 0; i < std::min(kMostGoals, view.goals.size()); ++i) {
      const uint32_t to = view.goals[i].second;
      if (++offers_[to] > kMostOffers) continue;
      auto way = straightened(k, to);
      if (way && takes_(ends_[places_[k].end].node, to, *way)) return true;
    }
    return false;
  }

  /// The way to a node by way of a place, in legs that are as long as may be.
  std::optional<WayOut> straightened(size_t k, uint32_t to) const {
    std::vector<Place> stops{{network_.nodes()[to], 0, k, {}, places_[k].end}};
    for (size_t i = k; i != kNowhere; i = places_[i].before) stops.push_back(places_[i]);
    std::ranges::reverse(stops);
    WayOut way;
    for (size_t from = 0; from + 1 < stops.size();) {
      std::optional<WayOut::Leg> leg;
      size_t end = from;
      for (double clear = kOpenWay; end + 1 < stops.size(); ++end) {
        clear = std::min(clear, stops[end + 1].clear);
        auto longer = leg_between(stops[from], stops[end + 1], end == from ? 0 : kLegsAsClear * clear);
        if (!longer) break;
        leg = std::move(longer);
      }
      if (!leg) return std::nullopt;
      way.legs.push_back(std::move(*leg));
      if (end + 1 < stops.size()) way.places.push_back(stops[end].node.point);
      from = end;
    }
    return way;
  }

  /// A straight leg that is as far from boundaries and lines as that, in r; 0: anything.
  std::optional<WayOut::Leg> leg_between(const Place& from, const Place& to, double clear) const {
    const LineNetwork::Node &a = from.node, &b = to.node;
    Chart chart = Chart::at(a.point, a.place);
    if (!chart.advance_to(s_, b.point, b.place, kLongestLegOfWay * a.radius)) return std::nullopt;
    const double length = norm(chart.place), parts = std::ceil(length / (kWayStep * a.radius));
    if (!(length > 0) || length > kLongestLegOfWay * a.radius) return std::nullopt;
    for (double part = 0.5; clear > 0 && part < parts; ++part) {
      Path path;
      const Trace there = trace_geodesic(s_, a.point, part / parts * chart.place, path);
      if (there.hit_boundary || look_around(network_.make_node(there.end, a.line, 0), from.end).clear < clear) {
        return std::nullopt;
      }
    }
    WayOut::Leg leg;
    if (trace_geodesic(s_, a.point, chart.place, leg.path).hit_boundary) return std::nullopt;
    const auto shape = shortener_.adopt(a.point, b.point, leg.path);
    if (!shape || !(shape->length > 0)) return std::nullopt;
    leg.shape = *shape;
    return leg;
  }

  const LineNetwork& network_;
  const Surface& s_;
  const IsGoal& is_goal_;
  const Takes& takes_;
  PathShortener& shortener_;
  size_t& left_;
  CancelToken& poll_;
  std::span<const WayEnd> ends_;
  std::vector<Place> places_;
  std::set<Cell> visited_;
  std::map<uint32_t, size_t> offers_;  // per node of a goal
  std::priority_queue<std::pair<double, size_t>, std::vector<std::pair<double, size_t>>, std::greater<>> queue_;
};

}  // namespace

bool find_way_out(const LineNetwork& network, std::span<const WayEnd> ends, const IsGoal& is_goal, const Takes& takes,
                  PathShortener& shortener, size_t& places, CancelToken& poll) {
  return WaySearch(network, is_goal, takes, shortener, places, poll).find(ends);
}

}  // namespace meander
