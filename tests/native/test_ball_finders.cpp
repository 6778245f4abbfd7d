// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every finder of balls along the surface by itself, against the exact search.
#include <gtest/gtest.h>

#include "filled_surfaces.h"
#include "medial/ball_choice.h"
#include "medial/centre_ball.h"
#include "medial/empty_balls.h"
#include "medial/measured_ball.h"
#include "medial/straight_ball.h"

namespace meander::test::ball_finders_tests {
namespace {

/// How often what a finder has found was right, and how often it was too large or too small.
struct Score {
  size_t all = 0, right = 0, too_large = 0, too_small = 0;

  void add(Verdict verdict) {
    ++all;
    right += verdict == Verdict::kRight;
    too_large += verdict == Verdict::kTooLarge;
    too_small += verdict == Verdict::kTooSmall;
  }
  double share(size_t count) const { return static_cast<double>(count) / static_cast<double>(all); }
};

struct Scores {
  Score straight, windows, lines, rays, centre;
};

/// The finders at every third node beside a crease.
Scores scores_on(const Mesh& mesh) {
  constexpr double kLargest = 1.5;  // in r
  Filling f(mesh, of_radius_one());
  GeodesicDistance geodesic(f.surface);
  const Obstacles obstacles(f.surface, f.patches, f.curve, f.frames, f.boundary, BoundaryRule::kCentre, f.pool);
  const CurveBvh tree(obstacles.positions(), f.pool);
  PointsOfFaces points;
  points.sort(f.surface, f.curve.size(), [&](uint32_t i) { return obstacles.point(i); }, f.pool);
  const GeodesicScene scene{f.surface, f.patches, f.curve, f.frames, obstacles, tree, true, points};
  BallScratch scratch(scene);
  Scores scores;
  for (uint32_t i = 0; i < f.curve.size(); i += 3) {
    if (!f.patches.creased(obstacles.patch(i))) continue;
    for (size_t side = 0; side < 2; ++side) {
      const double most = std::min(kLargest * f.r, f.reach[i][side].radius);
      if (!(most > 0)) continue;
      const auto seen = count_where([&](uint32_t j) { return scene.sees(i, j); });
      const BallStart start{f.frames.position[i], f.frames.outward[i][side]};
      const SoughtBall ball(scene, i, side, f.r, most, most, largest_ball(tree, start, most, seen));
      const auto judge = [&](Score& score, double radius) { score.add(judged(f, geodesic, i, side, radius, most)); };
      if (const auto radius = straight_ball(ball)) judge(scores.straight, *radius);
      if (const auto radius = scratch.windows.largest(f.curve.nodes[i], i, ball.ahead, most)) {
        judge(scores.windows, *radius);
      }
      const StrandNeighbours own(ball);
      double found = most;
      if (ball.meets_straight() && !f.patches.opposite(ball.patch, obstacles.patch(ball.straight.touched))) {
        const MeasuredRadius measured = measured_ball(ball, own);
        if (measured.whole) judge(scores.lines, found = measured.radius);
      }
      scratch.sightings.forget();
      const double by_rays = ball_by_rays(ball, own, own.radius, scratch.sightings);
      judge(scores.rays, by_rays);
      judge(scores.centre, ball_from_centre(ball, std::min(found, by_rays), scratch.near));
    }
  }
  return scores;
}

/// What lines, windows and rays have come across is as near as they say, so that balls are not too small; a part of
/// what there is they do not come across.
TEST(BallFinders, FindTheExactBalls) {
  Scores all;
  const auto add = [](Score& sum, const Score& score) {
    sum.all += score.all;
    sum.right += score.right;
    sum.too_large += score.too_large;
    sum.too_small += score.too_small;
  };
  for (const Mesh& mesh : {scaled(cube(), 8), wedge(15, 3, 30), plate(15, 0.5, 30), plate(15, 0.5, 1),
                           scaled(bent_sheet(20, 0.5 * kPi), 20)}) {
    const Scores scores = scores_on(mesh);
    add(all.straight, scores.straight);
    add(all.windows, scores.windows);
    add(all.lines, scores.lines);
    add(all.rays, scores.rays);
    add(all.centre, scores.centre);
  }
  const auto expect = [](const char* name, const Score& score, double right, double too_small) {
    SCOPED_TRACE(std::to_string(score.all) + " balls, right " + std::to_string(score.share(score.right)) +
                 ", too large " + std::to_string(score.share(score.too_large)) + ", too small " +
                 std::to_string(score.share(score.too_small)));
    EXPECT_GT(score.all, 100u) << name;
    EXPECT_GE(score.share(score.right), right) << name;
    EXPECT_LE(score.share(score.too_small), too_small) << name;
  };
  // As measured, less about what it varies by where the curve is another.
  expect("straight", all.straight, 0.99, 0.005);
  expect("windows", all.windows, 0.98, 0.005);
  expect("lines", all.lines, 0.97, 0.005);
  expect("rays", all.rays, 0.97, 0.01);
  expect("centre", all.centre, 0.98, 0.01);
}

}  // namespace
}  // namespace meander::test::ball_finders_tests
