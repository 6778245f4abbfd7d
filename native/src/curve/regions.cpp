// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <unordered_map>

#include "base/disjoint_sets.h"
#include "base/front_search.h"
#include "base/point_tree.h"
#include "curve/crossings.h"
#include "mesh/radius_field.h"

namespace meander {
namespace {

constexpr double kSampling = 0.5;      // distance of samples, in r
constexpr double kFarEnough = 2.5;     // in r: the first place this far from all guides is taken
constexpr double kLeastRoom = 0.5;     // in r
constexpr double kWorthALoop = 0.8;    // in r: narrower places are covered by the guides around
constexpr uint32_t kMostOnEdge = 64;   // samples on one edge, and rows of them in one face

/// Points along all guides, `step` apart at most.
std::vector<Vec3> points_along(const Surface& surface, const Curve& curve, const std::vector<Piece>& pieces,
                               const RadiusField& radius) {
  std::vector<Vec3> points;
  for (const Piece& p : pieces) {
    if (!curve.on_guide(p.segment)) continue;
    const SurfacePoint from{p.face, p.from}, to{p.face, p.to};
    const Vec3 a = position(surface, from), b = position(surface, to);
    const double step = kSampling * radius.at(surface, from);
    const double parts = std::max(1.0, std::min(1e6, std::ceil((b - a).norm() / step)));
    for (double k = 0; k <= parts; ++k) points.push_back(a + (b - a) * (k / parts));
  }
  return points;
}

/// The samples of all components with guides, joined where no guide is between them.
class Samples {
 public:
  Samples(const Surface& surface, const Curve& curve, const RadiusField& radius,
          const std::vector<Piece>& pieces, const PointTree& guides, const std::vector<uint8_t>& guided)
      : surface_(surface), radius_(radius), first_on_edge_(3 * surface.face_count(), kNone),
        on_edge_(3 * surface.face_count(), 0), first_inside_(surface.face_count(), kNone) {
    for (const Piece& p : pieces) {
      if (curve.on_guide(p.segment)) guides_[p.face].push_back(p);
    }
    for (uint32_t f = 0; f < surface.face_count(); ++f) {
      if (guided[surface.component(f)]) place(f);
    }
    for (const SurfacePoint& p : points_) {
      room_.push_back(std::sqrt(guides.nearest(position(surface, p))->squared_distance));
      relative_room_.push_back(room_.back() / radius.at(surface, p));
    }
    joined_ = DisjointSets(points_.size());
    for (uint32_t f = 0; f < surface.face_count(); ++f) {
      if (guided[surface.component(f)]) join(f);
    }
  }

  size_t size() const { return points_.size(); }
  const SurfacePoint& point(uint32_t i) const { return points_[i]; }
  uint32_t region(uint32_t i) { return joined_.find(i); }
  double room(uint32_t i) const { return room_[i]; }                    ///< to the nearest guide
  double relative_room(uint32_t i) const { return relative_room_[i]; }  ///< in r

  /// The samples of the shortest way over samples between two points.
  std::optional<std::vector<uint32_t>> way(const SurfacePoint& from, const SurfacePoint& to) const {
    const Vec3 goal = position(surface_, to);
    const auto place = [&](uint32_t i) { return position(surface_, points_[i]); };
    FrontSearch search{AllNodes(points_.size())};
    const auto reach = [&](uint32_t i, double cost, uint32_t by) {
      search.offer(i, cost, by, (place(i) - goal).norm());
    };
    const auto usable = [&](uint32_t i) { return relative_room_[i] >= kLeastRoom; };
    const Vec3 start = position(surface_, from);
    for (const auto& [i, b] : of_face(from.face)) {
      if (usable(i) && clear(from.face, from.b, b)) reach(i, (place(i) - start).norm(), kNone);
    }
    std::vector<uint8_t> last(points_.size(), 0);
    for (const auto& [i, b] : of_face(to.face)) last[i] = usable(i) && clear(to.face, to.b, b);
    while (const auto next = search.next()) {
      const uint32_t i = *next;
      if (last[i]) {
        std::vector<uint32_t> samples;
        for (uint32_t k = i; k != kNone; k = search.by(k)) samples.push_back(k);
        std::ranges::reverse(samples);
        return samples;
      }
      const Vec3 here = place(i);
      const double cost = search.cost(i);
      for (const uint32_t f : faces_of(i)) {
        const std::vector<Seen> seen = of_face(f);
        const auto self = std::ranges::find(seen, i, &Seen::first);
        for (const auto& [k, b] : seen) {
          if (search.done(k) || !usable(k) || !clear(f, self->second, b)) continue;
          reach(k, cost + (place(k) - here).norm(), i);
        }
      }
    }
    return std::nullopt;
  }

