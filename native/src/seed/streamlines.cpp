// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/streamlines.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>
#include <optional>

#include "base/variation.h"
#include "geodesic/chart.h"
#include "seed/constants.h"
#include "seed/field_steps.h"
#include "seed/line_crowding.h"
#include "seed/start_places.h"

namespace meander {
namespace {

/// How much there is still to draw, and of which lines: with so much room beside them, and at least so long.
class LinesLeft {
 public:
  LinesLeft(const Surface& s, const RadiusField& radius, const LineSpacing& spacing)
      : s_(s), spacing_(spacing), wanted_(s.component_count(), 0), drawn_(s.component_count(), 0) {
    for (uint32_t f = 0; f < s.face_count(); ++f) {
      const double r = radius.at(s, make_point(f, 1, 1, 1));
      wanted_[s.component(f)] += spacing.full * s.face_area(f) / (spacing.apart * r * r);
    }
  }

  void begin(double apart, double shortest) {
    apart_ = apart;
    shortest_ = shortest;
  }
  double apart() const { return apart_; }
  double least_length() const { return shortest_ * spacing_.apart; }

  /// How long another line may be, in r: one that begins between others no longer than what is left to draw.
  double room(const SurfacePoint& p) const {
    const uint32_t component = s_.component(p.face);
    if (apart_ == spacing_.apart) return std::numeric_limits<double>::infinity();
    return wanted_[component] - drawn_[component] - spacing_.link;
  }
  bool is_full(const SurfacePoint& p) const { return room(p) < least_length(); }
  void take(const SurfacePoint& p, double length) { drawn_[s_.component(p.face)] += length + spacing_.link; }

 private:
  const Surface& s_;
  const LineSpacing& spacing_;
  std::vector<double> wanted_, drawn_;  // per component: length of its lines, in the local r
  double apart_ = 0, shortest_ = 0;
};

/// Places that are known to have no room for a line, with what is around them: the last one of each patch.
class CrowdedPlaces {
 public:
  explicit CrowdedPlaces(size_t patches) : of_patch_(patches) {}

  bool reach(const LineNetwork::Node& node) const {
    const Place& known = of_patch_[node.patch];
    return (node.place - known.place).norm() < known.around;
  }
  void add(const LineNetwork::Node& node, double crowding) {
    of_patch_[node.patch] = {node.place, kCrowdedAround * crowding};
  }

 private:
  struct Place {
    Vec3 place = Vec3::Zero();
    double around = 0;
  };
  std::vector<Place> of_patch_;
};

class Drawer {
 public:
  Drawer(const LineField& field, const RadiusField& radius, const LineSpacing& spacing, uint32_t variation,
         LineNetwork& network, ThreadPool& pool, CancelToken poll, std::vector<Streamline>& lines)
      : field_(field), steps_(network.surface(), field), radius_(radius), spacing_(spacing), variation_(variation),
        network_(network), s_(network.surface()), crowding_(spacing, network, lines.size()), pool_(pool), poll_(poll),
        shortener_(s_), lines_(lines), trunks_(lines.size()), left_(s_, radius, spacing),
        crowded_(network.patch_count()) {}

  void draw(std::span<const std::vector<SurfacePoint>> laid) {
    for (const Streamline& trunk : lines_) {
      offer_beside(trunk, spacing_.from_walls);
    }
    for (const std::vector<SurfacePoint>& points : laid) lay(points);
    offer_along_boundary();
    fill(spacing_.apart, kShortest);
    fill(spacing_.apart, kShortestAlone);
    // Where lines diverge: the widest gaps first, until there are as many lines as there is room for.
    for (double between = spacing_.apart - kNarrower; between > spacing_.between; between -= kNarrower) {
      fill_between(between);
    }
  }

