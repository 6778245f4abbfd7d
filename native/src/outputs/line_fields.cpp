// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/line_fields.h"

#include "base/disjoint_sets.h"

namespace meander {
namespace {

/// Pieces of work that a face counts for whose place is found.
constexpr size_t kPlace = 16;

}  // namespace

LineFields::LineFields(const CutMesh& mesh, const LineDistance& distance, CancelToken poll)
    : mesh_(mesh), faces_(mesh.faces().size()), parted_(mesh.surface().component_count(), 1) {
  find_places(distance, poll);
  find_regions(poll);
  find_sides(poll);
}

/// A face belongs to the turn of its corner that is nearest to the line, but to that of a corner between turns only if
/// it has no other one; what the other corners know of that turn follows from there.
void LineFields::find_places(const LineDistance& distance, CancelToken& poll) {
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    poll(kPlace);
    const CutMesh::Face& face = mesh_.faces()[f];
    uint32_t chosen = 3 * f;
    int most = -1;
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t c = 3 * f + k;
      const int agree = distance.one_sheet(c, 3 * f + next_corner(k)) + distance.one_sheet(c, 3 * f + prev_corner(k));
      const bool nearer = distance.in_face(c).distance < distance.in_face(chosen).distance;
      if (agree > most || (agree == most && nearer)) {
        most = agree;
        chosen = c;
      }
    }
    const NearestOnLine n = distance.in_face(chosen);
    if (n.strand == kNone) continue;
    FaceLine& line = faces_[f];
    line.strand = mesh_.strands()[n.strand].strand;
    line.nearest_side = n.side;
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t c = 3 * f + k;
      NearestOnLine here = distance.in_face(c);
      if (c != chosen && !distance.one_sheet(chosen, c)) {
        const Vec3 from = mesh_.position(face.vertices[chosen % 3]), x = mesh_.position(face.vertices[k]);
        here = distance.beside(n, x, face.origin, (x - from).norm());
      }
      line.along[k] = n.along + distance.between(n, here);
      line.distance[k] = here.distance;
    }
  }
}

void LineFields::find_regions(CancelToken& poll) {
  DisjointSets joined(faces_.size());
  for (uint32_t e = 0; e < mesh_.twins().size(); ++e) {
    poll();
    const uint32_t twin = mesh_.twins()[e];
    if (twin != kNone && twin > e && mesh_.line_side(e) == 0) joined.join(e / 3, twin / 3);
  }
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    poll();
    const uint32_t first = joined.find(f);
    faces_[f].region = first == f ? region_count_++ : faces_[first].region;
  }
}

/// Crosses the line from region to region and changes the side each time; the left of the first edge met is 1.
void LineFields::find_sides(CancelToken& poll) {
  std::vector<std::vector<std::pair<uint32_t, uint32_t>>> beside(region_count_);  // regions, and the edge between
  for (uint32_t e = 0; e < mesh_.twins().size(); ++e) {
    poll();
    if (mesh_.line_side(e) == 0) continue;
    beside[faces_[e / 3].region].emplace_back(faces_[mesh_.twins()[e] / 3].region, e);
  }
  std::vector<int8_t> side(region_count_, 0);
  const auto component = [&](uint32_t edge) { return mesh_.surface().component(mesh_.faces()[edge / 3].origin); };
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
          parted_[component(edge)] = 0;
        }
      }
    }
  }
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    faces_[f].side = sides_differ(f) ? side[faces_[f].region] : faces_[f].nearest_side;
  }
}

}  // namespace meander
