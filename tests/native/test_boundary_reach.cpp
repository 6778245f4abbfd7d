// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the boundary leaves of the balls, against the distance to it and every point of it.
#include <gtest/gtest.h>

#include "geodesic/geodesic_trace.h"
#include "medial/boundary_reach.h"
#include "curves.h"

namespace meander::test::boundary_reach_tests {
namespace {

struct Scene {
  explicit Scene(const Mesh& mesh, int walks = 40, double step = 0.01, int nodes = 10)
      : surface(make_surface(mesh)), boundary(surface, step) {
    Rng rng(71);
    for (int k = 0; k < walks; ++k) {
      add_walk(surface, curve, random_point(surface, rng), 0.02, nodes, 0.4, rng);
    }
    ThreadPool pool(1);
    compute_frames(surface, curve, even_metric(curve, kRadius), RadiusField(kRadius), pool, frames);
  }

  NodeData<Reach> reach(BoundaryRule rule, double most, double overhang, double rest, unsigned threads = 1) const {
    ThreadPool pool(threads);
    NodeData<Reach> result;
    const LocalMetric metric = even_metric(curve, kRadius, most, overhang, rest);
    compute_reach(in(metric, rule), {}, pool, result);
    return result;
  }

  ReachScene in(const LocalMetric& metric, BoundaryRule rule = BoundaryRule::kCentre) const {
    return {surface, curve, frames, boundary, rule, nullptr, metric};
  }

  /// The distance along the surface, infinite where the boundary is farther than `most`.
  double distance(uint32_t node, size_t side, double most) const {
    Path path;
    const Trace trace =
        trace_geodesic(surface, curve.nodes[node], (side == 0 ? most : -most) * frames.bitangent2[node], path);
    return trace.hit_boundary ? trace.length : std::numeric_limits<double>::infinity();
  }

  /// |d|^2 over the part of d that is ahead: twice the radius of the ball that touches the sample at d. Only
  /// for samples that face the node, within 60 degrees.
  double distance_to_corners(uint32_t node, size_t side) const {
    double least = std::numeric_limits<double>::infinity();
    for (size_t k = 0; k < boundary.samples().size(); ++k) {
      const Vec3 d = boundary.samples()[k] - frames.position[node];
      const double ahead = d.dot(frames.outward[node][side]);
      if (boundary.inward()[k].dot(frames.outward[node][side]) > -0.5) continue;
      if (ahead > 0) least = std::min(least, d.squaredNorm() / ahead);
    }
    return least;
  }

