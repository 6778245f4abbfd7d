// SPDX-License-Identifier: GPL-3.0-or-later
//
// Curvature along strands whose curvature is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "curve/curvature.h"
#include "curves.h"

namespace meander::test::curvature_tests {
namespace {

constexpr double kWidth = 1.5;

Surface one_face() { return make_surface(Mesh{{-1, -1, 0, 1, -1, 0, 0, 1, 0}, {0, 1, 2}}); }

/// A strand through points in units of `radius` from the middle of the only face.
Curve strand_through(const Surface& s, const std::vector<Vec2>& points, bool closed, double radius) {
  Curve curve;
  const Vec2 middle = flat(s, SurfacePoint{0, {1.0 / 3, 1.0 / 3}});
  for (const Vec2& p : points) add_node(curve, point_at(s, 0, middle + radius * p));
  curve.strands.push_back({0, static_cast<uint32_t>(points.size()), closed});
  curve.link();
  join_in_face(s, curve);
  return curve;
}

/// Points of a circle about the origin, from angle 0 to `angle`, `step` apart.
std::vector<Vec2> arc(double radius, double angle, double step, bool clockwise = false) {
  std::vector<Vec2> points;
  const auto count = static_cast<int>(std::ceil(radius * angle / step));
  for (int k = 0; k < count; ++k) {
    const double a = (clockwise ? -angle : angle) * k / count;
    points.push_back(radius * Vec2{std::cos(a), std::sin(a)});
  }
  return points;
}

NodeData<double> curvature_of(const Curve& curve, double radius, unsigned threads = 2) {
  ThreadPool pool(threads);
  return smoothed_curvature(curve, even_metric(curve, radius), kWidth, pool);
}

TEST(Curvature, OfACircleIsOneOverItsRadiusEverywhere) {
  const Surface s = one_face();
  for (const double radius : {0.8, 1.0, 2.0, 5.0}) {
    for (const bool clockwise : {false, true}) {
      for (const double unit : {0.01, 0.001}) {
        const Curve curve =
            strand_through(s, arc(radius, 2 * std::numbers::pi, 0.2, clockwise), true, unit);
        for (const double k : curvature_of(curve, unit)) EXPECT_NEAR(k * radius, 1, 0.02) << radius;
      }
    }
  }
}

TEST(Curvature, HardlyDependsOnHowLongSegmentsAre) {
  const Surface s = one_face();
  for (const double step : {0.05, 0.1, 0.2, 0.4}) {
    const Curve curve = strand_through(s, arc(1, 2 * std::numbers::pi, step), true, 0.01);
    for (const double k : curvature_of(curve, 0.01)) EXPECT_NEAR(k, 1, 0.05) << step;
  }
}

TEST(Curvature, IsFeltAsFarAsTheWidthReaches) {
  const Surface s = one_face();
  // Straight up to the half turn, and straight again: open ends.
  std::vector<Vec2> points;
  for (int k = 0; k < 40; ++k) points.push_back({1, -8 + 0.2 * k});
  for (const Vec2& p : arc(1, std::numbers::pi, 0.2)) points.push_back(p);
  for (int k = 0; k <= 40; ++k) points.push_back({-1, -0.2 * k});
  const Curve curve = strand_through(s, points, false, 0.01);
  const NodeData<double> curvature = curvature_of(curve, 0.01);
  double most = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    if (points[i].y < -kWidth - 0.2) { EXPECT_LT(curvature[i], 1e-6) << i; }
    if (points[i].y < -0.2) { EXPECT_LT(curvature[i], 0.5) << "hardly half of what is weighed lies in the turn"; }
    if (std::abs(points[i].x) < 0.1) { EXPECT_NEAR(curvature[i], 1, 0.05); }
    most = std::max(most, curvature[i]);
  }
  EXPECT_LT(most, 1.05);
}

TEST(Curvature, IsTheSameForAnyNumberOfThreads) {
  const Surface s = one_face();
  const Curve curve = strand_through(s, arc(300, 2 * std::numbers::pi, 0.3), true, 0.001);
  ASSERT_GT(curve.size(), 5000u) << "several blocks";
  EXPECT_TRUE(curvature_of(curve, 0.001, 1) == curvature_of(curve, 0.001, 3));
}

TEST(Curvature, GoesRoundASmallLoopNoMoreThanOnceEachWay) {
  const Surface s = one_face();
  const Curve curve = strand_through(s, arc(0.1, 2 * std::numbers::pi, 0.05), true, 0.01);
  // Weighed fully, both ways would be twice a whole turn.
  for (const double k : curvature_of(curve, 0.01)) EXPECT_LE(k, 2 * 2 * std::numbers::pi / kWidth);
}

}  // namespace
}  // namespace meander::test::curvature_tests
