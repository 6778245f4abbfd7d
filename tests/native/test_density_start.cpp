// SPDX-License-Identifier: GPL-3.0-or-later
//
// Full starts where the wanted spacing varies: lines begin and end one by one, so that all are at their distance before
// the flow has done anything.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "seed/full_start.h"
#include "seed/streamlines.h"
#include "curves.h"
#include "test_seeds.h"

namespace meander::test::density_start_tests {
namespace {

/// r at every vertex of a surface, as a function of its place there, in its unit.
RadiusField radius_of(const Surface& s, const std::function<double(const Vec3&)>& wanted) {
  VertexData<double> density(s.vertex_count(), 1);
  for (uint32_t v = 0; v < density.size(); ++v) density[v] = std::pow(wanted(s.position(v)), -2);
  return RadiusField(1, density);
}

/// Of a surface with this field, from loops that are as wide as r in the mean.
FullStart start_of(const Mesh& mesh, const Surface& surface, const RadiusField& radius) {
  const double r = 0.5 * (radius.least() + radius.most());
  const auto shared = std::make_shared<const Surface>(make_surface(mesh));
  const Flow flow(shared, nullptr, {}, checked_settings(options_of(2 * r * surface.scale()), surface));
  ThreadPool pool(1);
  return full_start(surface, flow.curve(), 0, radius, {}, nullptr, 0.5, pool);
}

/// Area over spacing, as the mean of places all over every face.
double wanted_length(const Surface& s, const RadiusField& radius) {
  constexpr int kRows = 16;
  double length = 0;
  for (uint32_t f = 0; f < s.face_count(); ++f) {
    for (int i = 0; i < kRows; ++i) {
      for (int j = 0; i + j < kRows; ++j) {
        const double x = (i + 1.0 / 3) / kRows, y = (j + 1.0 / 3) / kRows;
        length += s.face_area(f) / (kRows * (kRows + 1) / 2) / (2 * radius.at(s, make_point(f, 1 - x - y, x, y)));
      }
    }
  }
  return length;
}

/// Where a curve crosses the plane x = `at`, in the order of y.
std::vector<double> section(const Surface& s, const Curve& c, double at) {
  std::vector<double> found;
  for (uint32_t i = 0; i < c.size(); ++i) {
    std::vector<Vec3> points{position(s, c.nodes[i])};
    for (const Crossing& x : c.paths[i]) points.push_back(position(s, x));
    points.push_back(position(s, c.nodes[c.next(i)]));
    for (size_t k = 0; k + 1 < points.size(); ++k) {
      const Vec3 &a = points[k], &b = points[k + 1];
      if ((a.x() < at) != (b.x() < at)) found.push_back(a.y() + (at - a.x()) / (b.x() - a.x()) * (b.y() - a.y()));
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// The curve runs on both sides of every line, so its every second strand is on the same side of the next line.
TEST(DensityStart, HasItsSpacingWhereThatFallsSteadily) {
  const Mesh mesh = flat_grid(48);
  const Surface s = make_surface(mesh);
  const double side = 1 / s.scale();
  // 1 / r rises by two thirds of what it is in the middle: without turns lines would begin where gaps have doubled.
  const auto wanted = [&](double x) { return 0.009 * side / (0.5 + x / side); };
  const RadiusField radius = radius_of(s, [&](const Vec3& p) { return wanted(p.x()); });
  const Curve c = start_of(mesh, s, radius).curve;
  ASSERT_TRUE(whole(s, c));
  EXPECT_TRUE(exact_crossings(s, c).empty());
  size_t gaps = 0, wrong = 0, before = 0, bands = 0;
  for (int k = 8; k <= 95; ++k) {  // beyond the tips at the boundary
    const double x = 0.01 * k * side, r = wanted(x);
    const std::vector<double> strands = section(s, c, x);
    EXPECT_NEAR(static_cast<double>(strands.size()) * 2 * r / side, 1, 0.12) << "at " << 0.01 * k;
    for (size_t i = 0; i + 2 < strands.size(); ++i, ++gaps) {
      wrong += std::abs((strands[i + 2] - strands[i]) / (4 * r) - 1) > 0.2;
    }
    if (k % 10 == 5) bands += strands.size() > before, before = strands.size();
  }
  EXPECT_LT(static_cast<double>(wrong), 0.05 * static_cast<double>(gaps));
  EXPECT_EQ(bands, 9u) << "in every tenth of the width there are more strands than before it";
  EXPECT_NEAR(c.length() / wanted_length(s, radius), LineSpacing{}.full, 0.03);
}

struct Varying {
  const char* name;
  Mesh mesh;
  double mean;  // r, over the root of the area
};

TEST(DensityStart, FillsEverySurfaceAtEverySlope) {
  const std::vector<Varying> shapes{{"sphere", sphere(4), 0.03},        {"noisy", with_noise(sphere(4), 0.3, 5), 0.03},
                                    {"torus", torus(48, 24), 0.03},     {"square", flat_grid(24), 0.03},
                                    {"two_faces", flat_grid(1), 0.03},  {"holes", grid_with_hole(16), 0.035},
                                    {"cube", cube(), 0.03},            {"octahedron", octahedron(), 0.03}};
  for (const Varying& shape : shapes) {
    const Surface s = make_surface(shape.mesh);
    const double mean = shape.mean * std::sqrt(s.area());
    for (const double ratio : {2.0, 10.0}) {
      for (const bool steep : {false, true}) {
        SCOPED_TRACE(shape.name + std::to_string(ratio) + (steep ? " in a step" : ""));
        const RadiusField radius = radius_of(s, [&](const Vec3& p) {
          const double along = 2 * p.x() + p.y() - 0.5 * p.z();
          const double share = steep ? (std::sin(9 * along) > 0 ? 1 : -1) : std::sin(5 * along);
          return mean * std::pow(ratio, 0.5 * share);
        });
        const FullStart start = start_of(shape.mesh, s, radius);
        EXPECT_EQ(start.strands[0], StrandStart::kLaid);
        ASSERT_EQ(start.curve.strands.size(), 1u);
        ASSERT_TRUE(whole(s, start.curve));
        EXPECT_TRUE(exact_crossings(s, start.curve).empty());
        // Where r falls to a tenth within an edge, lines of both sides end, and the widest have no room between holes;
        // there the flow grows, and lays the rest.
        EXPECT_GT(start.curve.length() / wanted_length(s, radius), steep && ratio > 5 ? 0.6 : 0.9);
        EXPECT_LT(start.curve.length() / wanted_length(s, radius), 1.15);
      }
    }
  }
}

/// As a flow begins: with a density, trunks and guides, and the same for any number of threads and at any scale.
TEST(DensityStart, CrossesNothingBesideDrawnStrandsAndGuides) {
  std::vector<double> bytes;
  for (const double scale : {1.0, 1e3}) {
    for (const uint32_t threads : {1u, 3u}) {
      const auto surface = std::make_shared<const Surface>(make_surface(scaled(flat_grid(24), scale)));
      VertexData<double> density(surface->vertex_count(), 1);
      for (uint32_t v = 0; v < density.size(); ++v) {
        const double x = surface->caller_position(v).x() / scale;
        density[v] = std::pow(0.5 + std::round(8 * x) / 8, 2);
      }
      const Line stroke{{{0.2 * scale, 0.5 * scale, 0}, {0.8 * scale, 0.6 * scale, 0}}, false, false};
      const Line guide{{{0.3 * scale, 0.2 * scale, 0}, {0.7 * scale, 0.1 * scale, 0}}, false, true};
      const SeedStrands seed = seed_of({stroke, guide}, false);
      meander_flow_options options = options_of(0.04 * scale);
      options.start = MEANDER_START_FULL;
      options.threads = threads;
      Flow flow(surface, &seed, density, checked_settings(options, *surface));
      for (int k = 0; k < 4; ++k) {
        ASSERT_TRUE(flow.step(kNeverCancelled));
        ASSERT_TRUE(whole(*surface, flow.curve()));
        ASSERT_TRUE(crossings_of_what_grows(*surface, flow.curve()).empty()) << "iteration " << k;
      }
      std::vector<double> here;
      for (const SurfacePoint& p : flow.curve().nodes) here.insert(here.end(), {double(p.face), p.b.x, p.b.y});
      if (bytes.empty()) bytes = here;
      EXPECT_EQ(here, bytes) << scale << ", " << threads << " threads";
      EXPECT_GT(flow.curve().length() * 2 * flow.settings().radius, 0.7 * surface->area());
    }
  }
}

}  // namespace
}  // namespace meander::test::density_start_tests
