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

namespace meander {
namespace {

// Measured on spheres, tori, a plane and a rough ball of 5,000 to 1,300,000 faces with curves of 3,000 to
// 300,000 nodes and the three presets; docs/performance.md has how near it comes.

/// The length of a finished curve over area by spacing; without a polish it stays shorter.
constexpr double kLength = 1.047, kLengthUnpolished = 0.967;
/// The nodes of a curve that fills the surface from its start over those of one that grows: its segments are longer.
constexpr double kFullNodes = 0.87;
/// How often a line of any direction crosses edges: for each unit of its length, and each unit of edge length on
/// each unit of area (Crofton).
constexpr double kCrossings = 2 / std::numbers::pi;

/// Iterations beside those that remove hairpins, on a curve of kFewNodes, and the power of the nodes that they grow by.
constexpr double kIterations = 98, kUnpolishedIterations = 33;
constexpr double kFewNodes = 3000, kIterationGrowth = 0.2;
/// What the 53 of a curve that fills the surface from its start, and the laying of it, cost in those of one that grows,
/// which is short for half of them, likewise: from .25 s of 5,600 nodes on a torus to 660 s of 10 million.
constexpr double kFullIterations = 80, kFullGrowth = 0.04;
/// Processor seconds of an iteration for each node, and for each point, whose faces have to be fetched; where a curve
/// stays near to where it was laid, fewer for crossings beyond one a node.
constexpr double kSecondsPerNode = 0.21e-6, kSecondsPerPoint = 0.25e-6, kSecondsPerFurtherPoint = 0.07e-6;
/// And for each node and radian of curvature, in absolute value, of a disc of radius r, up to kMostRadians: the
/// more it is curved, the more distances along the surface are measured. What is rougher is smoothed, and takes no
/// longer for it. Displaced grids of 7,200 and 80,000 faces at two spacings, reliefs, spot and two control meshes:
/// .15 to 12 rad, .5 to 3 us.
constexpr double kSecondsPerRadian = 1.5e-6, kMostRadians = 1.4;
/// Processor seconds for each face, once: before a flow begins and after its end, and while a first curve is laid that
/// fills the surface, for a smooth field of lines and their phase on all faces. Tori and spheres of 100,000 to
/// 10,000,000 faces.
constexpr double kSecondsPerFace = 2.5e-6, kLayingPerFace = 3.5e-6;

/// Bytes for each face: of the surface, while distances along it are set up, of a flow, and while a curve is laid that
/// fills the surface.
constexpr double kSurfacePerFace = 195, kPatchesPerFace = 95, kFlowPerFace = 12, kLayingBytesPerFace = 380;
/// Bytes for each node of a flow, and what a polish and distances along the surface add to them.
constexpr double kBytesPerNode = 1165, kPolishPerNode = 420, kGeodesicPerNode = 165;
/// Long lists hand their memory on from step to step (base/page_store.h), so there are only those of one step at once:
/// bytes for each node then, and for all that is no such list. Tori of 100,000 to 10,000,000 nodes.
constexpr double kLongPerNode = 1000, kBesideLong = 80e6;

double iterations_of(double nodes, const FlowSettings& s) {
  const double growth = elementary::pow(std::max(1.0, nodes / kFewNodes), kIterationGrowth);
  const double removal = s.hairpin_removal_iterations;
  const double longer = polish_iterations(s, s.full_start) - kPolishIterations;
  if (s.polish && s.full_start) {
    const double full = kFullIterations * elementary::pow(std::max(1.0, nodes / kFewNodes), kFullGrowth);
    return std::min(full + longer, static_cast<double>(s.iteration_limit));
  }
  const double all = (s.polish ? removal + longer : 0) + growth * (s.polish ? kIterations : kUnpolishedIterations);
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
  const double per_area = (settings.polish ? kLength : kLengthUnpolished) / (2 * r);
  const bool along_surface = settings.medial_axis == MedialAxis::kGeodesic;
  Cost cost;
  cost.length = per_area * extent.length_area;
  cost.nodes = (settings.full_start ? kFullNodes : 1) * per_area * extent.node_area / (kMeanSegment * h);
  // What is too large for a number is still none times no edges.
  constexpr double kMost = std::numeric_limits<double>::max();
  cost.points = cost.nodes + kCrossings * std::min(cost.length, kMost) * std::min(extent.edge_density, kMost);

  const double per_node =
      kBytesPerNode + (settings.polish ? kPolishPerNode : 0) + (along_surface ? kGeodesicPerNode : 0);
  const double of_nodes = std::min(per_node * cost.nodes, kLongPerNode * cost.nodes + kBesideLong);
  const double flow = of_nodes + kFlowPerFace * extent.faces;
  // Gone before the curve is long.
  const double set_up = std::max(along_surface ? kPatchesPerFace : 0, settings.full_start ? kLayingBytesPerFace : 0);
  cost.memory = kSurfacePerFace * extent.faces + std::max(flow, set_up * extent.faces);

  const double of_disc = std::numbers::pi * r * r * std::min(extent.curvature, kMost);
  const double measuring = along_surface ? kSecondsPerRadian * std::min(of_disc, kMostRadians) : 0;
  const double near = settings.full_start ? std::min(cost.points, 2 * cost.nodes) : cost.points;
  const double further = std::min(cost.points, kMost) - near;
  const double iteration = (kSecondsPerNode + measuring) * cost.nodes + kSecondsPerPoint * near +
                           kSecondsPerFurtherPoint * std::max(further, 0.0);
  const double of_face = kSecondsPerFace + (settings.full_start ? kLayingPerFace : 0);
  const double faces = cost.nodes > 0 ? extent.faces : 0;  // without an area there is no run
  cost.processor_seconds = of_face * faces + iterations_of(cost.nodes, settings) * iteration;
  return cost;
}

}  // namespace meander
