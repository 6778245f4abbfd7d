// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/line_fields.h"

#include <algorithm>
#include <tuple>

#include "base/disjoint_sets.h"

namespace meander {
namespace {

/// Pieces of work that a face counts for whose place is found.
constexpr size_t kPiecesPerPlace = 16;

}  // namespace

LineFields::LineFields(const CutMesh& mesh, const LineDistance& distance, CancelToken poll)
    : mesh_(mesh), faces_(mesh.face_count()), parted_(mesh.surface().component_count(), 1) {
  find_places(distance, poll);
  find_regions(poll);
  find_sides(poll);
}

/// A face belongs to the turn of its corner that is nearest to the line, of equal ones that which comes first on the
/// line, but to that of a corner between turns only if it has no other one; what the other corners know of that turn
/// follows from there.
void LineFields::find_places(const LineDistance& distance, CancelToken& poll) {
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    poll(kPiecesPerPlace);
    const std::array<HalfEdge, 3> corners = mesh_.corners(f);
    int agree[3] = {0, 0, 0};
    for (uint32_t k = 0; k < 3; ++k) {
      const bool together = distance.one_sheet(corners[k], corners[next_corner(k)]);
      agree[k] += together;
      agree[next_corner(k)] += together;
    }
    const auto rank = [&](uint32_t k) {
      const NearestOnLine n = distance.in_face(corners[k]);
      return std::tuple(-agree[k], n.distance, n.strand, n.along);
    };
    constexpr std::array<uint32_t, 3> kAll{0, 1, 2};
    const HalfEdge chosen = corners[*std::ranges::min_element(kAll, {}, rank)];
    const NearestOnLine n = distance.in_face(chosen);
    if (n.strand == kNone) continue;
    FaceLine& line = faces_[f];
    line.strand = mesh_.strands()[n.strand].strand;
    line.nearest_side = n.side;
    for (uint32_t k = 0; k < 3; ++k) {
      const HalfEdge c = corners[k];
      NearestOnLine here = distance.in_face(c);
      if (c != chosen && !distance.one_sheet(chosen, c)) {
        here = distance.beside(chosen, mesh_.position(mesh_.from(c)));
      }
      line.along[k] = n.along + distance.between(n, here);
      line.distance[k] = here.distance;
    }
  }
}

void LineFields::find_regions(CancelToken& poll) {
  DisjointSets joined(faces_.size());
  for (HalfEdge h = 0; h < mesh_.half_edge_count(); h += 2) {
    poll();
    const uint32_t left = mesh_.face(h), right = mesh_.face(CutMesh::opposite(h));
    if (left != kNone && right != kNone && mesh_.line_side(h) == 0) joined.join(left, right);
  }
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    poll();
    const uint32_t first = joined.find(f);
    faces_[f].region = first == f ? region_count_++ : faces_[first].region;
  }
}

/// Crosses the line from region to region and changes the side each time; the left of the first edge met is 1. Edges
/// are met in the order of the surface's faces.
void LineFields::find_sides(CancelToken& poll) {
  std::vector<std::pair<uint32_t, HalfEdge>> line;  // by the face of the surface
  for (HalfEdge h = 0; h < mesh_.half_edge_count(); ++h) {
    poll();
    if (mesh_.line_side(h) != 0) line.emplace_back(mesh_.origin(mesh_.face(h)), h);
  }
  std::sort(line.begin(), line.end(), [&poll](const auto& a, const auto& b) {
    poll();
    return a < b;
  });
  std::vector<std::vector<std::pair<uint32_t, HalfEdge>>> beside(region_count_);  // regions, and the edge between
  for (const auto& [origin, h] : line) {
    poll();
    beside[region(h)].emplace_back(region(CutMesh::opposite(h)), h);
  }
  std::vector<int8_t> side(region_count_, 0);
  std::vector<uint32_t> queue;
  for (uint32_t first = 0; first < region_count_; ++first) {
    if (side[first] != 0 || beside[first].empty()) continue;
    side[first] = static_cast<int8_t>(mesh_.line_side(beside[first].front().second));
    queue.assign(1, first);
    while (!queue.empty()) {
      const uint32_t region = queue.back();
      queue.pop_back();
      for (const auto& [other, edge] : beside[region]) {
        poll();
        if (side[other] == 0) {
          side[other] = static_cast<int8_t>(-side[region]);
          queue.push_back(other);
        } else if (side[other] == side[region]) {
          parted_[component(mesh_.face(edge))] = 0;
        }
      }
    }
  }
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    faces_[f].side = sides_differ(f) ? side[faces_[f].region] : faces_[f].nearest_side;
  }
}

}  // namespace meander
