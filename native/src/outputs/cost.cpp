// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/cost.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/elementary.h"
#include "flow/constants.h"
#include "flow/plan.h"
#include "mesh/roughness.h"
#include "outputs/constants.h"

namespace meander {
namespace {

double iterations_of(double nodes, const FlowSettings& s) {
  const double growth = elementary::pow(std::max(1.0, nodes / kFewNodes), kIterationGrowth);
  const double removal = s.hairpin_removal_iterations;
  const double longer = polish_iterations(s, s.full_start) - kPolishIterations;
  if (s.polish && s.full_start) {
    const double full = kFullIterations * elementary::pow(std::max(1.0, nodes / kFewNodes), kFullGrowth);
    return std::min(full + longer, static_cast<double>(s.iteration_limit));
  }
  const double all = (s.polish ? removal + longer : 0) + growth * (s.polish ? kUsualIterations : kUnpolishedIterations);
  return std::min(all, static_cast<double>(s.iteration_limit));
}

}  // namespace

Extent measured_extent(const Surface& surface, const VertexData<double>& density) {
  Extent extent;
  extent.faces = static_cast<uint32_t>(surface.face_count());
  double area = 0, sides = 0;
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    const Triangle& t = surface.face(f);
    const double of_face = surface.face_area(f);
    double root = 3, sum = 3;
    if (!density.empty()) {
      root = sum = 0;
      for (const uint32_t v : t) {
        root += std::sqrt(density[v]);
        sum += density[v];
      }
    }
    area += of_face;
    extent.length_area += of_face * root / 3;
    extent.node_area += of_face * sum / 3;
    for (int corner = 0; corner < 3; ++corner) {
      sides += (surface.position(t[(corner + 1) % 3]) - surface.position(t[corner])).norm();
    }
  }
  double curvature = 0;
  for (const double defect : angle_defects(surface)) curvature += std::abs(defect);
  extent.curvature = area > 0 ? curvature / area : 0;
  extent.edge_density = area > 0 ? sides / (2 * area) : 0;  // an edge is a side of two faces
  return extent;
}

Cost expected_cost(const Extent& extent, const FlowSettings& settings) {
  const double rest = settings.rest(settings.alignment_weight > 0);
  const double r = settings.radius / rest, h = settings.segment_length / rest;
  const double per_area = (settings.polish ? kLengthPolished : kLengthUnpolished) / (2 * r);
  const bool along_surface = settings.medial_axis == MedialAxis::kGeodesic;
  Cost cost;
  cost.length = per_area * extent.length_area;
  cost.nodes = (settings.full_start ? kFullNodes : 1) * per_area * extent.node_area / (kMeanSegment * h);
  // What is too large for a number is still none times no edges.
  constexpr double kMost = std::numeric_limits<double>::max();
  cost.points = cost.nodes + kEdgesCrossed * std::min(cost.length, kMost) * std::min(extent.edge_density, kMost);

  const double of_disc = std::numbers::pi * r * r * std::min(extent.curvature, kMost);
  const bool is_smoothed = along_surface && settings.roughness < 1 && of_disc > kSmoothedFrom;
  const double per_node =
      kBytesPerNode + (settings.polish ? kPolishPerNode : 0) + (along_surface ? kGeodesicPerNode : 0);
  const double of_nodes = std::min(per_node * cost.nodes, kLongPerNode * cost.nodes + kBesideLong);
  const double flow = of_nodes + kFlowPerFace * extent.faces;
  // Gone before the curve is long.
  const double set_up = std::max(along_surface ? kPatchesPerFace : 0, settings.full_start ? kLayingBytesPerFace : 0);
  const double surfaces = (is_smoothed ? 2 : 1) * kSurfacePerFace;
  cost.memory = surfaces * extent.faces + std::max(flow, set_up * extent.faces);

  const double measuring = along_surface ? kSecondsPerRadian * std::min(of_disc, kMostRadians) : 0;
  const double near = settings.full_start ? std::min(cost.points, 2 * cost.nodes) : cost.points;
  const double further = std::min(cost.points, kMost) - near;
  const double iteration = (kSecondsPerNode + measuring) * cost.nodes + kSecondsPerPoint * near +
                           kSecondsPerFurtherPoint * std::max(further, 0.0);
  const double of_face =
      kSecondsPerFace + (settings.full_start ? kLayingPerFace : 0) + (is_smoothed ? kSmoothingPerFace : 0);
  const double faces = cost.nodes > 0 ? extent.faces : 0;  // without an area there is no run
  cost.processor_seconds = of_face * faces + iterations_of(cost.nodes, settings) * iteration;
  return cost;
}

}  // namespace meander
