// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface as it is at the scale of the spacing: where it is crumpled below r, smoothed, and lengths say by how
// much.
#pragma once

#include <memory>

#include "base/tell.h"
#include "base/thread_pool.h"
#include "mesh/radius_field.h"
#include "mesh/surface.h"
#include "mesh/vertex_data.h"

namespace meander {

/// How rough a surface is, and what has been smoothed of it. Means are over the area of the surface as given.
struct Roughness {
  double mean = 0;       ///< of roughness(), in radians; 0 where it is nowhere above what straight lines bear
  double smoothing = 0;  ///< mean width of the Gaussian, in the local r
  double stretch = 1;    ///< root of the area over that at the scale of the spacing
};

/// A surface, and the same faces with their vertices smoothed.
///
/// Straight lines across a surface that is crumpled below r are chaotic: balls along it, which decide the spacing, are
/// then no continuous function of the curve, and the curve never settles. At the scale of the spacing they are. Points
/// of the curve are weights of the corners of faces, so a curve on the one is one on the other, without crossings if
/// it has none there.
struct SurfaceAtScale {
  std::shared_ptr<const Surface> surface;  ///< the one given where nothing was smoothed; in its unit and place
  /// Of lengths, averaged over about r: 1 where it is as given; empty where all of it is.
  VertexData<double> shrinkage;
  Roughness roughness;
};

/// Smooths by a Gaussian of half of r where the surface is rough, by less where it is only somewhat rough, and not at
/// all elsewhere; see roughness() and smoothed_positions(). Boundaries stay.
///
/// `radius`    r on the surface
/// `followed`  how much of the roughness the spacing is to follow, in [0, 1]: at 1 nothing is smoothed
/// `looks`     is told how far it is seen whether the surface is rough
/// `smooths`   where it is, how far it is smoothed
SurfaceAtScale at_scale(std::shared_ptr<const Surface> surface, const RadiusField& radius, double followed,
                        ThreadPool& pool, const Tell& looks = {}, const Tell& smooths = {});

}  // namespace meander
