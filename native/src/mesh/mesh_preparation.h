// SPDX-License-Identifier: GPL-3.0-or-later
//
// Turns a mesh as artists have it into one that passes the strict check: merges vertices, drops and cuts faces,
// and leaves out what a mask excludes. It records where every vertex and face comes from, so that the caller
// can keep using the numbers of the original mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/cancel_token.h"
#include "base/tell.h"
#include "mesh/mesh_map.h"
#include "mesh/repairs.h"

namespace meander {

/// meander_surface_options, checked.
struct PrepareSettings {
  double merge_distance = 0;           ///< caller's units; 0: none
  bool drop_degenerate = false;
  bool split_bow_ties = false;
  bool cut_non_manifold = false;
  bool make_manifold = false;
  double weld_distance = 0;            ///< caller's units; 0: none
  std::span<const uint8_t> face_mask;  ///< per face, or empty
  std::span<const double> vertex_mask; ///< per vertex, or empty
  double smallest_part = 0;            ///< caller's units; 0: none is too small
  bool drop_doubled = false;           ///< polygons that lie in the place of others
  std::span<const uint32_t> polygons;  ///< of which polygon each face is a part, or empty
  double mask_threshold = 0;           ///< where the mask is below it the surface is left out

  bool changes_nothing() const {
    return merge_distance == 0 && !drop_degenerate && !split_bow_ties && !cut_non_manifold && !make_manifold &&
           weld_distance == 0 && smallest_part == 0 && !drop_doubled && face_mask.empty() && vertex_mask.empty();
  }
  /// Whether a mesh that passes the check, and has no seams to weld, comes out as it is.
  bool only_mends() const {
    return merge_distance == 0 && make_manifold && smallest_part == 0 && face_mask.empty() && vertex_mask.empty();
  }
};

struct PreparedMesh {
  std::vector<double> vertices;  ///< xyz xyz ...; those that faces use
  std::vector<uint32_t> faces;
  MeshMap map;
  PrepareCounts counts;
};

/// Prepares a mesh whose numbers have been checked (check_numbers), in this order:
///   faces outside face_mask go; vertices nearer than merge_distance to one with a lower index become
///   that one; polygons that are there twice are left out; faces without area are dissolved and doubled ones
///   dropped; boundary edges are split at vertices
///   that lie on them, and those nearer than weld_distance to each other become one; what lies below the threshold
///   of vertex_mask is cut away; vertices at which fans of faces meet are split; parts whose bounding box has a
///   diagonal below smallest_part go.
/// The result is as strict a mesh as the settings allow; check_mesh finds what is left. Throws
/// Failure(FailureKind::kInvalidMesh) when nothing is left.
///
/// cancel      asked before every step and now and then within the long ones; throws
///             Failure(FailureKind::kCancelled) where it stops them
/// tell        is told how far it is
/// open_edges  of the boundary, about
PreparedMesh prepare_mesh(std::span<const double> vertices, std::span<const uint32_t> faces,
                          const PrepareSettings& settings, const CancelToken& cancel = {}, const Tell& tell = {},
                          size_t open_edges = 0);

/// How long that takes, about, in microseconds of a processor.
double time_of_preparation(size_t faces, size_t open_edges);

}  // namespace meander
