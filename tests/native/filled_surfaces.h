// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces of every kind that balls along the surface have to do with, curves that fill them, and what a ball is by
// definition.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <vector>

#include "api/flow_options.h"
#include "curves.h"
#include "flow/flow.h"
#include "geodesic/patch_comparison.h"
#include "geodesic_distance.h"
#include "medial/geodesic_medial_axis.h"
#include "thin_surfaces.h"

namespace meander::test {

/// A surface measured in r, and the share of balls of less than 1.5 r that the fast way finds to within 5 % on a curve
/// that fills it.
struct Filled {
  const char* name;
  Mesh mesh;
  double share;
};

inline std::ostream& operator<<(std::ostream& out, const Filled& filled) { return out << filled.name; }

/// `share` is what was measured, less about what it varies by where the curve is another.
inline std::vector<Filled> filled_surfaces() {
  const auto tube = [](double radius, uint32_t along, double length) {
    return scaled(cylinder(16, along, length / radius), radius);
  };
  return {{"sphere", scaled(sphere(3), 6), 0.995},
          {"torus", scaled(torus(60, 30), 5), 0.995},
          {"plane", scaled(flat_grid(20), 20), 0.999},
          {"bumps", scaled(bumpy_grid(30), 20), 0.995},
          {"plate_002", plate(15, 0.02, 30), 0.988},
          {"plate_01", plate(15, 0.1, 30), 0.989},
          {"plate_05", plate(15, 0.5, 30), 0.99},
          {"plate_1", plate(15, 1, 30), 0.99},
          {"plate_05_of_twelve_faces", plate(15, 0.5, 1), 0.99},
          {"leaf", leaf(15, 0.1, 1.5, 40), 0.986},
          {"wedge", wedge(15, 3, 30), 0.99},
          {"cloth_01", folded_cloth(8, 15, 0.1, 3, 24), 0.99},
          {"cloth_05", folded_cloth(8, 15, 0.5, 3, 24), 0.99},
          {"sheets_through_each_other", scaled(two_sheets(12, 0.6, 0), 15), 0.99},
          {"sheets_one_above_the_other", scaled(two_sheets(12, 0, 0.02), 15), 0.99},
          {"bent_45", scaled(bent_sheet(20, 0.25 * kPi), 20), 0.99},
          {"bent_90", scaled(bent_sheet(20, 0.5 * kPi), 20), 0.99},
          {"bent_170", scaled(bent_sheet(20, 0.94 * kPi), 20), 0.99},
          {"cube", scaled(cube(), 8), 0.99},
          {"octahedron", scaled(octahedron(), 8), 0.99},
          {"prism_of_three_sides", scaled(cylinder(3, 12, 6), 4), 0.99},
          {"prism_of_six_sides", scaled(cylinder(6, 12, 8), 3), 0.99},
          {"tube_06", tube(0.6, 80, 80), 0.99},
          {"tube_1", tube(1, 60, 60), 0.99}};
}

/// A curve that has grown on a surface, and what its balls are found in.
struct Filling {
  std::shared_ptr<const Surface> shared;
  const Surface& surface = *shared;
  FlowSettings settings;
  Flow flow;
  const Curve& curve = flow.curve();
  double r = settings.radius;
  ThreadPool pool{1};
  BoundaryObstacle boundary{surface, 0.5 * r};
  SurfacePatches patches = compared_patches(surface, RadiusField(r), settings.max_radius / r, pool);
  LocalMetric metric;
  Frames frames;
  NodeData<Reach> reach;

  Filling(const Mesh& mesh, const meander_flow_options& options)
      : shared(std::make_shared<const Surface>(make_surface(mesh))),
        settings(checked_settings(options, surface)),
        flow(shared, nullptr, {}, settings) {
    flow.run([] { return false; }, [](double) {});
    metric = even_metric(curve, r, settings.max_radius);
    compute_frames(surface, curve, metric, RadiusField(r), pool, frames);
    compute_reach({surface, curve, frames, boundary, BoundaryRule::kCentre, &patches, metric}, {}, pool, reach);
  }
  /// `radii`  as of compute_geodesic_medial_axis
  NodeData<Radii> radii(bool measure, unsigned threads, KeptBalls kept = {}, NodeData<Radii> radii = {}) const {
    ThreadPool several(threads);
    CurveBvh tree;
    compute_geodesic_medial_axis(surface, patches, curve, frames, boundary, BoundaryRule::kCentre, measure, metric,
                                 reach, several, tree, radii, kept);
    return radii;
  }
};

inline meander_flow_options of_radius_one() {
  meander_flow_options options = default_options(MEANDER_PRESET_EVEN);
  options.radius = 1;
  options.threads = 1;
  // The r of these tests is the one that the flow works with.
  EXPECT_EQ(meander_flow_options_set_tuning(&options, "polish_rest", 1, nullptr), MEANDER_STATUS_OK);
  return options;
}

/// Whether a ball beside a node holds another node, by definition: its centre is the end of a geodesic, and distances
/// go along the surface.
inline bool holds_a_node(const Filling& f, GeodesicDistance& geodesic, uint32_t i, size_t side, double radius) {
  const Vec2 outward = (side == 0 ? radius : -radius) * f.frames.bitangent2[i];
  Path path;
  const SurfacePoint centre = trace_geodesic(f.surface, f.curve.nodes[i], outward, path).end;
  std::vector<GeodesicDistance::Target> nodes;
  for (uint32_t p = 0; p < f.curve.size(); ++p) {
    const Vec3& place = f.frames.position[p];
    if (p == i || (place - position(f.surface, centre)).norm() >= radius) continue;
    nodes.push_back({{f.curve.nodes[p].face, flat(f.surface, f.curve.nodes[p])}, place, radius, {}, false});
  }
  if (!nodes.empty()) geodesic.measure({centre.face, flat(f.surface, centre)}, nodes, true);
  return std::ranges::any_of(nodes, [](const auto& node) { return node.reached; });
}

/// How a radius differs from that of the largest empty ball beside a node by more than 5 %, as far as such balls are
/// less than `most`. Balls that are tangent at a node are nested, so two of them tell.
enum class Verdict { kRight, kTooLarge, kTooSmall };
inline Verdict judged(const Filling& f, GeodesicDistance& geodesic, uint32_t i, size_t side, double radius,
                      double most) {
  constexpr double kWithin = 0.05;
  const double less = radius / (1 + kWithin), more = radius / (1 - kWithin);
  if (less > most || holds_a_node(f, geodesic, i, side, less)) return Verdict::kTooLarge;
  return more >= most || holds_a_node(f, geodesic, i, side, more) ? Verdict::kRight : Verdict::kTooSmall;
}

}  // namespace meander::test