  static constexpr double kRadius = 0.1;
  Surface surface;
  BoundaryObstacle boundary;
  Curve curve;
  Frames frames;
};

constexpr double kMost = 0.3, kRounding = 1e-12;

TEST(Reach, IsTheClampWhereThereIsNoBoundary) {
  const Scene scene(sphere(2));
  for (const Reach& reach : scene.reach(BoundaryRule::kCentre, kMost, 0, Scene::kRadius)) {
    for (const ReachOfSide& side : reach) {
      EXPECT_EQ(side.radius, kMost);
      EXPECT_EQ(side.sought, kMost);
    }
  }
}

/// However few the samples that tell that the boundary is near: of a square's edges their ends only.
TEST(Reach, IsTheDistanceToTheBoundary) {
  for (const auto& [mesh, step] :
       {std::pair{grid_with_hole(9), 0.01}, {grid_with_hole(9), 1.0}, {flat_grid(1, 0), 1.0}}) {
    const Scene scene(mesh, 40, step);
    for (const double overhang : {-0.05, 0.0, 0.05}) {
      const NodeData<Reach> reach = scene.reach(BoundaryRule::kCentre, kMost, overhang, 0);
      for (uint32_t i = 0; i < scene.curve.size(); ++i) {
        for (size_t side = 0; side < 2; ++side) {
          const double distance = scene.distance(i, side, 1);
          EXPECT_NEAR(reach[i][side].radius, std::clamp(distance + overhang, 0.0, kMost), kRounding);
          EXPECT_EQ(reach[i][side].sought, kMost);
        }
      }
    }
  }
}

/// Long strands come near the boundary and leave it again: what their neighbours know is never believed wrongly.
TEST(Reach, IsTheDistanceAllAlongAStrand) {
  const Scene scene(grid_with_hole(9), 8, 0.01, 150);
  constexpr double kNear = 0.04;
  int far = 0, near = 0;
  const NodeData<Reach> reach = scene.reach(BoundaryRule::kCentre, kNear, 0, kNear / 2);
  for (uint32_t i = 0; i < scene.curve.size(); ++i) {
    for (size_t side = 0; side < 2; ++side) {
      const double straight = scene.distance(i, side, 1), corner = scene.distance_to_corners(i, side);
      const double distance = corner < kNear / 2 ? std::min(straight, corner) : straight;
      EXPECT_NEAR(reach[i][side].radius, std::min(kNear, distance), kRounding);
      ++(distance < kNear ? near : far);
    }
  }
  EXPECT_GT(near, 50);
  EXPECT_GT(far, 500);
}

/// Looked for as far as balls probably reach, and then as far as they do, the boundary leaves of them what it leaves if
/// it is looked for everywhere, to the last bit: what the last iteration knew must not show in what this one finds.
TEST(Reach, IsTheSameHoweverFarItWasSought) {
  const Scene scene(grid_with_hole(9), 8, 0.01, 150);
  Rng rng(72);
  ThreadPool pool(2);
  for (const double overhang : {-0.05, 0.0, 0.05}) {
    for (const double rest : {0.0, 0.1}) {
      const LocalMetric metric = even_metric(scene.curve, Scene::kRadius, kMost, overhang, rest);
      const NodeData<Reach> whole = scene.reach(BoundaryRule::kCentre, kMost, overhang, rest);
      for (const double least : {0.0, 2.0}) {
        NodeData<Radii> likely(scene.curve.size()), radii(scene.curve.size());
        for (uint32_t i = 0; i < scene.curve.size(); ++i) {
          for (size_t side = 0; side < 2; ++side) {
            likely[i][side] = rng.in(0, 1) < 0.1 ? 0 : rng.in(0.1, 0.7) * kMost;
            radii[i][side] = rng.in(0, 1) * kMost;
          }
        }
        NodeData<Reach> reach;
        ReachScene in = scene.in(metric);
        in.plan.boundary_within = least;
        compute_reach(in, likely, pool, reach);
        size_t cut_short = 0, completed = 0, limited = 0;
        for (uint32_t i = 0; i < scene.curve.size(); ++i) {
          for (size_t side = 0; side < 2; ++side) {
            const double sought = reach[i][side].sought, should = whole[i][side].radius;
            EXPECT_GE(sought, std::min({kMost, std::max({rest, least * Scene::kRadius, kWarmth * likely[i][side]})}));
            EXPECT_EQ(std::min(sought, reach[i][side].radius), std::min(sought, should));
            EXPECT_EQ(std::min(sought, reach[i][side].driving), std::min(sought, whole[i][side].driving));
            cut_short += sought < kMost;
            completed += radii[i][side] > sought;
            limited += should < reach[i][side].radius && should < radii[i][side];
            radii[i][side] = std::min(radii[i][side], reach[i][side].radius);  // as the medial axis does
          }
        }
        NodeData<Radii> found = radii;
        complete_reach(in, pool, reach, found);
        for (uint32_t i = 0; i < scene.curve.size(); ++i) {
          for (size_t side = 0; side < 2; ++side) {
            EXPECT_EQ(found[i][side], std::min(radii[i][side], whole[i][side].radius));
            EXPECT_GE(reach[i][side].sought, found[i][side]);
          }
        }
        EXPECT_GT(cut_short, 300u);
        EXPECT_GT(completed, 20u);
        if (least == 0 && rest == 0) {
          EXPECT_GT(limited, 5u) << "nothing was found late";
        }
      }
    }
  }
}

TEST(Reach, OfAnObstacleIsTheDistanceAlone) {
  const Scene scene(grid_with_hole(9));
  const NodeData<Reach> plain = scene.reach(BoundaryRule::kCentre, kMost, 0, 0);
  const NodeData<Reach> walls =
      scene.reach(BoundaryRule::kObstacle, kMost, 0.05, Scene::kRadius);
  for (uint32_t i = 0; i < scene.curve.size(); ++i) {
    for (size_t side = 0; side < 2; ++side) EXPECT_EQ(plain[i][side].radius, walls[i][side].radius);
  }
}

/// In the square's plane: away from the outline, and out of the hole; at corners, between both edges.
TEST(Reach, SamplesKnowTheWayIntoTheSurface) {
  const Scene scene(grid_with_hole(9));
  const Surface& s = scene.surface;
  for (size_t k = 0; k < scene.boundary.samples().size(); ++k) {
    const Vec3 &x = scene.boundary.samples()[k], &in = scene.boundary.inward()[k];
    EXPECT_NEAR(in.norm(), 1, kRounding);
    const uint32_t f = face_of(scene.boundary.edges()[k]);
    const Vec3 middle = (s.position(s.face(f)[0]) + s.position(s.face(f)[1]) + s.position(s.face(f)[2])) / 3;
    EXPECT_NEAR(in.dot(s.face_normal(f)), 0, 1e-6);
    const bool within = k > 0 && scene.boundary.edges()[k - 1] == scene.boundary.edges()[k];
    if (within) {
      EXPECT_GT(in.dot(middle - x), 0);
    }
  }
}

/// A strand that runs into the boundary has room on both sides: the boundary ahead does not face them.
TEST(Reach, OfAStrandThatRunsIntoTheBoundaryIsTheDistanceAlone) {
  const Scene scene(flat_grid(9));
  const NodeData<Reach> reach =
      scene.reach(BoundaryRule::kCentre, kMost, 0, Scene::kRadius);
  int nodes = 0;
  for (uint32_t i = 0; i < scene.curve.size(); ++i) {
    const double distance = std::min(scene.distance(i, 0, 1), scene.distance(i, 1, 1));
    const double nearest =
        std::sqrt(scene.boundary.tree().nearest(scene.frames.position[i])->squared_distance);
    if (nearest > 0.5 * Scene::kRadius || distance < kMost) continue;
    ++nodes;
    for (size_t side = 0; side < 2; ++side) EXPECT_EQ(reach[i][side].radius, kMost);
  }
  EXPECT_GT(nodes, 0);
}

TEST(Reach, IsTheSameForAnyNumberOfThreads) {
  const Scene scene(grid_with_hole(9), 130);  // more nodes than a thread takes at once
  ASSERT_GT(scene.curve.size(), 1024u);
  const auto with = [&](unsigned threads) {
    return scene.reach(BoundaryRule::kCentre, kMost, 0, Scene::kRadius, threads);
  };
  EXPECT_EQ(with(1), with(2));
  EXPECT_EQ(with(1), with(3));
}

/// With how much ease the boundary pushes, and how much faster than the distance what drives falls at least.
class PushOfTheBoundary : public testing::TestWithParam<std::pair<double, double>> {};

/// Below the distance asked for, corners beside the straight line count, and the closer the boundary,
/// the harder it pushes.
TEST_P(PushOfTheBoundary, FeelsCornersAndFallsNoSlowerThanTheDistance) {
  const Scene scene(grid_with_hole(9));
  const double rest = Scene::kRadius;
  const auto [ease, times] = GetParam();
  const LocalMetric metric = even_metric(scene.curve, Scene::kRadius, kMost, 0, rest);
  ReachScene eased = scene.in(metric);
  eased.plan.boundary_ease = ease;
  ThreadPool pool(1);
  NodeData<Reach> reach;
  compute_reach(eased, {}, pool, reach);
  int corners = 0;
  std::vector<std::array<double, 2>> felt;  // the distance, and what drives
  for (uint32_t i = 0; i < scene.curve.size(); ++i) {
    for (size_t side = 0; side < 2; ++side) {
      const double straight = scene.distance(i, side, 1), corner = scene.distance_to_corners(i, side);
      const double distance = corner < rest ? std::min(straight, corner) : straight;
      const double driving = reach[i][side].driving;
      EXPECT_NEAR(reach[i][side].radius, std::min(kMost, distance), kRounding);
      if (distance >= rest) {
        EXPECT_EQ(driving, reach[i][side].radius);
        continue;
      }
      corners += corner < straight - 0.1 * rest;
      if (times > 1 || distance < eased.plan.very_near * rest) {
        EXPECT_LT(driving, distance);
      } else {
        EXPECT_NEAR(driving, distance, kRounding);
      }
      felt.push_back({distance, driving});
    }
  }
  EXPECT_GT(corners, 5);
  ASSERT_GT(felt.size(), 20u);
  std::sort(felt.begin(), felt.end());
  for (size_t k = 1; k < felt.size(); ++k) {
    EXPECT_GE(felt[k][1] - felt[k - 1][1], times * (felt[k][0] - felt[k - 1][0]) - kRounding);
  }
  EXPECT_LT(felt.front()[1], 0) << "at the boundary it pushes harder than an empty ball";
}

INSTANTIATE_TEST_SUITE_P(Reach, PushOfTheBoundary,
                         testing::Values(std::pair{0.0, 2.0}, std::pair{0.5, 1.5}, std::pair{1.0, 1.0}));

}  // namespace
}  // namespace meander::test::boundary_reach_tests
