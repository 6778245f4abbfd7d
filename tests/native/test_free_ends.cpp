// SPDX-License-Identifier: GPL-3.0-or-later
//
// Free ends of open strands: they keep their distance from what is ahead, and fill what is empty there.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "geodesic/geodesic_trace.h"
#include "medial/free_ends.h"
#include "model/constants.h"
#include "model/energy.h"
#include "outputs/gaps.h"
#include "test_seeds.h"

namespace meander::test::free_ends_tests {
namespace {

/// How far an end is from everything but the last 4 r of its own strand, in r.
double room_of_end(const Surface& s, const Curve& c, const Strand& strand, bool last, double r) {
  const uint32_t end = last ? strand.end() - 1 : strand.first;
  const Vec3 x = position(s, c.nodes[end]);
  double along = 0, nearest = std::numeric_limits<double>::infinity();
  for (uint32_t k = 1; k < strand.count; ++k) {
    const uint32_t i = last ? end - k : end + k;
    along += c.shapes[last ? i : i - 1].length;
    if (along > 4 * r) nearest = std::min(nearest, (position(s, c.nodes[i]) - x).norm());
  }
  for (uint32_t i = 0; i < c.size(); ++i) {
    if (i < strand.first || i >= strand.end()) nearest = std::min(nearest, (position(s, c.nodes[i]) - x).norm());
  }
  return nearest / r;
}

TEST(Ends, KeepFromWhatIsAheadAndFillWhatIsEmpty) {
  const auto surface = std::make_shared<const Surface>(make_surface(flat_grid(12)));
  const std::vector<Line> lines{{{{0.2, 0.5, 0}, {0.3, 0.55, 0}}, false, false},
                                {{{0.7, 0.5, 0}, {0.8, 0.55, 0}}, false, false},
                                {{{0.5, 0.8, 0}, {0.6, 0.8, 0}, {0.5, 0.7, 0}}, true, false}};
  // An end that two strands squeeze between them has less room: about one of twenty has less than 1.2 r.
  std::vector<double> rooms;
  for (int k = 0; k < 5; ++k) {
    Flow flow = flow_on(surface, lines, false, 0.056 + 0.002 * k);
    EXPECT_EQ(flow.run(kNeverCancelled, [](double) {}), StopReason::kConverged);
    const double r = flow.settings().radius;
    for (size_t s = 0; s < 2; ++s) {
      for (const bool last : {false, true}) {
        rooms.push_back(room_of_end(*surface, flow.curve(), flow.curve().strands[s], last, r));
      }
    }
    for (const Gap& gap : find_gaps(flow, 1).gaps) EXPECT_LT(gap.size, 1.8);
  }
  std::ranges::sort(rooms);
  EXPECT_GT(rooms.front(), 0.9);
  EXPECT_GT(rooms[rooms.size() / 5], 1.2);
  EXPECT_LT(rooms.back(), 2.6);
}

TEST(Ends, TheBallAheadIsTheLargestThatIsEmpty) {
  const auto surface = std::make_shared<const Surface>(make_surface(flat_grid(6)));
  // An end that faces a wall 0.2 ahead, and one that faces the boundary 0.3 ahead.
  const std::vector<Line> lines{{{{0.7, 0.5, 0}, {0.5, 0.5, 0}}, false, false},
                                {{{0.3, 0.2, 0}, {0.3, 0.8, 0}}, false, true}};
  Flow flow = flow_on(surface, lines, false, 0.1);
  Frames frames;
  ThreadPool pool(1);
  const Curve& c = flow.curve();
  const double unit = 1 / surface->scale();
  const LocalMetric metric = even_metric(c, 0.05 * unit, unit);
  compute_frames(*surface, c, metric, RadiusField(0.05 * unit), pool, frames);
  const BoundaryObstacle boundary(*surface, 0.01 * unit);
  const auto ends = find_free_ends(*surface, c, frames, boundary, BoundaryRule::kCentre, metric, pool);
  ASSERT_EQ(ends.size(), 2u);  // those of the guide do not count
  EXPECT_EQ(ends[0].node, 0u);
  EXPECT_NEAR(ends[0].radius / unit, 0.3, 1e-6);
  // Nodes of the wall are up to 2 h apart, so that a ball may bulge between them.
  EXPECT_NEAR(ends[1].radius / unit, 0.1, 0.002);
}

/// By the formula of Ma, Bae and Choi, point after point.
double largest_ball(const Vec3& x, const Vec3& outward, double most, std::span<const Vec3> points) {
  for (const Vec3& p : points) {
    const Vec3 u = p - x;
    const double ahead = u.dot(outward);
    if (u.squaredNorm() < 2 * most * ahead) most = u.squaredNorm() / (2 * ahead);
  }
  return most;
}

/// Strokes about as long as their places in a square of count x count of them are wide.
std::vector<Line> strokes(int count) {
  std::vector<Line> lines;
  Rng rng(5);
  for (int k = 0; k < count * count; ++k) {
    const Vec3 middle((k % count + 0.5) / count, (k / count + 0.5) / count, 0);
    const Vec2 half = (rng.in(0.1, 0.45) / count) * rng.direction();
    lines.push_back({{middle - Vec3(half.x, half.y, 0), middle + Vec3(half.x, half.y, 0)}, false, false});
  }
  return lines;
}

TEST(Ends, OfManyStrandsSeeWhatBruteForceSees) {
  const auto surface = std::make_shared<const Surface>(make_surface(flat_grid(12)));
  for (const int count : {2, 40}) {  // few ends, for which no tree is built, and many
    const Flow flow = flow_on(surface, strokes(count), false, 0.5 / count);
    const Curve& c = flow.curve();
    const double r = 0.25 / count / surface->scale();
    ThreadPool pool(2);
    const BoundaryObstacle boundary(*surface, 0.5 * r);
    for (const double most : {3 * r, 0.3}) {
      const LocalMetric metric = even_metric(c, r, most);
      Frames frames;
      compute_frames(*surface, c, metric, RadiusField(r), pool, frames);
      for (const BoundaryRule rule : {BoundaryRule::kCentre, BoundaryRule::kObstacle}) {
        const auto ends = find_free_ends(*surface, c, frames, boundary, rule, metric, pool);
        ASSERT_EQ(ends.size(), 2u * static_cast<size_t>(count * count));
        for (size_t k = 0; k < ends.size(); k += 7) {
          const uint32_t i = ends[k].node;
          Path path;
          const Trace ahead = trace_geodesic(*surface, c.nodes[i], r * ends[k].ahead, path);
          const Vec3 outward = (position(*surface, ahead.end) - frames.position[i]).normalized();
          double radius = most;
          if (rule == BoundaryRule::kCentre) {
            const Trace to_boundary = trace_geodesic(*surface, c.nodes[i], most * ends[k].ahead, path);
            if (to_boundary.hit_boundary) radius = to_boundary.length;
          }
          radius = largest_ball(frames.position[i], outward, radius, frames.position.values());
          if (rule == BoundaryRule::kObstacle) {
            radius = largest_ball(frames.position[i], outward, radius, boundary.samples());
          }
          EXPECT_EQ(ends[k].radius, radius) << "end " << k << " of " << ends.size();
        }
      }
    }
  }
}

/// With a time that grows with the square of their number this takes minutes where it is sanitized.
TEST(Ends, OfVeryManyStrandsAreFound) {
  constexpr int kCount = 160;
  const auto surface = std::make_shared<const Surface>(make_surface(flat_grid(12)));
  const Flow flow = flow_on(surface, strokes(kCount), false, 0.5 / kCount);
  const Curve& c = flow.curve();
  const double r = 0.25 / kCount / surface->scale(), most = 3 * r;
  ThreadPool pool(1);
  const BoundaryObstacle boundary(*surface, 0.5 * r);
  const LocalMetric metric = even_metric(c, r, most);
  Frames frames;
  compute_frames(*surface, c, metric, RadiusField(r), pool, frames);
  const auto ends = find_free_ends(*surface, c, frames, boundary, BoundaryRule::kObstacle, metric, pool);
  ASSERT_EQ(ends.size(), 2u * kCount * kCount);
  for (size_t k = 0; k < ends.size(); k += 1009) {
    const uint32_t i = ends[k].node;
    Path path;
    const Trace ahead = trace_geodesic(*surface, c.nodes[i], r * ends[k].ahead, path);
    const Vec3 outward = (position(*surface, ahead.end) - frames.position[i]).normalized();
    const double radius = largest_ball(frames.position[i], outward, most, frames.position.values());
    EXPECT_EQ(ends[k].radius, largest_ball(frames.position[i], outward, radius, boundary.samples())) << "end " << k;
  }
}

TEST(Ends, TheTermAloneMovesAnEndByWhatIsMissing) {
  StrandSystem system;
  ThreadPool pool(1);
  system.reset(3, pool);
  const Vec2 ahead{0.6, 0.8};
  system.frame[2] = Vec2{0, 1};
  add_end_term({7, ahead, 0.5}, 2, 0.2, 1.5, system);
  const Vec2 z = (1 / system.diagonal[2]) * (system.frame[2] * system.right[2]);
  EXPECT_NEAR(z.x, 0.3 * ahead.x, 1e-15);
  EXPECT_NEAR(z.y, 0.3 * ahead.y, 1e-15);
  EXPECT_NEAR(system.diagonal[2], 2 * 1.5 * kAlphaRadiusSquared / 0.2, 1e-12);
  EXPECT_EQ(system.diagonal[0], 0);
}

}  // namespace
}  // namespace meander::test::free_ends_tests