  /// The region of a point of a face, kNone where guides hide all samples from it.
  uint32_t region_of(const SurfacePoint& p) {
    std::vector<Seen> near = of_face(p.face);
    std::ranges::stable_sort(near, {}, [&](const Seen& s) { return norm(s.second - p.b); });
    for (const auto& [i, b] : near) {
      if (relative_room_[i] >= kLeastRoom && clear(p.face, p.b, b)) return region(i);
    }
    return kNone;
  }

 private:
  using Seen = std::pair<uint32_t, Vec2>;  // a sample, and where it is in a face

  double longest(uint32_t f) const {
    double l = 0;
    for (uint32_t k = 0; k < 3; ++k) l = std::max(l, norm(surface_.corner(f, next_corner(k)) - surface_.corner(f, k)));
    return l;
  }
  uint32_t count_for(double length, double r) const {
    return static_cast<uint32_t>(std::clamp(std::ceil(length / (kSampling * r)), 1.0, double{kMostOnEdge}));
  }
  double share(HalfEdge e, uint32_t k) const { return clear_of_ends((k + 0.5) / on_edge_[e]); }

  void place(uint32_t f) {
    const SurfacePoint middle = make_point(f, 1.0 / 3, 1.0 / 3, 1.0 / 3);
    const double r = radius_.at(surface_, middle);
    for (uint32_t k = 0; k < 3; ++k) {
      const HalfEdge e = 3 * f + k, twin = surface_.twin(e);
      if (twin == kNone || first_on_edge_[twin] != kNone) continue;  // or seen from the other side
      first_on_edge_[e] = static_cast<uint32_t>(points_.size());
      on_edge_[e] = count_for(norm(surface_.corner(f, next_corner(k)) - surface_.corner(f, k)), r);
      for (uint32_t i = 0; i < on_edge_[e]; ++i) {
        const Vec2 b = on_edge(e, share(e, i));
        points_.push_back(make_point(f, 1 - b.x - b.y, b.x, b.y));
      }
    }
    first_inside_[f] = static_cast<uint32_t>(points_.size());
    const uint32_t rows = guides_.contains(f) ? count_for(longest(f), r) : 1;
    for (uint32_t i = 0; i < rows; ++i) {
      for (uint32_t j = 0; i + j < rows; ++j) {
        const double x = (i + 1.0 / 3) / rows, y = (j + 1.0 / 3) / rows;
        points_.push_back(make_point(f, 1 - x - y, x, y));
      }
    }
    inside_count_.resize(surface_.face_count(), 0);
    inside_count_[f] = rows * (rows + 1) / 2;
  }

