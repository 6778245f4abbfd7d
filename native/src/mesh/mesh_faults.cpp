// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/mesh_faults.h"

#include <algorithm>

#include "mesh/constants.h"
#include "mesh/mesh_check.h"
#include "mesh/repairs.h"
#include "mesh/seams.h"
#include "mesh/sheets.h"

namespace meander {
namespace {

/// The passes of a preparation, run dry: each names what it would repair, and only what is no part of a surface at all
/// is left out for the ones behind.
class FaultSearch {
 public:
  FaultSearch(Soup& soup, double weld_distance) : soup_(soup) {
    add_infinite();
    soup_.measure();
    add_and_leave_out(FaultKind::kNoArea, faces_without_area(soup_, kFlatFace));
    add_and_leave_out(FaultKind::kDoubledFace, doubled_faces(soup_));
    add_sheets(find_sheets(soup_, true));
    if (weld_distance > 0) add_seams(FaceBoundary(soup_, weld_distance));
  }

  std::vector<MeshFault> faults;

 private:
  void add(FaultKind kind, uint32_t element, uint32_t element2) { faults.push_back({kind, element, element2}); }

  void add_infinite() {
    const std::vector<uint8_t> used = soup_.used();
    const auto is_infinite = [&](uint32_t v) { return !soup_.positions()[v].allFinite(); };
    CancelToken poll = soup_.poll();
    for (uint32_t v = 0; v < used.size(); ++v) {
      poll();
      if (used[v] && is_infinite(v)) add(FaultKind::kNotFinite, v, v);
    }
    if (faults.empty()) return;
    soup_.leave_out_where([&](uint32_t f) { return std::ranges::any_of(soup_.faces()[f], is_infinite); });
  }

  void add_and_leave_out(FaultKind kind, const std::vector<uint32_t>& faces) {
    for (const uint32_t f : faces) add(kind, soup_.source(f), soup_.source(f));
    soup_.leave_out(faces);
  }

  void add_sheets(const Sheets& sheets) {
    for (const VertexPair& e : sheets.crowded) add(FaultKind::kCrowdedEdge, e[0], e[1]);
    for (const uint32_t v : bow_ties(soup_, sheets)) add(FaultKind::kBowTie, v, v);
    for (const VertexPair& e : sheets.opened) add(FaultKind::kOneSided, e[0], e[1]);
  }

  void add_seams(const FaceBoundary& boundary) {
    soup_.forget_edges();  // the grids of points take more memory than all else
    std::vector<VertexPair> edges;
    for (const Seam& seam : find_seams(boundary)) {
      for (const uint32_t e : {seam.one, seam.other}) edges.push_back(edge(soup_.faces(), e));
    }
    for (const EdgeSplit& split : find_edge_splits(boundary)) edges.push_back(edge(soup_.faces(), split.side));
    CancelToken poll = soup_.poll();
    std::ranges::sort(edges, [&](const VertexPair& a, const VertexPair& b) { return poll(), a < b; });
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    faults.reserve(faults.size() + edges.size());
    for (const VertexPair& e : edges) {
      poll();
      add(FaultKind::kSeam, e[0], e[1]);
    }
  }

  Soup& soup_;
};

}  // namespace

std::vector<MeshFault> find_faults(std::span<const double> vertices, std::span<const uint32_t> faces,
                                   double weld_distance, const CancelToken& cancel) {
  check_indices(vertices.size() / 3, faces);
  Soup soup(vertices, faces, cancel);
  return FaultSearch(soup, weld_distance).faults;
}

bool has_seams(std::span<const double> vertices, std::span<const uint32_t> faces, std::vector<uint32_t> half_edges,
               double weld_distance, const CancelToken& cancel) {
  if (half_edges.empty()) return false;
  std::vector<Eigen::Vector3d> positions(vertices.size() / 3);
  std::vector<Triangle> triangles(faces.size() / 3);
  for (size_t v = 0; v < positions.size(); ++v) positions[v] = Eigen::Vector3d::Map(&vertices[3 * v]);
  for (size_t f = 0; f < triangles.size(); ++f) triangles[f] = {faces[3 * f], faces[3 * f + 1], faces[3 * f + 2]};
  const FaceBoundary boundary(positions, triangles, std::move(half_edges), weld_distance, cancel.every(1u << 16));
  return !find_seams(boundary).empty() || !find_edge_splits(boundary).empty();
}

}  // namespace meander
