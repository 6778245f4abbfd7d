// SPDX-License-Identifier: GPL-3.0-or-later
//
// The regions into which guides divide a surface: what grows in one never reaches another.
#pragma once

#include <vector>

#include "base/point_tree.h"
#include "curve/curve.h"
#include "mesh/radius_field.h"

namespace meander {

struct Region {
  SurfacePoint middle;    ///< a place for a first strand
  double room = 0;        ///< straight distance from there to the nearest guide, where there is one
  bool guided = false;    ///< are there guides on its component?
  bool growing = false;   ///< does a strand that is no guide begin in it?
};

/// All regions, component by component in the order of their first faces.
///
/// A component without guides is one region, and its place the middle of its first face, or of the one
/// farthest from the boundary where that lies in a strip to be left empty; in a variation other than 0 it is anywhere,
/// as likely as there is area. Elsewhere samples of faces and edges, about r / 2 apart and at least as far from all
/// guides, are joined where a straight line between them meets none: what is connected is a region, so that gaps which
/// no strand would go through are closed. Its place is the first sample that lies 2.5 r away from all guides, or else
/// the farthest, and variations begin with another sample. What is narrower than the samples is left out: the guides
/// cover it.
/// `radius` is r.
///
/// `boundary`, `strip_width`   points of the boundary, or null, and the distance from it, in local radii, that
///                        strands keep: no place lies nearer, so that strips along it stay empty
std::vector<Region> find_regions(const Surface& surface, const Curve& curve, const RadiusField& radius,
                                 const PointTree* boundary = nullptr, double strip_width = 0,
                                 uint32_t variation = 0);

}  // namespace meander
