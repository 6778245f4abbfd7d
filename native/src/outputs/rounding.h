// SPDX-License-Identifier: GPL-3.0-or-later
//
// A curve with its elbows made round, to be drawn: where a strand turns within a small share of the spacing, a tube
// along it pinches.
#pragma once

#include "base/tell.h"
#include "base/thread_pool.h"
#include "curve/curve.h"
#include "flow/domain.h"

namespace meander {

/// A curve to be drawn in place of another one, and where its nodes come from.
struct RoundedCurve {
  Curve curve;
  NodeData<uint32_t> origin;  ///< per node: the node of the other curve that it was, or the one before it
};

/// Makes the turns of a curve round, on the surface that the flow runs on: the smoothing spline of each bend, which is
/// to turn little and to stay where it was. No place of the curve goes farther along the surface than `tolerance`
/// local spacings. Between strands that are nearer than kRoundedClearance of the spacing the way gets no less, and
/// none gets less than that. Fixed nodes, guides and open ends stay where they are, and so does what runs straight, to
/// the last bit. It has no crossings: nodes move as those of the flow do, see Retraction.
///
/// `tolerance`  in local spacings; 0: the curve stays
/// `told`       hears how far it is
RoundedCurve rounded(const Domain& domain, const Curve& curve, double tolerance, ThreadPool& pool,
                     WatchedPart told = {});

}  // namespace meander
