// SPDX-License-Identifier: GPL-3.0-or-later
//
// Guides: what was drawn stays as drawn, everything else flows around it, and regions between guides
// get strands of their own.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "base/segment_distance.h"
#include "outputs/statistics.h"
#include "seed/regions.h"
#include "test_seeds.h"

namespace meander::test::guides_tests {
namespace {

/// Every node and crossing of all guides, to the last bit.
std::vector<double> bytes_of_guides(const Curve& c) {
  std::vector<double> bytes;
  for (uint32_t i = 0; i < c.size(); ++i) {
    if (!c.on_guide(i)) continue;
    bytes.insert(bytes.end(), {double(c.nodes[i].face), c.nodes[i].b.x, c.nodes[i].b.y});
    for (const Crossing& x : c.paths[i]) bytes.insert(bytes.end(), {double(x.e), x.t});
  }
  return bytes;
}

double radius_of(const Flow& flow) { return flow.settings().radius; }

/// Distance of a point from the strands that grow (segments as straight lines).
double distance_to_growth(const Surface& s, const Curve& c, const Vec3& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (uint32_t i = 0; i < c.size(); ++i) {
    if (c.on_guide(i) || !c.has_segment(i)) continue;
    nearest = std::min(nearest, distance_to_segment(p, position(s, c.nodes[i]), position(s, c.nodes[c.next(i)])));
  }
  return nearest;
}

struct Case {
  const char* name;
  Mesh mesh;
  std::vector<Line> lines;
  double spacing;
};

std::vector<Vec3> circle(double radius, double height, int count, double x = 0, double y = 0) {
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) {
    const double a = 2 * kPi * k / count;
    points.emplace_back(x + radius * std::cos(a), y + radius * std::sin(a), height);
  }
  return points;
}

std::vector<Case> cases() {
  const double z = 0.3, rim = std::sqrt(1 - z * z);
  return {
      {"square", flat_grid(7), {{{{0.2, 0.2, 0}, {0.8, 0.3, 0}, {0.5, 0.7, 0}}}}, 0.1},
      {"square_of_two_faces", flat_grid(1), {{{{0.2, 0.2, 0}, {0.8, 0.3, 0}, {0.5, 0.7, 0}}}}, 0.1},
      {"network", flat_grid(9),
       {{{{0, 0.5, 0}, {1, 0.5, 0}}}, {{{0.5, 0.5, 0}, {0.5, 1, 0}}}, {{{0.3, 0, 0}, {0.3, 0.5, 0}}}}, 0.1},
      {"circle_on_sphere", sphere(3), {{circle(rim, z, 12), true}}, 0.3},
      {"cube", cube(), {{{{0.2, 0.2, 1}, {0.8, 0.5, 1}, {1, 0.5, 0.6}}}}, 0.15},
      {"torus_and_octahedron", joined(torus(24, 12), octahedron(), 4), {{{{1.4, 0, 0}, {0, 1.4, 0}}}}, 0.25},
  };
}

TEST(Guides, StayAsTheyAreWhileTheRestGrows) {
  for (const Case& c : cases()) {
    for (const uint32_t preset : {MEANDER_PRESET_EVEN, MEANDER_PRESET_PAPER}) {
      SCOPED_TRACE(c.name + std::string(preset == MEANDER_PRESET_PAPER ? ", paper" : ", even"));
      const auto surface = std::make_shared<const Surface>(make_surface(c.mesh));
      Flow flow = flow_on(surface, c.lines, true, c.spacing, preset);
      const std::vector<double> before = bytes_of_guides(flow.curve());
      ASSERT_FALSE(before.empty());
      const size_t strands = flow.curve().strands.size();
      for (int k = 0; k < 25 && !HasFatalFailure(); ++k) {
        SCOPED_TRACE("iteration " + std::to_string(k + 1));
        ASSERT_TRUE(flow.step(kNeverCancelled));
        ASSERT_TRUE(whole(*surface, flow.curve()));
        ASSERT_TRUE(crossings_of_what_grows(*surface, flow.curve()).empty());
        ASSERT_EQ(bytes_of_guides(flow.curve()), before);
        ASSERT_EQ(flow.curve().strands.size(), strands);
        for (size_t s = 0; s < c.lines.size(); ++s) {
          ASSERT_TRUE(flow.curve().strands[s].guide);
          ASSERT_EQ(flow.curve().strands[s].closed, c.lines[s].closed);
        }
        for (uint32_t i = 0; i < flow.curve().size(); ++i) {
          ASSERT_TRUE(!flow.curve().on_guide(i) || flow.curve().fixed[i]);
        }
      }
      EXPECT_EQ(statistics_of(flow).crossings, 0u);
    }
  }
}

/// Cuts between the drawn points are rounded to the grid of points of a face (2^-32 of it).
TEST(Guides, AreTheDrawnLine) {
  const auto surface = std::make_shared<const Surface>(make_surface(flat_grid(7)));
  const std::vector<Vec3> drawn{{0.2, 0.2, 0}, {0.8, 0.3, 0}, {0.5, 0.7, 0}};
  const Flow flow = flow_on(surface, {{drawn}}, true, 0.05);
  std::vector<Vec3> inside;
  for (const Vec3& p : drawn) inside.push_back(surface->to_inside(p));
  const Curve& c = flow.curve();
  const Strand& guide = c.strands[0];
  ASSERT_GT(guide.count, 20u);
  for (uint32_t i = guide.first; i < guide.end(); ++i) {
    const Vec3 p = position(*surface, c.nodes[i]);
    EXPECT_LT(std::min(distance_to_segment(p, inside[0], inside[1]), distance_to_segment(p, inside[1], inside[2])),
              1e-8);
  }
  // Balls see only points, so none of them may slip through.
  for (uint32_t i = guide.first; i + 1 < guide.end(); ++i) {
    EXPECT_LE(c.shapes[i].length, 2.001 * flow.settings().segment_length);
  }
}

TEST(Guides, DivideTheSurfaceIntoRegionsThatAreFilled) {
  // A bar across, one up and one down from it: T-junctions, and four regions.
  const auto surface = std::make_shared<const Surface>(make_surface(flat_grid(6)));
  const std::vector<Line> network{
      {{{0, 0.5, 0}, {1, 0.5, 0}}}, {{{0.6, 0.5, 0}, {0.6, 1, 0}}}, {{{0.3, 0, 0}, {0.3, 0.5, 0}}}};
  Flow flow = flow_on(surface, network, true, 0.08);
  ASSERT_EQ(flow.curve().strands.size(), network.size() + 4);
  flow.run(kNeverCancelled, [](double) {});
  EXPECT_TRUE(crossings_of_what_grows(*surface, flow.curve()).empty());
  // Everything is within 1.6 r of a strand, except at corners where two guides meet the boundary.
  Rng rng(5);
  int far = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 p = position(*surface, random_point(*surface, rng));
    double d = distance_to_growth(*surface, flow.curve(), p);
    for (uint32_t i = 0; i < flow.curve().size(); ++i) {
      if (flow.curve().on_guide(i)) d = std::min(d, (position(*surface, flow.curve().nodes[i]) - p).norm());
    }
    far += d > 1.6 * radius_of(flow);
  }
  EXPECT_LE(far, 20);  // one in a hundred
}

