// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is found of a curve, ready to be handed out: by calls that ask for one thing, and by the one that asks for all.
#pragma once

#include <vector>

#include "api/results.h"
#include "base/tell.h"
#include "outputs/gaps.h"
#include "outputs/polylines.h"
#include "outputs/rounding.h"
#include "outputs/statistics.h"

namespace meander {

/// Why a run of this flow would end now, as the header has it.
meander_stop_reason stop_reason_of(const Flow& flow);

meander_flow_statistics ready_statistics(const meander_flow& handle, const Statistics& found);

Ready<meander_gaps> ready_gaps(const meander_flow& handle, const Gaps& found);

/// Refuses a size that none is searched for by.
double least_size_of(double given);

Ready<meander_polylines> ready_polylines(Polylines lines);
Ready<meander_polylines> ready_polylines(const meander_flow& handle);

/// Data of points, as a result holds them.
struct PointValues {
  size_t count = 0;
  std::vector<double> arc_lengths, normals, tangents, radii, weights;
  std::vector<uint32_t> faces;
};

/// Those of the points of a curve: the flow's, or one made of it, where `origin` says whose radii its nodes have.
PointValues point_values(const meander_flow& handle, const Curve& curve, const NodeData<uint32_t>* origin,
                         meander_point_parts parts);

Ready<meander_point_data> ready_point_data(PointValues values);

/// A curve as it is drawn, and which of its points are.
struct DrawnCurve {
  RoundedCurve curve;
  std::vector<uint8_t> drawn;
};

void require_tolerance(double tolerance);

/// `told` hears how far the turns are round.
DrawnCurve drawn_curve(const Flow::Present& present, double tolerance, WatchedPart told = {});

struct ReadyLine {
  Ready<meander_polylines> polylines;
  Ready<meander_point_data> data;
};

/// Once the normals and the radii of the flow are there.
ReadyLine ready_line(const meander_flow& handle, DrawnCurve line);

}  // namespace meander
