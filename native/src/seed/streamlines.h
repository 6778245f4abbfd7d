// SPDX-License-Identifier: GPL-3.0-or-later
//
// Evenly spaced streamlines of a field of lines (Jobard and Lefer, "Creating Evenly-Spaced Streamlines of Arbitrary
// Density", 1997; on meshes: Spencer, Laramee, Chen and Zhang, "Evenly Spaced Streamlines for Surfaces", 2009).
#pragma once

#include <span>
#include <vector>

#include "base/thread_pool.h"
#include "mesh/line_field.h"
#include "seed/line_network.h"

namespace meander {

/// The nodes of one streamline: consecutive ones are joined by edges of the network.
struct Streamline {
  std::vector<uint32_t> nodes;
  /// One that was drawn by the caller: a curve runs along it once, and not round it.
  bool trunk = false, closed = false;
};

/// How far apart lines are to be. All in the local r.
///
/// A curve on both sides of all lines has its strands at their spacing where lines are 4 r apart. Where lines converge
/// one ends, and where they diverge another one begins, the widest gaps first and until all lines are as long as they
/// should be: what a start is too dense or too wide in the end the curve is too. With one distance for all lines, 3.2
/// to 4, near_target along the surface was .89 to .99 on stuffedtoy, and packing .95 to 1.03.
struct LineSpacing {
  double apart = 4;        ///< where lines begin beside others,
  double between = 2.8;    ///< and, where they begin later, between two that diverge, at least
  double least = 2.6;      ///< a line ends before it comes nearer to another one
  double full = 1.035;     ///< lines and their links are as long as this, over area / (4 r), if there is room for them
  double link = 3;         ///< of each of them
  double step = 0.5;       ///< between two nodes
  double from_walls = 3;   ///< as `apart`, from guides and trunks
  double least_from_walls = 1.9;
  double from_boundary = 1.2;  ///< no line comes nearer to the boundary
};

/// Draws streamlines into a network that holds nothing but walls and trunks, and appends them to these: as long as they
/// can be, at these distances from one another, measured along the surface, until there is no room for another one. A
/// closed line ends before it meets itself. Where the field has no direction, or turns by more than 60 degrees in a
/// step, a line ends.
///
/// `radius`  r, which may vary
/// `laid`    lines that are there first, each as points `step` apart: as far as they keep these distances
/// `variation`  where the first lines begin that begin anywhere
/// `poll`    is called for every node; `pool` looks at places ahead, and has no influence on what is drawn
void draw_streamlines(const LineField& field, const RadiusField& radius, const LineSpacing& spacing,
                      std::span<const std::vector<SurfacePoint>> laid, uint32_t variation, LineNetwork& network,
                      ThreadPool& pool, CancelToken poll, std::vector<Streamline>& lines);

}  // namespace meander
