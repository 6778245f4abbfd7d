// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nodes whose medial radii are at the clamp: they see nothing there, so nothing pulls them anywhere; and those that see
// nothing but the boundary.
#pragma once

#include "base/thread_pool.h"
#include "curve/local_metric.h"
#include "medial/boundary_reach.h"
#include "medial/medial_axis.h"

namespace meander {

/// Both sides of the node are empty up to `room` local r, or up to r_max.
bool has_room(const NodeData<Radii>& radii, const LocalMetric& metric, uint32_t node, double room);

/// Of the nodes that may move, the share that sees nothing on a side. All arguments are of the same curve.
double clamped_share(const Curve& curve, const NodeData<Radii>& radii, const LocalMetric& metric, ThreadPool& pool);

/// Of the nodes that may move, the share that lies on open strands alone between two boundaries, farther apart than one
/// line fills.
double alone_share(const Curve& curve, const NodeData<Radii>& radii, const NodeData<Reach>& reach,
                   const LocalMetric& metric, ThreadPool& pool);

/// Of the nodes that may move, the share that sees something on both sides, but nothing nearer than kSlack r.
double slack_share(const Curve& curve, const NodeData<Radii>& radii, const LocalMetric& metric, ThreadPool& pool);

/// Of the nodes that grow, the share that lies in balance: on stretches as long as a wave of perturb_empty_stretches
/// all of whose nodes are slack.
double balanced_share(const Curve& curve, const NodeData<Radii>& radii, const LocalMetric& metric, ThreadPool& pool);

/// Where both sides of a strand are empty its radii are alike and nothing pulls it anywhere; a wide smooth loop then
/// grows so slowly that it seems to stand still. There one side and the other are favoured in turn in `felt_radii`,
/// so that fingers begin to grow; as soon as they see anything they are left alone, or as soon as it is nearer than
/// `room` local r. `radii` are as they are. Strands begin after a `share` in [0, 1) of a turn.
void perturb_empty_stretches(const Curve& curve, const NodeData<Radii>& radii, const LocalMetric& metric,
                             double room, double share, ThreadPool& pool, NodeData<Radii>& felt_radii);

}  // namespace meander