 private:
  void fill(double apart, double shortest) {
    left_.begin(apart, shortest);
    draw_beside();
    // In an order that has nothing to do with that of the faces, so that lines begin all over the surface.
    const auto faces = static_cast<uint32_t>(s_.face_count());
    uint32_t stride = static_cast<uint32_t>(0.6180339887 * faces) | 1u;
    while (std::gcd(stride, faces) != 1) stride += 2;
    const auto first = static_cast<uint32_t>(share_of_variation(variation_) * faces);
    size_t ahead = kLeastAhead;
    for (uint32_t k = 0, f = first; k < faces;) {
      places_.clear();
      for (; k < faces && places_.size() < ahead; ++k, f = static_cast<uint32_t>((uint64_t{f} + stride) % faces)) {
        for_places_in_face(s_, f, radius_.at(s_, make_point(f, 1, 1, 1)), [&](const SurfacePoint& p) {
          places_.push_back({{p, Vec3::Zero(), kNone, kNone, 0, 0}, kUnknown});
        });
      }
      const size_t before = lines_.size();
      look_ahead();
      for (Place& place : places_) {
        poll_();
        if (lines_.size() != before) place.crowding = kUnknown;
        fill_at(place);
      }
      ahead = lines_.size() == before ? std::min(2 * ahead, kMostAhead) : std::max(ahead / 2, kLeastAhead);
    }
  }

  /// A place where a line may begin, and what is known of it.
  struct Place {
    LineNetwork::Node node;  // no more than its point where there is no room for a line
    double crowding;         // or kUnknown
  };
  static constexpr double kUnknown = -1;

  /// How crowded the places are with the lines that are there: at most of them none begins. It would not be known
  /// sooner on one thread.
  void look_ahead() {
    constexpr size_t kPlacesAtATime = 32;
    pool_.for_each(places_.size(), kPlacesAtATime, [&](uint32_t k) {
      Place& place = places_[k];
      if (left_.is_full(place.node.point)) return;
      place.node = network_.make_node(place.node.point, static_cast<uint32_t>(lines_.size()), 0);
      if (pool_.size() == 1 || crowded_.reach(place.node) || network_.beside_boundary(place.node.patch)) return;
      place.crowding = crowding_.at_start(place.node, left_.apart(), place.node.radius);
    });
  }

  void fill_at(Place& place) {
    if (left_.is_full(place.node.point)) return;
    LineNetwork::Node& node = place.node;
    node.line = static_cast<uint32_t>(lines_.size());
    if (crowded_.reach(node) || ends_at_once(node)) return;
    if (place.crowding == kUnknown) place.crowding = crowding_.at_start(node, left_.apart(), node.radius);
    if (place.crowding > 0) {
      crowded_.add(node, place.crowding);
      return;
    }
    begin_at(node);
    draw_beside();
  }

  /// Places beside the boundary, where the field runs along it. Across a stem, as of a letter, there are as many lines
  /// as bring the strands on both sides of each nearest to their spacing; elsewhere the outermost is half of `apart`
  /// away. (A closed curve crosses a stem an even number of times, so there is no way to have three strands.)
  void offer_along_boundary() {
    for (uint32_t i = 0; i < network_.nodes().size(); ++i) {
      const LineNetwork::Node node = network_.nodes()[i];
      if (node.line != LineNetwork::kBoundary) continue;
      const Vec2 direction = unit(field_.at(node.point));
      const auto across = [&](double distance) {
        Path path;
        return trace_geodesic(s_, node.point, Vec2{0, distance * node.radius} * direction, path);
      };
      for (const double side : {1.0, -1.0}) {
        if (across(-side * kAcrossBoundary).hit_boundary == across(side * kAcrossBoundary).hit_boundary) break;
        if (across(side * kAcrossBoundary).hit_boundary) continue;
        const Trace other = across(side * kWidthOfStem);
        const double width = other.length / node.radius;
        const double away = !other.hit_boundary       ? 0.5 * spacing_.apart
                            : width < kTwoAlongStrips ? 0.5 * width
                                                      : 0.25 * width;
        beside_.push_back(across(side * away).end);
      }
    }
  }

