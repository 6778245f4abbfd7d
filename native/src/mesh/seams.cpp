// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/seams.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/point_grid.h"
#include "mesh/constants.h"
#include "mesh/repairs.h"
#include "mesh/sheets.h"

namespace meander {
namespace {

/// Per vertex its place: those near each other on the boundary share one, named by the lowest of them.
std::vector<uint32_t> places_of(const FaceBoundary& boundary) {
  std::vector<uint32_t> place(boundary.positions.size());
  std::iota(place.begin(), place.end(), 0u);
  CancelToken poll = boundary.poll;
  poll.now();
  const PointGrid grid(boundary.points, std::max(boundary.farthest, 1e-8 * boundary.extent), poll);
  for (size_t i = 0; i < boundary.vertices.size(); ++i) {
    poll(4);
    const uint32_t v = boundary.vertices[i];
    if (place[v] != v) continue;  // in the place of a lower one
    grid.near(boundary.points[i], boundary.reach[i], [&](uint32_t j, double squared) {
      const uint32_t w = boundary.vertices[j];
      if (w > v && place[w] == w && squared < boundary.reach[j] * boundary.reach[j]) place[w] = v;
    });
  }
  return place;
}

/// The half-edges that are alone on their edge, rising.
std::vector<uint32_t> boundary_of(Soup& soup) {
  std::vector<uint8_t> alone(3 * soup.faces().size(), 0);
  soup.edges()->for_each(soup.poll(), [&](const VertexPair&, EdgeSides sides) {
    if (sides.size() == 1) alone[sides[0].half_edge] = 1;
  });
  std::vector<uint32_t> boundary;
  CancelToken poll = soup.poll();
  for (uint32_t e = 0; e < alone.size(); ++e) {
    poll();
    if (alone[e]) boundary.push_back(e);
  }
  return boundary;
}

}  // namespace

FaceBoundary::FaceBoundary(Soup& soup, double distance)
    : FaceBoundary(soup.positions(), soup.faces(), boundary_of(soup), distance, soup.poll()) {}

FaceBoundary::FaceBoundary(std::span<const Eigen::Vector3d> at, std::span<const Triangle> of,
                           std::vector<uint32_t> alone, double distance, const CancelToken& cancel)
    : positions(at), faces(of), half_edges(std::move(alone)), poll(cancel) {
  if (half_edges.empty()) return;
  std::vector<uint8_t> there(positions.size(), 0);
  for (const uint32_t e : half_edges) {
    poll();
    there[from(faces, e)] = there[to(faces, e)] = 1;
  }
  std::vector<double> shortest(positions.size(), std::numeric_limits<double>::infinity());
  for (uint32_t e = 0; e < 3 * faces.size(); ++e) {
    poll();
    const uint32_t a = from(faces, e), b = to(faces, e);
    if (!there[a] && !there[b]) continue;
    const double length = (positions[a] - positions[b]).norm();
    shortest[a] = std::min(shortest[a], length);
    shortest[b] = std::min(shortest[b], length);
  }
  for (uint32_t v = 0; v < there.size(); ++v) {
    if (!there[v]) continue;
    poll(4);
    vertices.push_back(v);
    points.push_back(positions[v] - positions[vertices[0]]);
    extent = std::max(extent, points.back().cwiseAbs().maxCoeff());
    reach.push_back(std::min(distance, kMostSeam * shortest[v]));
    farthest = std::max(farthest, reach.back());
  }
}

std::vector<Seam> find_seams(const FaceBoundary& boundary) {
  std::vector<Seam> seams;
  if (!(boundary.farthest > 0)) return seams;
  const auto faces = boundary.faces;
  const auto& sides = boundary.half_edges;
  const std::vector<uint32_t> place = places_of(boundary);
  const auto ends = [&](uint32_t i) { return pair_of(place[from(faces, sides[i])], place[to(faces, sides[i])]); };
  ThreadPool pool = ThreadPool(1).with(boundary.poll);
  std::vector<uint8_t> taken(sides.size(), 0);
  std::vector<std::tuple<bool, double, uint32_t, uint32_t>> pairs;  // in the same direction, turn, which of the sides
  const EdgeGroups edges(sides.size(), place.size(), ends, pool);
  edges.for_each(boundary.poll, [&](const VertexPair& edge, EdgeSides group) {
    if (group.size() < 2 || group.size() > kMostAtEdge) return;
    pairs.clear();
    for (size_t k = 0; k < group.size(); ++k) {
      for (size_t l = k + 1; l < group.size(); ++l) {
        const uint32_t one = sides[group[k].half_edge], other = sides[group[l].half_edge];
        const bool along = place[from(faces, one)] == place[from(faces, other)];
        const double turn = turn_at_edge(boundary.positions, edge, apex(faces, one), apex(faces, other));
        if (turn < (along ? 1 : kOnEachOther)) pairs.emplace_back(along, turn, group[k].half_edge, group[l].half_edge);
      }
    }
    std::ranges::sort(pairs);
    for (const auto& [along, turn, one, other] : pairs) {
      if (taken[one] || taken[other]) continue;
      taken[one] = taken[other] = 1;
      seams.push_back({sides[one], sides[other], !along});
    }
  });
  return seams;
}

bool weld_seams(Soup& soup, double distance, PrepareCounts& counts) {
  const std::vector<Seam> seams = find_seams(FaceBoundary(soup, distance));
  DisjointSets sets(soup.positions().size());
  for (const Seam& seam : seams) {
    const auto f = soup.faces();
    sets.join(from(f, seam.one), seam.opposed ? to(f, seam.other) : from(f, seam.other));
    sets.join(to(f, seam.one), seam.opposed ? from(f, seam.other) : to(f, seam.other));
  }
  counts.welded_edges += static_cast<uint32_t>(seams.size());
  counts.dropped_faces += soup.rename([&](uint32_t v) { return sets.find(v); });
  return !seams.empty();
}

}  // namespace meander
