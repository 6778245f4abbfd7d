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
#include "seed/line_spacing.h"

namespace meander {

/// The nodes of one streamline: consecutive ones are joined by edges of the network.
struct Streamline {
  std::vector<uint32_t> nodes;
  /// One that was drawn by the caller: a curve runs along it once, and not round it.
  bool trunk = false, closed = false;
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
