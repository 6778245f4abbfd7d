// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is near to a node of a network, whatever the spacings there, against a look at every node.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geodesic/geodesic_trace.h"
#include "geodesic/patch_comparison.h"
#include "seed/line_network.h"
#include "meshes.h"

namespace meander::test::line_network_tests {
namespace {

TEST(LineNetwork, FindsWhatIsNearWhereSpacingsDiffer) {
  const Surface surface = make_surface(flat_grid(8));
  VertexData<double> density(std::vector<double>(surface.vertex_count(), 1));
  for (uint32_t v = 0; v < surface.vertex_count(); ++v) {
    density[v] = std::pow(10.0, 5.6 * surface.position(v).x());
  }
  const RadiusField radius(0.1, density);
  ThreadPool pool(1);
  const SurfacePatches patches = compared_patches(surface, radius, 3, pool);
  LineNetwork network(surface, patches, radius);
  Rng rng(7);
  const auto random_node = [&] {
    const double x = rng(), y = rng() * (1 - x);
    return network.make_node(make_point(rng.below(surface.face_count()), 1 - x - y, x, y), rng.below(9), rng());
  };
  for (int k = 0; k < 400; ++k) network.add_node(random_node());
  const LineNetwork::Mark mark = network.mark();
  for (int k = 0; k < 100; ++k) network.add_node(random_node());
  network.take_back(mark);
  for (int k = 0; k < 300; ++k) {
    const LineNetwork::Node node = random_node();
    const double reach = rng.in(0.5, 6.5) * node.radius;
    std::vector<uint32_t> found, near;
    network.near(node, reach, [&](uint32_t i, double) {
      found.push_back(i);
      return false;
    });
    // The square is flat, and nothing in it is hidden.
    for (uint32_t i = 0; i < network.nodes().size(); ++i) {
      if ((network.nodes()[i].place - node.place).norm() < reach) near.push_back(i);
    }
    std::ranges::sort(found);
    if (reach < 2 * node.radius) {
      EXPECT_EQ(found, near);
    }
    EXPECT_TRUE(std::ranges::includes(near, found));
    EXPECT_EQ(std::ranges::adjacent_find(found), found.end());
  }
}

TEST(LineNetwork, HasNoEdgeThatWindsRoundWhatIsThinner) {
  const Surface surface = make_surface(cylinder(24, 4, 4));
  const RadiusField radius(4.0);
  ThreadPool pool(1);
  const SurfacePatches patches = compared_patches(surface, radius, 3, pool);
  LineNetwork network(surface, patches, radius);
  uint32_t face = 0, corner = 0;
  const auto height = [&](uint32_t k) { return surface.position(surface.face(face)[k % 3]).z(); };
  while (height(corner) != height(corner + 1)) ++corner;
  const SurfacePoint start = make_point(face, 0.4, 0.3, 0.3);
  const uint32_t node = network.add_node(network.make_node(start, 0, 0));
  const Vec2 once = 24.0 * surface.along(3 * face + corner);
  const auto touches = [&](double turns) {
    Path path;
    const Trace trace = trace_geodesic(surface, start, turns * once, path);
    EXPECT_FALSE(trace.hit_boundary);
    return network.touches(node, kNone, trace.end, path);
  };
  EXPECT_FALSE(touches(0.4));
  EXPECT_FALSE(touches(0.9));
  EXPECT_TRUE(touches(1.1));
  EXPECT_TRUE(touches(-3));
}

}  // namespace
}  // namespace meander::test::line_network_tests
