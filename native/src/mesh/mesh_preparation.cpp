// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/mesh_preparation.h"

#include <algorithm>
#include <cmath>

#include "base/failure.h"
#include "mesh/constants.h"

namespace meander {

PreparedMesh prepare_mesh(std::span<const double> vertices, std::span<const uint32_t> faces,
                          const PrepareSettings& settings, const CancelToken& cancel, const Tell& tell,
                          size_t open_edges) {
  PreparedMesh mesh;
  PrepareCounts& counts = mesh.counts;
  cancel.now();
  Soup soup(vertices, faces, cancel);
  const auto refuse_empty = [&](const std::string& sentence) {
    if (soup.faces().empty()) throw Failure(FailureKind::kInvalidMesh, sentence);
    cancel.now();
  };
  const auto drop_degenerate = [&] {
    if (!settings.drop_degenerate) return;
    dissolve_faces_without_area(soup, counts);
    drop_doubled_faces(soup, counts);
  };
  counts.unused_vertices = static_cast<uint32_t>(std::ranges::count(soup.used(), 0));
  if (!settings.face_mask.empty()) {
    mask_faces(soup, settings.face_mask, counts);
    refuse_empty("The mask leaves no faces of the mesh; choose the faces to fill.");
  }
  soup.measure();  // what a mask leaves is the mesh from here on
  if (settings.merge_distance > 0) merge_vertices(soup, settings.merge_distance, counts);
  const double whole = time_of_preparation(faces.size() / 3, open_edges);
  const double doubles = kFindingDoubles * static_cast<double>(faces.size() / 3) / whole;
  const double seams = kWeldingEdges * static_cast<double>(open_edges) / whole;
  if (settings.drop_doubled) drop_doubled_polygons(soup, settings.polygons, counts, part_of(tell, 0, doubles));
  drop_degenerate();
  if (tell) tell((1 + doubles - seams) / 2);
  if (settings.weld_distance > 0) {
    const bool split = split_edges(soup, settings.weld_distance, counts);
    if (tell) tell((1 + doubles) / 2);
    if (weld_seams(soup, settings.weld_distance, counts) || split) drop_degenerate();
  }
  if (tell) tell((1 + doubles + seams) / 2);
  if (!std::isfinite(soup.diagonal() * soup.diagonal())) {
    refuse_empty("The mesh is too large to measure; scale it down.");
  }
  if (settings.merge_distance > 0) {
    refuse_empty("Merging and dropping leave no faces of the mesh; choose a smaller merge distance.");
  }
  refuse_empty("No face of the mesh has an area; give a mesh with a surface.");
  if (!settings.vertex_mask.empty()) {
    clip(soup, settings.vertex_mask, settings.mask_threshold, counts);
    refuse_empty("The mask leaves no faces of the mesh: its values are nowhere above the threshold " +
                 number(settings.mask_threshold) + "; choose a lower threshold.");
  }
  if (settings.make_manifold) {
    if (settings.drop_degenerate) drop_faces_without_area(soup, counts);
    refuse_empty("No face of the mesh has an area; give a mesh with a surface.");
    split_into_sheets(soup, !settings.cut_non_manifold, counts);
  } else {
    split_vertices(soup, settings.split_bow_ties, settings.cut_non_manifold, counts);
  }
  if (settings.smallest_part > 0) drop_small_parts(soup, settings.smallest_part, counts);
  if (tell) tell(1);
  std::move(soup).write(mesh.vertices, mesh.faces, mesh.map);
  return mesh;
}

double time_of_preparation(size_t faces, size_t open_edges) {
  return (kFindingDoubles + kMendingFaces) * static_cast<double>(faces) +
         kWeldingEdges * static_cast<double>(open_edges);
}

}  // namespace meander
