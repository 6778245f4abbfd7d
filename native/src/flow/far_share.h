// SPDX-License-Identifier: GPL-3.0-or-later
//
// How much of the surface a curve that grows has not come near to yet.
#pragma once

#include "base/thread_pool.h"
#include "flow/domain.h"

namespace meander {

/// The share of the surface's area that is farther than kFarFromNodes local r from every node, along the surface where
/// the flow measures so. Costs about half an iteration. Places are looked at about an r apart, where something is far.
double far_share(const Domain& domain, const Curve& curve, ThreadPool& pool);

}  // namespace meander