  /// The samples of a face, where they are in it: those of its inner edges first. Between the end of
  /// a guide at the boundary and the boundary itself there is always some rounding to slip through.
  std::vector<Seen> of_face(uint32_t f) const {
    std::vector<Seen> seen;
    for (uint32_t k = 0; k < 3; ++k) {
      const HalfEdge e = 3 * f + k, twin = surface_.twin(e);
      if (twin == kNone) continue;
      const bool own = first_on_edge_[e] != kNone;
      const HalfEdge owner = own ? e : twin;
      for (uint32_t i = 0; i < on_edge_[owner]; ++i) {
        const double t = share(owner, i);
        seen.push_back({first_on_edge_[owner] + i, on_edge(e, own ? t : 1 - t)});
      }
    }
    for (uint32_t i = 0; i < inside_count_[f]; ++i) {
      const uint32_t sample = first_inside_[f] + i;
      seen.push_back({sample, points_[sample].b});
    }
    return seen;
  }
  /// One face, or the two at an edge.
  std::vector<uint32_t> faces_of(uint32_t i) const {
    const uint32_t f = points_[i].face;
    for (uint32_t k = 0; k < 3; ++k) {
      const HalfEdge e = 3 * f + k;
      if (first_on_edge_[e] != kNone && i - first_on_edge_[e] < on_edge_[e]) return {f, face_of(surface_.twin(e))};
    }
    return {f};
  }
  bool clear(uint32_t f, Vec2 from, Vec2 to) const {
    const auto found = guides_.find(f);
    if (found == guides_.end()) return true;
    const Piece way{f, kNone, from, to};
    return std::ranges::none_of(found->second, [&](const Piece& guide) { return touch(way, guide); });
  }

  void join(uint32_t f) {
    std::vector<Seen> seen = of_face(f);
    // What is nearer to a guide only serves to slip past its end.
    std::erase_if(seen, [&](const Seen& s) { return relative_room_[s.first] < kLeastRoom; });
    if (!guides_.contains(f)) {
      for (const auto& [i, b] : seen) joined_.join(seen[0].first, i);
      return;
    }
    // Neighbours only: a row apart at most in each of the three weights. Far ones gain nothing.
    const uint32_t rows = static_cast<uint32_t>(std::lround(std::sqrt(2.0 * inside_count_[f] + 0.25) - 0.5));
    const double reach = 1.01 / rows;
    std::vector<uint32_t> order(seen.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](uint32_t p, uint32_t q) {
      return seen[p].second.x != seen[q].second.x ? seen[p].second.x < seen[q].second.x : p < q;
    });
    for (size_t p = 0; p < order.size(); ++p) {
      const Seen& a = seen[order[p]];
      for (size_t q = p + 1; q < order.size(); ++q) {
        const Seen& b = seen[order[q]];
        const Vec2 d = b.second - a.second;
        if (d.x > reach) break;
        if (std::abs(d.y) > reach || std::abs(d.x + d.y) > reach) continue;
        if (joined_.find(a.first) != joined_.find(b.first) && clear(f, a.second, b.second)) {
          joined_.join(a.first, b.first);
        }
      }
    }
  }

