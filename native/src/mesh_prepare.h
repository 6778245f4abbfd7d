// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes of a mesh as artists have it one that passes the strict check: merges, drops, cuts, and leaves
// out what a mask excludes; and remembers where every vertex and face came from, so that the caller
// goes on speaking of his own.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace meander {

/// meander_surface_options, checked.
struct PrepareSettings {
  double merge_distance = 0;           ///< caller's units; 0: none
  bool drop_degenerate = false;
  bool split_bow_ties = false;
  bool cut_non_manifold = false;
  std::span<const uint8_t> face_mask;  ///< per face, or empty
  std::span<const double> vertex_mask; ///< per vertex, or empty
  double mask_threshold = 0;           ///< what is below it is left out

  bool changes_nothing() const {
    return merge_distance == 0 && !drop_degenerate && !split_bow_ties && !cut_non_manifold && face_mask.empty() &&
           vertex_mask.empty();
  }
};

/// What was done; see meander_surface_statistics.
struct PrepareCounts {
  uint32_t unused_vertices = 0, merged_vertices = 0, dropped_faces = 0, split_vertices = 0, cut_edges = 0,
           masked_faces = 0, clipped_faces = 0;
};

/// From the prepared mesh back to the caller's.
class MeshMap {
 public:
  using Weights = std::array<double, 3>;

  /// Lies at the share t from the caller's vertex a to b.
  struct VertexOrigin {
    uint32_t a = 0, b = 0;
    double t = 0;
  };

  size_t caller_vertex_count() const { return caller_vertex_count_; }
  size_t caller_face_count() const { return caller_face_count_; }
  const VertexOrigin& vertex_origin(uint32_t v) const { return vertices_[v]; }
  /// The caller's vertex that is nearest along the edge.
  uint32_t vertex(uint32_t v) const { return vertices_[v].t < 0.5 ? vertices_[v].a : vertices_[v].b; }
  uint32_t face(uint32_t f) const { return faces_[f]; }

  /// Weights of the corners of the caller's face, from those of prepared face f.
  Weights weights(uint32_t f, const Weights& w) const;

  /// A value for every prepared vertex, from the caller's.
  std::vector<double> of_vertices(std::span<const double> values) const;

 private:
  friend class MeshPreparation;
  size_t caller_vertex_count_ = 0, caller_face_count_ = 0;
  std::vector<VertexOrigin> vertices_;
  std::vector<uint32_t> faces_;
  std::vector<uint32_t> corners_;  // per face: index into corner_weights_, kWhole for the caller's whole face
  std::vector<std::array<Weights, 3>> corner_weights_;
};

struct PreparedMesh {
  std::vector<double> vertices;  ///< xyz xyz ...; those that faces use
  std::vector<uint32_t> faces;
  MeshMap map;
  PrepareCounts counts;
};

/// Prepares a mesh whose numbers have been checked (check_numbers), in this order:
///   faces outside face_mask go; vertices nearer than merge_distance to one with a lower index become
///   that one; faces without area are dissolved and doubled ones dropped; what lies below the
///   threshold of vertex_mask is cut away; vertices at which fans of faces meet are split.
/// The result is as strict a mesh as the settings allow; check_mesh finds what is left. Throws
/// Failure(MEANDER_INVALID_MESH) when nothing is left.
PreparedMesh prepare_mesh(std::span<const double> vertices, std::span<const uint32_t> faces,
                          const PrepareSettings& settings);

}  // namespace meander
