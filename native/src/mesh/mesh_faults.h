// SPDX-License-Identifier: GPL-3.0-or-later
//
// All that is wrong with a mesh, for people who want to see it; the check stops at the first.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/cancel_token.h"

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
/// cancel          asked within every step
///
/// Throws Failure(FailureKind::kInvalidMesh) for a mesh without faces, and for faces of vertices that do not exist.
std::vector<MeshFault> find_faults(std::span<const double> vertices, std::span<const uint32_t> faces,
                                   double weld_distance, const CancelToken& cancel = {});

/// Whether a mesh that has passed the check has boundary edges that lie on each other.
///
/// half_edges   those of the caller's faces that are alone on their edge, rising
bool has_seams(std::span<const double> vertices, std::span<const uint32_t> faces, std::vector<uint32_t> half_edges,
               double weld_distance, const CancelToken& cancel);

}  // namespace meander