  const Surface& surface_;
  const RadiusField& radius_;
  std::unordered_map<uint32_t, std::vector<Piece>> guides_;  // per face that holds any
  std::vector<uint32_t> first_on_edge_, on_edge_;            // per half-edge; those of its twin: kNone, 0
  std::vector<uint32_t> first_inside_, inside_count_;        // per face
  std::vector<SurfacePoint> points_;
  std::vector<double> room_, relative_room_;                 // per point
  DisjointSets joined_{0};
};

SurfacePoint middle_of(uint32_t face) { return make_point(face, 1.0 / 3, 1.0 / 3, 1.0 / 3); }

/// The faces of every component, in order.
class FacesOfComponents {
 public:
  explicit FacesOfComponents(const Surface& surface)
      : first_(surface.component_count() + 1, 0), faces_(surface.face_count()) {
    for (uint32_t f = 0; f < surface.face_count(); ++f) ++first_[surface.component(f) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<uint32_t> next = first_;
    for (uint32_t f = 0; f < surface.face_count(); ++f) faces_[next[surface.component(f)]++] = f;
  }
  std::span<const uint32_t> of(uint32_t component) const {
    return {faces_.data() + first_[component], faces_.data() + first_[component + 1]};
  }

 private:
  std::vector<uint32_t> first_, faces_;
};

/// Of the middles of some faces the one that is farthest from the boundary, or `otherwise`.
SurfacePoint farthest_from(const Surface& surface, const PointTree& boundary, std::span<const uint32_t> faces,
                           const SurfacePoint& otherwise) {
  SurfacePoint best = otherwise;
  double most = 0;
  for (const uint32_t f : faces) {
    const auto nearest = boundary.nearest(position(surface, middle_of(f)));
    if (!nearest || nearest->squared_distance <= most) continue;
    most = nearest->squared_distance;
    best = middle_of(f);
  }
  return best;
}

}  // namespace

std::vector<Region> find_regions(const Surface& surface, const Curve& curve, const RadiusField& radius,
                                 const PointTree* boundary, double border) {
  constexpr double kInsideBorder = 0.15;  // of r: clear of an outline that runs at the border's distance
  const auto in_border = [&](const SurfacePoint& p) {
    if (!boundary) return false;
    const double near = (border + kInsideBorder) * radius.at(surface, p);
    return boundary->nearest(position(surface, p), near * near).has_value();
  };
  std::vector<uint8_t> guided(surface.component_count(), 0), growing(surface.component_count(), 0);
  for (const Strand& s : curve.strands) {
    (s.guide ? guided : growing)[surface.component(curve.nodes[s.first].face)] = 1;
  }
  std::vector<Piece> pieces;
  if (curve.has_guides()) curve.pieces(pieces);
  const PointTree guides(points_along(surface, curve, pieces, radius));
  Samples samples(surface, curve, radius, pieces, guides, guided);

  std::vector<Region> regions;
  std::unordered_map<uint32_t, std::vector<uint32_t>> members;  // of a region of samples, in order
  std::vector<std::vector<uint32_t>> of_component(surface.component_count());
  for (uint32_t i = 0; i < samples.size(); ++i) {
    std::vector<uint32_t>& list = members[samples.region(i)];
    if (list.empty()) of_component[surface.component(samples.point(i).face)].push_back(samples.region(i));
    list.push_back(i);
  }
  std::vector<uint8_t> grows(samples.size(), 0);
  for (const Strand& s : curve.strands) {
    if (s.guide || !guided[surface.component(curve.nodes[s.first].face)]) continue;
    for (uint32_t i = s.first; i < s.end(); ++i) {
      const uint32_t region = samples.region_of(curve.nodes[i]);
      if (region == kNone) continue;  // close beside a guide
      grows[region] = 1;
      break;
    }
  }

  std::optional<FacesOfComponents> faces;  // made when they are needed first
  std::vector<uint8_t> seen(surface.component_count(), 0);
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    const uint32_t c = surface.component(f);
    if (seen[c]) continue;
    seen[c] = 1;
    if (!guided[c]) {
      const double infinity = std::numeric_limits<double>::infinity();
      SurfacePoint middle = middle_of(f);
      // Only where a strip along the boundary is to stay empty: r from it a loop may well begin.
      if (border > 1 && in_border(middle)) {
        if (!faces) faces.emplace(surface);
        middle = farthest_from(surface, *boundary, faces->of(c), middle);
      }
      regions.push_back({middle, infinity, false, growing[c] != 0});
      continue;
    }
    for (const uint32_t root : of_component[c]) {
      Region region{{}, 0, true, grows[root] != 0};
      double most = 0;  // room in units of r
      for (const uint32_t i : members[root]) {
        if (samples.relative_room(i) <= most || in_border(samples.point(i))) continue;
        most = samples.relative_room(i);
        region.middle = samples.point(i);
        region.room = samples.room(i);
        if (most >= kFarEnough) break;
      }
      if (most >= kWorthALoop) regions.push_back(region);
    }
  }
  return regions;
}

std::optional<std::vector<SurfacePoint>> way_round_guides(const Surface& surface, const Curve& curve,
                                                          const RadiusField& radius,
                                                          const SurfacePoint& from, const SurfacePoint& to) {
  std::vector<uint8_t> guided(surface.component_count(), 0);
  guided[surface.component(from.face)] = 1;
  std::vector<Piece> pieces;
  curve.pieces(pieces);
  const PointTree guides(points_along(surface, curve, pieces, radius));
  const Samples samples(surface, curve, radius, pieces, guides, guided);
  const auto way = samples.way(from, to);
  if (!way) return std::nullopt;
  std::vector<SurfacePoint> places;
  for (const uint32_t i : *way) places.push_back(samples.point(i));
  return places;
}

}  // namespace meander
