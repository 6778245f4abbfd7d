// SPDX-License-Identifier: GPL-3.0-or-later
//
// r on the surface, and what it makes of lengths at the nodes.
#include <gtest/gtest.h>

#include <cmath>

#include "curve/local_metric.h"
#include "curves.h"

namespace meander::test::radius_field_tests {
namespace {

constexpr double kRounding = 1e-12;  // relative, of a few products

TEST(RadiusField, IsLinearBetweenVertices) {
  const Surface s = make_surface(sphere(2));
  Rng rng(5);
  VertexData<double> density(s.vertex_count());
  for (double& a : density) a = rng.in(0.1, 10);
  const RadiusField even(0.03), varying(0.03, density);
  EXPECT_FALSE(even.varies());
  EXPECT_TRUE(varying.varies());
  EXPECT_FALSE(RadiusField(0.03, {}).varies());
  for (int k = 0; k < 200; ++k) {
    const SurfacePoint p = random_point(s, rng);
    const Triangle& t = s.face(p.face);
    EXPECT_EQ(even.at(s, p), 0.03);
    EXPECT_EQ(even.at(t[0]), 0.03);
    double expected = 0;
    const double weights[3] = {p.weight(0), p.b.x, p.b.y};
    for (size_t c = 0; c < 3; ++c) expected += weights[c] * 0.03 / std::sqrt(density[t[c]]);
    EXPECT_NEAR(varying.at(s, p), expected, kRounding);
    EXPECT_EQ(varying.at(s, p), varying.at(t, p));
  }
}

TEST(RadiusField, MultiplesAndNewUnits) {
  const VertexData<double> density(std::vector<double>{1, 4});
  const RadiusField field(0.1, density);
  RadiusField other(1);
  other.set_multiple(field, 3);
  EXPECT_NEAR(other.at(0), 0.3, kRounding);
  EXPECT_NEAR(other.at(1), 0.15, kRounding);
  other.rescale(0.1, 0.2);
  EXPECT_NEAR(other.at(1), 0.3, kRounding);
  other.set_multiple(RadiusField(0.1), 2);
  EXPECT_FALSE(other.varies());
  EXPECT_NEAR(other.at(1), 0.2, kRounding);
}

TEST(LocalMetric, FollowsFromTheRadius) {
  const Surface s = make_surface(flat_grid(6));
  Rng rng(6);
  VertexData<double> density(s.vertex_count());
  for (double& a : density) a = rng.in(0.1, 10);
  const RadiusField radius(0.05, density);
  Curve curve;
  add_walk(s, curve, random_point(s, rng), 0.05, 30, 0.5, rng);
  ThreadPool pool(2);
  for (const double boundary_distance : {0.2, 0.5, 1.0, 1.5}) {
    LocalMetric metric;
    find_local_metric(s, curve, radius, {3, 0.2, boundary_distance}, pool, metric);
    for (uint32_t i = 0; i < curve.size(); ++i) {
      const double r = radius.at(s, curve.nodes[i]);
      EXPECT_EQ(metric.radius[i], r);
      EXPECT_EQ(metric.max_radius[i], std::min(3 * r, 0.2));
      EXPECT_NEAR(metric.overhang[i], r - 2 * boundary_distance * r, kRounding);
      EXPECT_EQ(metric.least_rest[i], boundary_distance > 1 ? 0 : r);
    }
  }
}

}  // namespace
}  // namespace meander::test::radius_field_tests
