// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/strips.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/front_search.h"
#include "base/segment_distance.h"
#include "base/variation.h"
#include "mesh/constants.h"
#include "mesh/surface_point.h"

namespace meander {
namespace {

/// The vertices that share an edge with each.
struct Neighbours {
  std::vector<uint32_t> first, all;

  explicit Neighbours(const Surface& surface) : first(surface.vertex_count() + 1, 0) {
    const auto for_edges = [&](const auto& visit) {
      for (uint32_t f = 0; f < surface.face_count(); ++f) {
        const Triangle& t = surface.face(f);
        for (uint32_t k = 0; k < 3; ++k) visit(t[k], t[(k + 1) % 3]);
      }
    };
    for_edges([&](uint32_t a, uint32_t b) { ++first[a + 1], ++first[b + 1]; });
    std::partial_sum(first.begin(), first.end(), first.begin());
    all.resize(first.back());
    std::vector<uint32_t> next = first;
    for_edges([&](uint32_t a, uint32_t b) { all[next[a]++] = b, all[next[b]++] = a; });
  }
};

/// The last vertex of each component that a front from these reaches, and how far it is.
struct Farthest {
  std::vector<uint32_t> vertex;
  std::vector<double> distance;
};
Farthest farthest_from(const Surface& surface, const Neighbours& neighbours, const std::vector<uint32_t>& component,
                       const std::vector<uint32_t>& starts) {
  FrontSearch<AllNodes> search(AllNodes(surface.vertex_count()));
  for (const uint32_t v : starts) {
    if (v != kNone) search.offer(v, 0);
  }
  Farthest found{starts, std::vector<double>(starts.size(), 0)};
  while (const auto v = search.next()) {
    found.vertex[component[*v]] = *v;
    found.distance[component[*v]] = search.cost(*v);
    for (uint32_t k = neighbours.first[*v]; k < neighbours.first[*v + 1]; ++k) {
      const uint32_t other = neighbours.all[k];
      search.offer(other, search.cost(*v) + (surface.position(other) - surface.position(*v)).norm());
    }
  }
  return found;
}

/// Places of each component that is a long strip by its area, as many in each kStripPlaces-th of that.
std::vector<std::vector<Vec3>> places_in(const Surface& surface, const std::vector<Strip>& strips,
                                         const std::vector<double>& area) {
  std::vector<std::vector<Vec3>> places(strips.size());
  std::vector<double> passed(strips.size(), 0);
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    const uint32_t k = surface.component(f);
    if (!strips[k].is_long()) continue;
    passed[k] += surface.face_area(f);
    while (places[k].size() < kStripPlaces &&
           (static_cast<double>(places[k].size()) + 0.5) * area[k] < kStripPlaces * passed[k]) {
      const auto number = static_cast<uint32_t>(places[k].size());
      double u = number_of_variation(1, number), v = number_of_variation(2, number);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      places[k].push_back(position(surface, SurfacePoint{f, {u, v}}));
    }
  }
  return places;
}

/// Whether more of these places are deep inside than of a strip so wide.
bool has_depth(const Surface& surface, const std::vector<Vec3>& places, const std::vector<HalfEdge>& boundary,
               double width) {
  uint32_t deep = 0;
  constexpr uint32_t kMost = kMostDeepPlaces;
  for (uint32_t n = 0; n < places.size() && deep <= kMost && deep + places.size() > kMost + n; ++n) {
    deep += std::ranges::none_of(boundary, [&](HalfEdge e) {
      const Triangle& t = surface.face(face_of(e));
      const Vec3 &from = surface.position(t[corner_of(e)]), &to = surface.position(t[next_corner(corner_of(e))]);
      return distance_to_segment(places[n], from, to) < kDeepInStrip * width;
    });
  }
  return deep > kMost;
}

}  // namespace

std::vector<Strip> strips_of(const Surface& surface) {
  std::vector<double> area(surface.component_count(), 0), edge(surface.component_count(), 0);
  for (uint32_t f = 0; f < surface.face_count(); ++f) area[surface.component(f)] += surface.face_area(f);
  for (const HalfEdge e : surface.boundary()) edge[surface.component(face_of(e))] += norm(surface.along(e));
  std::vector<Strip> strips(area.size());
  for (size_t k = 0; k < area.size(); ++k) {
    const double mean = edge[k] / 4, apart = mean * mean - area[k];
    if (!(apart > 0)) continue;
    const double width = mean - std::sqrt(apart);
    strips[k] = {width, 2 * mean - width};
  }
  const std::vector<std::vector<Vec3>> places = places_in(surface, strips, area);
  std::vector<std::vector<HalfEdge>> boundary(strips.size());
  for (const HalfEdge e : surface.boundary()) {
    const uint32_t k = surface.component(face_of(e));
    if (strips[k].is_long()) boundary[k].push_back(e);
  }
  for (size_t k = 0; k < strips.size(); ++k) {
    if (has_depth(surface, places[k], boundary[k], strips[k].width)) strips[k] = {};
  }
  return strips;
}

std::vector<uint8_t> with_two_ends(const Surface& surface, const std::vector<Strip>& strips) {
  std::vector<uint32_t> component(surface.vertex_count(), 0), starts(strips.size(), kNone);
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    const uint32_t k = surface.component(f);
    for (const uint32_t v : surface.face(f)) component[v] = k;
    if (strips[k].width < std::numeric_limits<double>::infinity()) starts[k] = surface.face(f)[0];
  }
  const Neighbours neighbours(surface);
  const Farthest end = farthest_from(surface, neighbours, component, starts);
  const Farthest other = farthest_from(surface, neighbours, component, end.vertex);
  std::vector<uint8_t> two(strips.size(), 0);
  for (size_t k = 0; k < strips.size(); ++k) {
    two[k] = starts[k] != kNone && other.distance[k] > kEndToEnd * strips[k].length;
  }
  return two;
}

}  // namespace meander
