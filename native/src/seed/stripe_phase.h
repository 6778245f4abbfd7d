// SPDX-License-Identifier: GPL-3.0-or-later
//
// A phase on the surface whose level lines are as far apart as is wanted (Knoppel, Crane, Pinkall and Schroder, "Stripe
// Patterns on Surfaces", 2015).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/tell.h"
#include "base/thread_pool.h"
#include "mesh/line_field.h"
#include "mesh/radius_field.h"
#include "mesh/refined_surface.h"

namespace meander {

/// In r: of two lines, and of the first one from the boundary where the field runs along that.
struct StripeDistances {
  double apart, from_boundary;
};

/// Across the lines of a field the phase rises by a turn in `apart` local radii, as nearly as it can: where the wanted
/// distance varies along the lines it cannot everywhere, and has singular faces, round which it rises by a turn. They
/// keep away from one another as far as they can; there lines begin and end. Lines are where the phase is 0.
///
/// A unit number for every vertex of the surface, divided to edges below about r; a field has no sign, so that the
/// phase rises to one side or to the other from vertex to vertex. Every vertex is what its neighbours make it, again
/// and again, from coarse to fine, and in between all numbers are made of length 1: the flow of a Ginzburg-Landau
/// energy, by the scheme of Merriman, Bence and Osher (Ruuth, Merriman, Xin and Osher, "Diffusion-Generated Motion by
/// Mean Curvature for Filaments", 2001). The eigenvector of the paper vanishes where singularities are dense.
///
/// The surface, the field and the radius are used by the constructor only.
class StripePhase {
 public:
  /// `distances`  on every component
  StripePhase(const Surface& surface, const LineField& field, const RadiusField& radius,
              std::span<const StripeDistances> distances, ThreadPool& pool, const Tell& tell = {});

  const RefinedSurface& mesh() const { return mesh_; }
  /// Whether the field has a direction in a face.
  bool directed(uint32_t face) const { return directed_[face] != 0; }
  /// Where a line crosses the edge of a half-edge, as a share of half-edge 2 e; below 0: none does.
  double crossing(HalfEdge h) const { return crossing_[h / 2]; }

 private:
  class Relaxation;
  RefinedSurface mesh_;
  std::vector<uint8_t> directed_;  // per face
  std::vector<double> crossing_;   // per edge
};

}  // namespace meander
