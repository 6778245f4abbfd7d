// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/strips.h"

#include <cmath>
#include <numeric>

#include "base/front_search.h"

namespace meander {
namespace {

/// The farthest two places of a strip with two ends are at least so far apart, over its length; those of a fork with
/// three equal arms are at two thirds of that, and those of a ring at half.
constexpr double kEndToEnd = 0.75;

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
