// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nodes at rest reuse their cached directions: when they do, and how far off those are.
#include <gtest/gtest.h>

#include <cmath>

#include "curve/retraction.h"
#include "medial/constants.h"
#include "medial/frames.h"
#include "curves.h"

namespace meander::test::frames_tests {
namespace {

constexpr double kRadius = 0.05;
constexpr double kSinglePrecision = 1e-6;  // in which directions are cached

struct Scene {
  explicit Scene(const Mesh& mesh) : surface(make_surface(mesh)) {}

  void find(const NodeData<CachedDirections>* cached, Frames& frames) {
    metric = even_metric(curve, radius);
    compute_frames(surface, curve, metric, RadiusField(radius), pool, frames, cached);
  }

  /// Moves every node by up to `most`.
  void perturb(double most, Rng& rng) {
    NodeData<Vec2> displacement(curve.size());
    for (Vec2& d : displacement) d = rng.in(0, most) * rng.direction();
    MoveSeconds seconds;
    const Curve old = curve;
    Retraction().move(surface, old, displacement, curve, pool, seconds);
  }

  Surface surface;
  double radius = kRadius;
  LocalMetric metric;
  ThreadPool pool{2};
  Curve curve;
};

Vec3 tangent_of(const Scene& scene, const Frames& frames, uint32_t i) {
  const uint32_t before = scene.curve.previous(i), after = scene.curve.next(i);
  Vec3 sum = Vec3::Zero();
  if (before != kNone) sum += (frames.position[i] - frames.position[before]).normalized();
  if (after != kNone) sum += (frames.position[after] - frames.position[i]).normalized();
  return sum.normalized();
}

void add_rings(Scene& scene, Rng& rng) {
  for (int k = 0; k < 6; ++k) add_ring(scene.surface, scene.curve, random_point(scene.surface, rng), 0.08, 40, 0, rng);
}

TEST(CachedDirections, OfNodesThatHaveNotMovedStay) {
  for (const Mesh& mesh : {sphere(3), torus(20, 10), cube(), with_noise(sphere(2), 0.3, 5)}) {
    Scene scene(mesh);
    Rng rng(41);
    add_rings(scene, rng);
    Frames first, again;
    NodeData<CachedDirections> cached;
    scene.find(nullptr, first);
    remember_directions(first, scene.metric, scene.pool, cached);
    scene.find(&cached, again);
    for (uint32_t i = 0; i < scene.curve.size(); ++i) {
      EXPECT_TRUE(first.walked[i]);
      EXPECT_FALSE(again.walked[i]);
      for (int side = 0; side < 2; ++side) {
        EXPECT_LT((again.outward[i][side] - first.outward[i][side]).norm(), kSinglePrecision);
        EXPECT_EQ(again.to_boundary[i][side], first.to_boundary[i][side]);
        EXPECT_NEAR(again.radius_slope[i][side], first.radius_slope[i][side], kSinglePrecision);
      }
    }
  }
}

/// Repeatedly: a cached direction is compared with the place where it was traced, not with the last iteration.
TEST(CachedDirections, EndWhereNodesMoveOrTurn) {
  // Sine of the greatest angle, here and on faces a third of r wide: kFrameRest r over the radius of the
  // surface, and what the faces' edges add.
  constexpr double kMostOff = 0.06;
  for (const Mesh& mesh : {sphere(4), torus(60, 30)}) {
    Scene scene(mesh);
    Rng rng(42);
    add_rings(scene, rng);
    Frames frames, exact;
    NodeData<CachedDirections> cached;
    scene.find(nullptr, frames);
    remember_directions(frames, scene.metric, scene.pool, cached);
    size_t kept = 0, walked = 0;
    for (int step = 0; step < 12; ++step) {
      scene.perturb((step % 3 == 2 ? 0.1 : 0.002) * kRadius, rng);
      scene.find(nullptr, exact);
      scene.find(&cached, frames);
      for (uint32_t i = 0; i < scene.curve.size(); ++i) {
        const Vec3 t = tangent_of(scene, frames, i);
        bool rests = (frames.position[i] - cached[i].from.cast<double>()).norm() <= kFrameRest * kRadius;
        for (int side = 0; side < 2; ++side) {
          rests = rests && std::abs(cached[i].outward[side].cast<double>().dot(t)) <= kFrameTurn;
        }
        ASSERT_EQ(frames.walked[i] == 0, rests) << "step " << step << " node " << i;
        ++(rests ? kept : walked);
        for (int side = 0; side < 2; ++side) {
          const Vec3& outward = frames.outward[i][side];
          EXPECT_NEAR(outward.norm(), 1, 1e-12);
          EXPECT_NEAR(outward.dot(t), 0, 1e-12);
          EXPECT_LT((outward - exact.outward[i][side]).norm(), rests ? kMostOff : 1e-300);
        }
      }
      remember_directions(frames, scene.metric, scene.pool, cached);
    }
    EXPECT_GT(kept, 500u);
    EXPECT_GT(walked, 500u);
  }
}

TEST(CachedDirections, EndWhereTheSpacingChanges) {
  Scene scene(sphere(3));
  Rng rng(43);
  add_rings(scene, rng);
  Frames frames;
  NodeData<CachedDirections> cached;
  scene.find(nullptr, frames);
  remember_directions(frames, scene.metric, scene.pool, cached);
  for (const double factor : {0.9, 0.96, 1.04, 1.1}) {
    scene.radius = factor * kRadius;
    scene.find(&cached, frames);
    const bool near = std::abs(1 / factor - 1) <= kFrameRest;
    for (const uint8_t walked : frames.walked) EXPECT_EQ(walked == 0, near) << factor;
  }
}

TEST(CachedDirections, AreNotKeptAtTheBoundary) {
  Scene scene(flat_grid(6));
  Rng rng(44);
  for (int k = 0; k < 200 && scene.curve.strands.size() < 12; ++k) {
    Curve before = scene.curve;
    if (!add_ring(scene.surface, scene.curve, random_point(scene.surface, rng), 0.03, 20, 0, rng)) scene.curve = before;
  }
  Frames first, again;
  NodeData<CachedDirections> cached;
  scene.find(nullptr, first);
  remember_directions(first, scene.metric, scene.pool, cached);
  scene.find(&cached, again);
  size_t at_boundary = 0;
  for (uint32_t i = 0; i < scene.curve.size(); ++i) {
    const bool sees = first.to_boundary[i][0] >= 0 || first.to_boundary[i][1] >= 0;
    at_boundary += sees;
    EXPECT_EQ(again.walked[i] != 0, sees);
    EXPECT_EQ(again.to_boundary[i], first.to_boundary[i]);
  }
  EXPECT_GT(at_boundary, 0u);
  EXPECT_LT(at_boundary, scene.curve.size());
}

}  // namespace
}  // namespace meander::test::frames_tests
