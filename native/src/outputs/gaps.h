// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gaps: the places of the surface that are farther from the curve than a filled surface has them.
#pragma once

#include <vector>

#include "base/tell.h"
#include "flow/flow.h"
#include "outputs/constants.h"
#include "outputs/empty_area.h"

namespace meander {

/// What a curve leaves empty.
struct Gaps {
  std::vector<Gap> gaps;  ///< the largest first
  EmptyArea empty;        ///< of a larger size than kEmptySize, as shares of the surface
};

/// Places that the curve as it is now leaves empty, whose size is at least `least_size`. No centre lies within the
/// radius of a larger gap: what overlaps is one gap. And how much of the surface is empty, whatever `least_size` is.
///
/// A largest empty place touches the curve on several sides, so it is a medial ball of the nodes
/// where it touches, and the search starts from the centres of all balls, carried onto the surface by
/// geodesics. It also starts from the middle of every face that is far from the curve, and beside every
/// corner of the boundary: there are the places that no ball reaches, such as a component without a
/// strand, and the far corner of a sheet. From each start the centre
/// climbs to where the distance has a maximum, and what it finds is measured anew. That is a local
/// search, so where balls end at the clamp in one large void the size is a lower bound.
///
/// Distance is straight through space, as the Euclidean medial axis has it: a sheet that lies closer than
/// the spacing to another one is covered by the strands of both. Where distances are along the surface, only
/// what of the curve is connected to the place counts, on the part of the surface that is no farther from it; gaps
/// on sheets that face each other are then two. What only strands of another sheet are near to counts as at
/// most 3 r from the curve.
///
/// Where a strip along the boundary is to stay empty, only what lies farther from the curve than the strip asks for is
/// a gap, or empty. Centres are on Flow::surface(), radii in its unit. See Flow::ask for what changes, and
/// for `cancel`. `told` hears how far the search is.
Gaps find_gaps(Flow& flow, double least_size = kGapSize, const CancelToken& cancel = {}, WatchedPart told = {});
/// The same, where more is asked at once.
Gaps find_gaps(const Flow::Present& present, double least_size, WatchedPart told = {});

}  // namespace meander
