// SPDX-License-Identifier: GPL-3.0-or-later
//
// A first curve that fills the surface already: it walks round a tree of evenly spaced streamlines.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/tell.h"
#include "curve/curve.h"
#include "geodesic/surface_patches.h"
#include "mesh/line_field.h"
#include "mesh/radius_field.h"

namespace meander {

/// What became of a strand of the first curve.
enum class StrandStart : uint8_t {
  kGuide,      ///< a guide: stays as it was
  kLaid,       ///< fills its region; a strand that was drawn: is left by at least one tree
  kNoRoom,     ///< grows as it was: no line has room in its region, as in one narrower than two spacings
  kCrossings,  ///< grows as it was: nothing could be laid in its region without a crossing
};

/// What the lines are that a curve walks round.
enum class StartLines : uint8_t {
  kStreamlines,  ///< streamlines of the field, which begin beside what is there
  kPhase,        ///< those of a StripePhase, and streamlines in what these leave
};

/// A first curve that fills the surface.
struct FullStart {
  Curve curve;                        ///< with as many strands as the first one, each in its place
  std::vector<StrandStart> strands;   ///< per strand

  /// Whether the curve is another one than the first.
  bool laid_any() const { return std::ranges::find(strands, StrandStart::kLaid) != strands.end(); }
};

/// What the laying of a curve takes for the faces of a surface beyond one a node, which its field and phase are found
/// on, over what it takes for the nodes.
double laying_of_faces(double faces_a_node);

/// Replaces the loops of a first curve, one in each region of the surface, by curves that fill them: lines along a
/// field lie four radii apart, short links join them to a tree, and the curve walks round it on both sides. The lines
/// are those of a StripePhase or streamlines. A strand that was drawn to grow is a trunk: it keeps its ends, its fixed
/// nodes and its sides, and trees leave it on either one, wherever there is room beside it: one that fills its region
/// stays as it is. Guides and the boundary are walls.
///
/// What cannot be laid without a crossing is left out where it is: a link, a tip, a line, and a strand stays as it was
/// only where nothing else can be laid.
///
/// `first`              see first_curve; no two of its segments touch, nor do any of the result's
/// `drawn`              how many of its first strands are trunks, or guides; the others are loops, or guides
/// `field`              where a component of the surface has none anywhere, a smooth one is taken
/// `patches`            of this surface, about as large as r; null: they are found
/// `boundary_distance`  of the last strand from the boundary, in local spacings
/// `variation`          which of the curves of the same settings: a smooth field is turned where no boundary holds it,
///                      lines begin elsewhere, and they are joined otherwise
/// `rest`               how far apart strands are to come, in r, for even rows, which stay where they are laid
/// `tell`               hears about which share of the time has passed, after each step
///
/// Throws Failure(FailureKind::kCancelled) where the watch of the pool says so.
FullStart full_start(const Surface& surface, const Curve& first, size_t drawn, const RadiusField& radius,
                     const LineField& field, const SurfacePatches* patches, double boundary_distance,
                     ThreadPool& pool, StartLines lines = StartLines::kPhase, uint32_t variation = 0, double rest = 1,
                     const Tell& tell = {});

}  // namespace meander