TEST(Guides, AreKeptFromAtTheSpacing) {
  const auto surface = std::make_shared<const Surface>(make_surface(flat_grid(6)));
  Flow flow = flow_on(surface, {{{{0.2, 0.3, 0}, {0.8, 0.45, 0}}}}, true, 0.07);
  flow.run(kNeverCancelled, [](double) {});
  flow.update_radii();
  const Strand& guide = flow.curve().strands[0];
  std::vector<double> radii;
  for (uint32_t i = guide.first + 3; i + 3 < guide.end(); ++i) {
    for (const double r : flow.radii_of(i)) radii.push_back(r / radius_of(flow));
  }
  std::ranges::sort(radii);
  EXPECT_NEAR(radii[radii.size() / 2], 1, 0.15);
  EXPECT_GT(radii.front(), 0.5);
  EXPECT_LT(radii.back(), 1.8);
}

TEST(Guides, RegionsOfADrawnNetworkAreCounted) {
  struct Drawing {
    const char* name;
    std::vector<Line> lines;
    size_t regions;
  };
  const std::vector<Drawing> drawings{
      {"nothing", {}, 1},
      {"a line that ends inside", {{{{0, 0.5, 0}, {0.7, 0.5, 0}}}}, 1},
      {"across", {{{{0, 0.5, 0}, {1, 0.52, 0}}}}, 2},
      {"to just before the boundary", {{{{0.01, 0.5, 0}, {0.99, 0.52, 0}}}}, 2},
      {"cross", {{{{0, 0.5, 0}, {1, 0.5, 0}}}, {{{0.4, 0, 0}, {0.4, 1, 0}}}}, 4},
      {"circle", {{circle(0.3, 0, 20, 0.5, 0.5), true}}, 2},
      {"circle in a circle", {{circle(0.4, 0, 20, 0.5, 0.5), true}, {circle(0.2, 0, 20, 0.5, 0.5), true}}, 3},
      {"a circle too small to fill", {{circle(0.01, 0, 8, 0.5, 0.5), true}}, 1},
  };
  for (const Mesh& mesh : {flat_grid(1), flat_grid(5), flat_grid(40)}) {
    const Surface s = make_surface(mesh);
    const RadiusField radius(0.03 / s.scale());
    ThreadPool pool(1);
    for (const Drawing& d : drawings) {
      SCOPED_TRACE(d.name + std::string(" on ") + std::to_string(s.face_count()));
      Curve curve;
      if (!d.lines.empty()) curve = lay_seed(s, seed_of(d.lines, false), radius, pool);
      const std::vector<Region> regions = find_regions(s, curve, radius);
      EXPECT_EQ(regions.size(), d.regions);
      for (const Region& r : regions) EXPECT_FALSE(r.growing);
    }
  }
}

TEST(Guides, ARegionWithAStrandOfItsOwnGetsNoLoop) {
  const auto surface = std::make_shared<const Surface>(make_surface(flat_grid(5)));
  const Line bar{{{0, 0.5, 0}, {1, 0.5, 0}}};
  const Line drawn{{{0.2, 0.2, 0}, {0.8, 0.2, 0}}, false, false};
  EXPECT_EQ(flow_on(surface, {bar, drawn}, true, 0.08).curve().strands.size(), 3u);
  EXPECT_EQ(flow_on(surface, {drawn, bar}, false, 0.08).curve().strands.size(), 2u);
}

}  // namespace
}  // namespace meander::test::guides_tests
