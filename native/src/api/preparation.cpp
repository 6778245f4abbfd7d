// SPDX-License-Identifier: GPL-3.0-or-later
//
// Options of a surface, and surfaces from meshes that are prepared first.
#include "api/preparation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "api/constants.h"
#include "api/structs.h"
#include "base/tell.h"
#include "base/thread_pool.h"
#include "mesh/constants.h"
#include "mesh/doubled_polygons.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_faults.h"

namespace meander {
namespace {

/// An array of the caller's with one value for each face or vertex (`elements`); NULL: none.
template <class Value>
std::span<const Value> checked_mask(const Value* mask, size_t count, size_t wanted, const char* name,
                                    const char* elements) {
  if (count == (mask ? wanted : 0)) return {mask, count};
  refuse(std::string(name) + " has " + std::to_string(count) + " values; it must have one for each of the " +
         std::to_string(wanted) + ' ' + elements + " of the mesh, or be NULL and have none.");
}

PrepareSettings checked_settings(const meander_surface_options& o, size_t vertex_count, size_t face_count) {
  PrepareSettings s;
  if (!(std::isfinite(o.merge_distance) && o.merge_distance >= 0)) {
    refuse("The merge distance is " + number(o.merge_distance) + "; it must be 0 or a positive number.");
  }
  if (!(std::isfinite(o.weld_distance) && o.weld_distance >= 0)) {
    refuse("The weld distance is " + number(o.weld_distance) + "; it must be 0 or a positive number.");
  }
  if (!(std::isfinite(o.smallest_part) && o.smallest_part >= 0)) {
    refuse("The size of the smallest part is " + number(o.smallest_part) + "; it must be 0 or a positive number.");
  }
  require_flag(o.make_manifold, "make_manifold");
  require_flag(o.drop_degenerate, "drop_degenerate");
  require_flag(o.split_bow_ties, "split_bow_ties");
  require_flag(o.cut_non_manifold, "cut_non_manifold");
  require_flag(o.drop_doubled, "drop_doubled");
  require_threads(o.threads);
  require(std::isfinite(o.mask_threshold), "The mask's threshold must be a finite number.");
  s.merge_distance = o.merge_distance;
  s.drop_degenerate = o.drop_degenerate != 0;
  s.split_bow_ties = o.split_bow_ties != 0;
  s.cut_non_manifold = o.cut_non_manifold != 0;
  s.make_manifold = o.make_manifold != 0;
  s.weld_distance = o.weld_distance;
  s.smallest_part = o.smallest_part;
  s.mask_threshold = o.mask_threshold;
  s.drop_doubled = o.drop_doubled != 0;
  s.polygons = checked_mask(o.polygons, o.polygons_count, face_count, "polygons", "faces");
  s.face_mask = checked_mask(o.face_mask, o.face_mask_count, face_count, "face_mask", "faces");
  s.vertex_mask = checked_mask(o.vertex_mask, o.vertex_mask_count, vertex_count, "vertex_mask", "vertices");
  for (size_t v = 0; v < s.vertex_mask.size(); ++v) {
    if (std::isfinite(s.vertex_mask[v])) continue;
    throw Failure(FailureKind::kInvalidArgument,
                  "The mask's value at vertex " + std::to_string(v) + " is not a finite number.", ElementKind::kVertex,
                  static_cast<uint32_t>(v));
  }
  return s;
}

/// The surface of a prepared mesh; what it refuses is said of the caller's mesh.
std::shared_ptr<const Surface> surface_of(const PreparedMesh& mesh, unsigned threads, const CancelToken& cancel,
                                          const Tell& tell) {
  try {
    return std::make_shared<const Surface>(mesh.vertices, mesh.faces, threads, cancel, tell);
  } catch (const Failure& failure) {
    if (failure.kind == FailureKind::kCancelled) throw;
    ThreadPool pool(1);
    check_mesh(mesh.vertices, mesh.faces, pool, &mesh.map);  // throws the same with the caller's names
    if (failure.element != ElementKind::kFace) throw;
    const uint32_t face = mesh.map.face(failure.index);
    throw Failure(failure.kind, "Face " + std::to_string(face) + " has no area; dissolve degenerate faces.",
                  ElementKind::kFace, face);
  }
}

/// The surface of a mesh that passes the strict check, or null. Where it needs no mending nothing is prepared, and the
/// curve is that of the strict check to the last bit.
struct StrictSurface {
  std::shared_ptr<const Surface> surface;
  bool needs_mending = true;
};

StrictSurface strict_surface(std::span<const double> vertices, std::span<const uint32_t> faces,
                             const PrepareSettings& settings, unsigned threads, const CancelToken& cancel,
                             ToldInTurn& told) {
  const auto count = static_cast<double>(faces.size() / 3);
  const double making = kMakingSurface * count, seeking = kSeekingDoubles * count, finding = kFindingDoubles * count;
  const double mending = time_of_preparation(faces.size() / 3, 0) + making;
  StrictSurface made;
  try {
    const double usual = seeking + kMendedSurfaces * (finding + mending);
    made.surface = std::make_shared<const Surface>(vertices, faces, threads, cancel, told.next(making, usual));
    const Surface& surface = *made.surface;
    std::vector<uint32_t> boundary;
    for (const HalfEdge e : surface.boundary()) {  // of a flipped face the half-edges 0 and 2 have changed places
      boundary.push_back(surface.flipped(e / 3) ? 3 * (e / 3) + 2 - e % 3 : e);
    }
    std::ranges::sort(boundary);
    made.needs_mending = settings.weld_distance > 0 &&
                         has_seams(vertices, faces, std::move(boundary), settings.weld_distance, cancel);
    const double after = made.needs_mending ? mending + kWeldingEdges * static_cast<double>(surface.boundary().size())
                                            : kMendedSurfaces * mending;
    const double doubles = made.needs_mending ? finding : kMendedSurfaces * finding;
    constexpr uint32_t kPieces = 1u << 16;  // between two asks of the search
    const TellingPoll poll(cancel, kPieces, kPiecesOfSeeking * surface.face_count(),
                           told.next(seeking, doubles + after));
    if (settings.drop_doubled && may_have_doubled_polygons(surface, settings.polygons, poll.token())) {
      Soup soup(vertices, faces, cancel);
      soup.measure();
      if (!find_doubled_polygons(soup, settings.polygons, told.next(finding, after)).faces.empty()) return {};
    }
  } catch (const Failure& failure) {
    if (failure.kind != FailureKind::kInvalidMesh) throw;
    return {};
  }
  return made;
}

}  // namespace

std::unique_ptr<meander_surface> prepared_surface(std::span<const double> vertices, std::span<const uint32_t> faces,
                                                  const meander_surface_options& options,
                                                  const CancelToken& cancel, const Tell& tell) {
  const PrepareSettings settings = checked_settings(options, vertices.size() / 3, faces.size() / 3);
  auto made = std::make_unique<meander_surface>();
  if (settings.changes_nothing()) {
    made->surface = std::make_shared<const Surface>(vertices, faces, options.threads, cancel, tell);
    return made;
  }
  check_numbers(vertices, faces);
  ToldInTurn told(tell);
  StrictSurface strict;
  if (settings.only_mends()) strict = strict_surface(vertices, faces, settings, options.threads, cancel, told);
  made->surface = strict.surface;
  if (!strict.needs_mending) return made;
  const size_t count = faces.size() / 3, open_edges = strict.surface ? strict.surface->boundary().size() : 0;
  const double making = kMakingSurface * static_cast<double>(count);
  PreparedMesh mesh = prepare_mesh(vertices, faces, settings, cancel,
                                   told.next(time_of_preparation(count, open_edges), making), open_edges);
  std::shared_ptr<const Surface> mended = surface_of(mesh, options.threads, cancel, told.next(making, 0));
  // Closing what looks like a seam is no mending where it takes a surface apart, as between the teeth of a comb.
  if (strict.surface && mended->component_count() > strict.surface->component_count()) return made;
  made->surface = std::move(mended);
  made->prepared = mesh.counts;
  made->map = std::make_shared<const MeshMap>(std::move(mesh.map));
  return made;
}

}  // namespace meander