  void fill_between(double apart) {
    left_.begin(apart, kShortestBetween);
    for (size_t k = trunks_, before = lines_.size(); k < before; ++k) {
      if (left_.is_full(network_.nodes()[lines_[k].nodes[0]].point)) continue;
      offer_beside(lines_[k], apart);
      draw_beside();
    }
  }

  void draw_beside() {
    for (; !beside_.empty(); beside_.pop_front()) {
      const SurfacePoint& p = beside_.front();
      if (left_.is_full(p)) continue;
      const LineNetwork::Node node = network_.make_node(p, static_cast<uint32_t>(lines_.size()), 0);
      if (!ends_at_once(node) && !(crowding_.at_start(node, left_.apart(), 0) > 0)) begin_at(node);
    }
  }

  void begin_at(const LineNetwork::Node& first) {
    const SurfacePoint& p = first.point;
    const auto direction = steps_.from(p);
    if (!direction) return;
    const LineNetwork::Mark mark = network_.mark();
    const uint32_t start = network_.add_node(first);
    Streamline drawn;
    const double longest = left_.room(p);
    trace(start, -*direction, -1, longest, drawn.nodes);
    std::ranges::reverse(drawn.nodes);
    drawn.nodes.push_back(start);
    const double back = -network_.nodes()[drawn.nodes.front()].arc;
    trace(start, *direction, 1, longest - back, drawn.nodes);
    const double length = network_.nodes()[drawn.nodes.back()].arc + back;
    if (length < left_.least_length()) return network_.take_back(mark);
    offer_beside(drawn, left_.apart());
    left_.take(p, length);
    lines_.push_back(std::move(drawn));
  }

  /// Draws a line through points, in several where it has to end between.
  void lay(const std::vector<SurfacePoint>& points) {
    for (size_t k = 0; k < points.size();) {
      const LineNetwork::Mark mark = network_.mark();
      LineNetwork::Node node = network_.make_node(points[k], static_cast<uint32_t>(lines_.size()), 0);
      ++k;
      poll_();
      if (is_too_thin(node) || crowding_.ahead(node) > 0) continue;
      Streamline drawn;
      drawn.nodes.push_back(network_.add_node(node));
      for (; k < points.size() && go_on(points[k], drawn.nodes); ++k) poll_();
      const double length = network_.nodes()[drawn.nodes.back()].arc;
      if (length < kShortestLaid * spacing_.apart) {
        network_.take_back(mark);
        continue;
      }
      left_.take(node.point, length);
      lines_.push_back(std::move(drawn));
    }
  }

  /// Leads a line on to a point; false where it has to end.
  bool go_on(const SurfacePoint& p, std::vector<uint32_t>& nodes) {
    const uint32_t from = nodes.back();
    const LineNetwork::Node here = network_.nodes()[from];
    const LineNetwork::Node node = network_.make_node(p, here.line, here.arc + spacing_.step);
    if (crowding_.ahead(node) > 0) return false;
    Chart chart = Chart::at(here.point, here.place);
    if (!chart.advance_to(s_, p, node.place, 2 * spacing_.step * std::max(here.radius, node.radius))) return false;
    Path path;
    trace_geodesic(s_, here.point, chart.place, path);
    const auto shape = shortener_.adopt(here.point, p, path);
    if (!shape || !(shape->length > 0) || network_.touches(from, kNone, p, path)) return false;
    nodes.push_back(network_.add_node(node));
    network_.add_edge(from, nodes.back(), std::move(path), *shape);
    return true;
  }

  void offer_beside(const Streamline& line, double apart) {
    for (size_t k = 0; k < line.nodes.size(); k += kBesideEvery) offer_beside(network_.nodes()[line.nodes[k]], apart);
  }

