// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds what makes a list of triangles unusable, and names the element. A mesh that passes is a manifold whose
// faces know their neighbours.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/large_pages.h"
#include "base/tell.h"
#include "mesh/edge_groups.h"

namespace meander {

/// No half-edge.
inline constexpr uint32_t kNoTwin = UINT32_MAX;

class MeshMap;

/// Where a mesh is and how large.
struct Placement {
  std::array<double, 3> low{};  ///< a corner of the bounding box of the used vertices, caller's units
  double diagonal = 0;          ///< of that box
};

/// Triangles that are a manifold with consistent orientation inside every component.
struct CheckedMesh {
  Table<Triangle> faces;             ///< some flipped
  std::vector<uint8_t> flipped;       ///< per face: 1 if flipped
  Table<uint32_t> component;         ///< per face
  /// Per half-edge 3 f + k, from corner k of face f to the next: that of the other face on the same edge,
  /// kNoTwin at the boundary.
  Table<uint32_t> twin;
  uint32_t component_count = 0;
  Placement placement;
  uint32_t used_vertices = 0;
};

/// Refuses a mesh without faces, and faces that refer to vertices that do not exist.
void check_indices(size_t vertex_count, std::span<const uint32_t> faces);

/// The same, and refuses coordinates that are not finite before.
void check_numbers(std::span<const double> vertices, std::span<const uint32_t> faces);

/// Checks `faces` over `vertices` (xyz xyz ...). Throws Failure(FailureKind::kInvalidMesh) that names the
/// first element that cannot be used; see meander_surface_create for the list. For a prepared mesh it names
/// the caller's elements, which `map` knows.
CheckedMesh check_mesh(std::span<const double> vertices, std::span<const uint32_t> faces, ThreadPool& pool,
                       const MeshMap* map = nullptr, const Tell& tell = {});

/// Checks only what depends on the positions of the vertices, numbers and areas, for `faces` that have been
/// checked before. Throws as check_mesh does.
Placement check_placement(std::span<const double> vertices, const Table<Triangle>& faces, ThreadPool& pool,
                          const MeshMap* map = nullptr);

}  // namespace meander
