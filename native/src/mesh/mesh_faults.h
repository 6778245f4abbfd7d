// SPDX-License-Identifier: GPL-3.0-or-later
//
// All that is wrong with a mesh, for people who want to see it; the check stops at the first.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh_check.h"

namespace meander {

/// In the order of the header's meander_fault.
enum class FaultKind : uint32_t { kNotFinite, kNoArea, kDoubledFace, kCrowdedEdge, kBowTie, kOneSided, kSeam };

/// A vertex or a face, twice; or the two vertices of an edge.
struct MeshFault {
  FaultKind kind;
  uint32_t element = 0, element2 = 0;
};

/// All faults, by kind, and within a kind in rising order. Faces without area, doubled ones and those at vertices that
/// are not finite are left out of the search for the kinds behind.
///
/// weld_distance   of find_seams; 0: seams are not searched for
///
/// Throws Failure(FailureKind::kInvalidMesh) for a mesh without faces, and for faces of vertices that do not exist.
std::vector<MeshFault> find_faults(std::span<const double> vertices, std::span<const uint32_t> faces,
                                   double weld_distance);

/// Whether a mesh that has passed the check has boundary edges that lie on each other.
///
/// boundary   half-edges of the caller's faces that are alone on their edge, in rising order
bool has_seams(std::span<const double> vertices, std::span<const uint32_t> faces, std::span<const uint32_t> boundary,
               double weld_distance);

}  // namespace meander