  /// Places to both sides of a node where another line may begin.
  void offer_beside(const LineNetwork::Node& node, double apart) {
    const Vec2 direction = unit(field_.at(node.point));
    for (const double side : {1.0, -1.0}) {
      Path path;
      const Trace there =
          trace_geodesic(s_, node.point, Vec2{0, side * apart * node.radius} * direction, path);
      if (!there.hit_boundary) beside_.push_back(there.end);
    }
  }

  /// Follows the field from a node until the line has to end, or is as long as it may be, in r.
  void trace(uint32_t from, Vec2 direction, double sign, double longest, std::vector<uint32_t>& nodes) {
    const uint32_t line = network_.nodes()[from].line;
    const auto most = static_cast<size_t>(std::clamp(longest / spacing_.step, 0.0, double{kMostNodesOfLine}));
    for (size_t k = 0; k < most; ++k) {
      poll_();
      const LineNetwork::Node here = network_.nodes()[from];
      auto ahead = steps_.ahead(here.point, direction, spacing_.step * here.radius);
      if (!ahead) return;
      const LineNetwork::Node node = network_.make_node(ahead->end, line, here.arc + sign * spacing_.step);
      if (crowding_.ahead(node) > 0 || network_.touches(from, kNone, ahead->end, ahead->path)) return;
      const PathShape shape = measure_path(s_, here.point, ahead->end, ahead->path);
      if (!(shape.length > 0)) return;
      const uint32_t to = network_.add_node(node);
      network_.add_edge(from, to, std::move(ahead->path), shape);
      nodes.push_back(to);
      from = to;
      direction = ahead->direction;
    }
  }

  /// Whether a line along the field has the boundary on both sides, and hardly anything between.
  bool is_too_thin(const LineNetwork::Node& node) const {
    if (!network_.beside_boundary(node.patch)) return false;
    const Vec2 direction = unit(field_.at(node.point));
    double left = kTooThin * node.radius;
    for (const double side : {1.0, -1.0}) {
      Path path;
      const Trace across = trace_geodesic(s_, node.point, Vec2{0, side * left} * direction, path);
      if (!across.hit_boundary) return false;
      left -= across.length;
    }
    return true;
  }

  /// Whether a line through a place beside the boundary ends there before it is long enough, or has no room. To know
  /// what is near to a place takes much longer where thousands of teeth are, each far from all others along the
  /// surface.
  bool ends_at_once(const LineNetwork::Node& first) {
    if (!network_.beside_boundary(first.patch)) return false;
    if (is_too_thin(first)) return true;
    const auto along = steps_.from(first.point);
    const double least = left_.least_length();
    double length = 0;
    for (const double side : {1.0, -1.0}) {
      auto next = along ? steps_.ahead(first.point, side * *along, spacing_.step * first.radius) : std::nullopt;
      for (; next && length < least; poll_()) {
        length += spacing_.step;
        next = steps_.ahead(next->end, next->direction, spacing_.step * radius_.at(s_, next->end));
      }
    }
    return length < least;
  }

  const LineField& field_;
  FieldSteps steps_;
  const RadiusField& radius_;
  const LineSpacing& spacing_;
  uint32_t variation_;
  LineNetwork& network_;
  const Surface& s_;
  LineCrowding crowding_;
  ThreadPool& pool_;
  CancelToken poll_;
  PathShortener shortener_;
  std::vector<Streamline>& lines_;
  size_t trunks_;  // the first of them
  LinesLeft left_;
  CrowdedPlaces crowded_;
  std::deque<SurfacePoint> beside_;
  std::vector<Place> places_;
};

}  // namespace

void draw_streamlines(const LineField& field, const RadiusField& radius, const LineSpacing& spacing,
                      std::span<const std::vector<SurfacePoint>> laid, uint32_t variation, LineNetwork& network,
                      ThreadPool& pool, CancelToken poll, std::vector<Streamline>& lines) {
  if (!field.empty()) Drawer(field, radius, spacing, variation, network, pool, poll, lines).draw(laid);
}

}  // namespace meander
