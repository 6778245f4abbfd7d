// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces at the scale of the spacing: what is rough, how it is smoothed, and flows that run there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "base/thread_pool.h"
#include "flow/flow.h"
#include "mesh/heat_flow.h"
#include "mesh/roughness.h"
#include "mesh/space_average.h"
#include "mesh/surface_at_scale.h"
#include "outputs/polylines.h"
#include "curves.h"

namespace meander::test::roughness_tests {
namespace {

/// A sheet of n x n cells with hills of both signs, about as wide as a tenth of it and as high as `height`.
Mesh crumpled(uint32_t n, double height) {
  return grid(
      n, 0.2,
      [&](double x, double y) {
        double z = 0;
        for (int k = 0; k < 6; ++k) {
          const double a = 0.9 + 1.07 * k, wave = 38 + 5 * k;
          z += std::sin(wave * (std::cos(a) * x + std::sin(a) * y) + 1.7 * k * k);
        }
        return Vec3(x, y, height * z / 6);
      },
      no_hole);
}

std::shared_ptr<const Surface> shared_surface(const Mesh& mesh) {
  return std::make_shared<const Surface>(make_surface(mesh));
}

/// r of a surface whose spacing is `spacing` in the units of its mesh.
double inside(const Surface& s, double spacing) { return settle(0.5 * spacing / s.scale()); }

SurfaceAtScale at_scale(const std::shared_ptr<const Surface>& s, double r, double followed = 0, unsigned threads = 1) {
  ThreadPool pool(threads);
  return at_scale(s, RadiusField(r), followed, pool);
}

bool same_positions(const Surface& a, const Surface& b) {
  for (uint32_t v = 0; v < a.vertex_count(); ++v) {
    if (a.position(v) != b.position(v)) return false;
  }
  return true;
}

FlowSettings even_settings(double r) {
  FlowSettings s;
  s.radius = r;
  s.segment_length = 0.2 * r;
  s.max_radius = 3 * r;
  s.bending_weight = 1;
  s.step = 1.5;
  s.growth_coarsening = 3;
  s.grow_into_empty = s.widen_loops = s.hold_ends = true;
  s.hairpin_removal_iterations = 70;
  s.polish = true;
  s.polish_bending_weight = 1.2;
  s.polish_length_offset = -1.16;
  s.polish_length_gain = 3;
  s.polish_medial_power = 8;
  s.medial_axis = MedialAxis::kGeodesic;
  s.roughness = 0;
  s.iteration_limit = 900;
  s.threads = 1;
  return s;
}

std::vector<Vec3> points_of(const Flow& flow) {
  Polylines lines;
  lines.copy_from(flow.surface(), flow.curve());
  return lines.positions;
}

void run(Flow& flow) {
  flow.run({}, [](double) {});
}

TEST(Roughness, SmoothSurfacesCornersAndLimbsHaveNone) {
  const ThreadPool pool(1);
  const std::pair<Mesh, double> smooth[] = {{sphere(4), 0.1},  {torus(64, 32), 0.1},     {subdivided(cube(), 4), 0.1},
                                            {cone(24, 12, 3), 0.5}, {flat_grid(40), 0.03}, {bumpy_grid(50), 0.05}};
  for (const auto& [mesh, spacing] : smooth) {
    const auto s = shared_surface(mesh);
    const SurfaceAtScale scaled = at_scale(s, inside(*s, spacing));
    EXPECT_EQ(scaled.surface, s) << "what is not rough is not copied";
    EXPECT_TRUE(scaled.shrinkage.empty());
    EXPECT_EQ(scaled.roughness.stretch, 1);
  }
}

TEST(Roughness, SaddlesBesidePeaksCancelOut) {
  // Curvature of one sign is no roughness, however much of it there is; of both signs side by side it is.
  const Surface hills = make_surface(crumpled(60, 0.07)), ball = make_surface(sphere(3));
  const VertexData<double> rough = roughness(hills, RadiusField(inside(hills, 0.08)), 0);
  ASSERT_FALSE(rough.empty());
  EXPECT_GT(*std::ranges::max_element(rough), 1.5);
  EXPECT_TRUE(roughness(ball, RadiusField(inside(ball, 0.5)), 1e-9).empty());
}

TEST(Roughness, IsTheSameAtEveryScaleAndForAnyThreads) {
  const Mesh mesh = crumpled(50, 0.07);
  const auto s = shared_surface(mesh), large = shared_surface(scaled(mesh, 1000));
  const SurfaceAtScale a = at_scale(s, inside(*s, 0.08)), b = at_scale(large, inside(*large, 80)),
                       c = at_scale(s, inside(*s, 0.08), 0, 3);
  ASSERT_NE(a.surface, s);
  EXPECT_TRUE(same_positions(*a.surface, *b.surface));
  EXPECT_TRUE(same_positions(*a.surface, *c.surface));
  EXPECT_EQ(a.shrinkage, b.shrinkage);
  EXPECT_EQ(a.shrinkage, c.shrinkage);
}

TEST(Roughness, FollowsTheRadiusContinuously) {
  // No lattice shows: r that grows by a thousandth changes the surface by about as little.
  const auto s = shared_surface(crumpled(60, 0.07));
  const double r = inside(*s, 0.08);
  for (const double factor : {1.0, 1.3, 1.7, 1.999}) {
    const SurfaceAtScale a = at_scale(s, factor * r), b = at_scale(s, 1.001 * factor * r);
    for (uint32_t v = 0; v < s->vertex_count(); ++v) {
      EXPECT_LT((a.surface->position(v) - b.surface->position(v)).norm(), 0.01 * r);
    }
  }
}

TEST(SpaceSums, HaveRoomForWhatIsFarOff) {
  for (const double size : {0x1p-1074, 1e-300, 1.0}) {
    SpaceSums<1> sums(size);
    for (const double far : {0.0, 1.0, -1.0, 1e300, -1e300}) {
      const Vec3 p(far, -far, 0);
      sums.add(p, {2.0});
      EXPECT_GT(sums.at(p)[0], 0) << size << " " << far;
      EXPECT_LE(sums.at(p)[0], 10) << size << " " << far;
    }
  }
}

TEST(HeatFlow, DampsWavesAsTheImplicitStepDoes) {
  // An implicit step divides a wave of wave number k by 1 + sigma^2 k^2 / 2.
  const double k = 8 * kPi, height = 1e-4, width = 0.03;
  for (const uint32_t cells : {40u, 160u}) {
    const Surface s = make_surface(grid(
        cells, 0, [&](double x, double y) { return Vec3(x, y, height * std::sin(k * x)); }, no_hole));
    ThreadPool pool(2);
    const VertexData<double> widths(s.vertex_count(), width / s.scale());
    const VertexData<Vec3> smooth = smoothed_positions(s, widths, pool);
    // Away from the boundary, which stays: its influence falls by e in 0.7 widths.
    double before = 0, after = 0, drift = 0;
    for (uint32_t v = 0; v < s.vertex_count(); ++v) {
      const Vec3 p = s.caller_position(v);
      if (std::min({p.x(), p.y(), 1 - p.x(), 1 - p.y()}) < 0.2) continue;
      before += std::abs(s.position(v).z() - s.position(0).z());
      after += std::abs(smooth[v].z() - s.position(0).z());
      drift = std::max(drift, std::hypot(smooth[v].x() - s.position(v).x(), smooth[v].y() - s.position(v).y()));
    }
    EXPECT_NEAR(before / after, 1 + width * width * k * k / 2, 0.04) << cells;
    EXPECT_LT(drift, 0.05 * width) << "what is flat stays where it is";
  }
}

TEST(HeatFlow, KeepsTheBoundaryAndWhatHasNoWidth) {
  const Surface s = make_surface(crumpled(40, 0.07));
  VertexData<double> widths(s.vertex_count(), 0.0);
  for (uint32_t v = 0; v < s.vertex_count(); ++v) widths[v] = s.caller_position(v).x() > 0.5 ? 0.02 : 0;
  ThreadPool pool(1);
  const VertexData<Vec3> smooth = smoothed_positions(s, widths, pool);
  uint32_t moved = 0;
  for (uint32_t v = 0; v < s.vertex_count(); ++v) {
    if (s.on_boundary(v) || widths[v] == 0) {
      EXPECT_EQ(smooth[v], s.position(v));
    } else {
      moved += smooth[v] != s.position(v);
    }
  }
  EXPECT_GT(moved, 500u);
}

TEST(HeatFlow, NeedsNoSmallWidths) {
  // 50 edges wide: the multigrid cycle, against the closed form for a wave that the boundary does not reach.
  const uint32_t cells = 200;
  const double k = 2 * kPi, height = 1e-3, width = 0.25;
  const Surface s = make_surface(grid(
      cells, 0, [&](double x, double y) { return Vec3(x, y, height * std::sin(k * x) * std::sin(k * y)); }, no_hole));
  ThreadPool pool(2);
  const VertexData<Vec3> smooth = smoothed_positions(s, VertexData<double>(s.vertex_count(), width / s.scale()), pool);
  // The product of two waves that are 0 on the boundary is an eigenfunction there as well.
  const double damped = 1 / (1 + width * width * 2 * k * k / 2);
  for (uint32_t v = 0; v < s.vertex_count(); ++v) {
    const double z = s.position(v).z() - s.position(0).z();
    EXPECT_NEAR(smooth[v].z() - s.position(0).z(), damped * z, 0.02 * height / s.scale());
  }
}

TEST(SurfaceAtScale, FollowsAsMuchRoughnessAsItIsTold) {
  const auto s = shared_surface(crumpled(60, 0.07));
  const double r = inside(*s, 0.08);
  double last = 0;
  for (const double followed : {0.0, 0.25, 0.5, 0.75}) {
    const SurfaceAtScale scaled = at_scale(s, r, followed);
    EXPECT_LT(scaled.surface->area(), s->area());
    EXPECT_GT(scaled.surface->area(), last) << followed;
    EXPECT_NEAR(scaled.roughness.stretch, std::sqrt(s->area() / scaled.surface->area()), 1e-12);
    last = scaled.surface->area();
  }
  EXPECT_EQ(at_scale(s, r, 1).surface, s);
}

TEST(SurfaceAtScale, LengthsShrinkAsAreasDo) {
  const auto s = shared_surface(crumpled(80, 0.07));
  const SurfaceAtScale scaled = at_scale(s, inside(*s, 0.08));
  // What r is in the mean on both surfaces: areas over r^2 stay the same, so there are as many nodes.
  double given = 0, smoothed = 0;
  for (uint32_t f = 0; f < s->face_count(); ++f) {
    double shrunk = 0;
    for (const uint32_t v : s->face(f)) shrunk += scaled.shrinkage[v] / 3;
    given += s->face_area(f);
    smoothed += scaled.surface->face_area(f) / (shrunk * shrunk);
  }
  EXPECT_NEAR(smoothed / given, 1, 0.02);
  EXPECT_LT(*std::ranges::min_element(scaled.shrinkage), 0.95);
}

TEST(SurfaceAtScale, EveryFaceKeepsAnArea) {
  // Needles: what smoothing takes nearly to a line.
  Mesh mesh = crumpled(60, 0.07);
  Rng rng(5);
  for (uint32_t v = 0; v < mesh.vertex_count(); v += 3) mesh.vertices[3 * v + 2] += rng.in(-0.3, 0.3);
  const auto s = shared_surface(mesh);
  const SurfaceAtScale scaled = at_scale(s, inside(*s, 0.1));
  ASSERT_NE(scaled.surface, s);
  for (uint32_t f = 0; f < s->face_count(); ++f) EXPECT_GT(scaled.surface->face_area(f), 0);
}

TEST(RoughFlow, SettlesWithoutCrossingsOnTheSurfaceAsItWasGiven) {
  const auto s = shared_surface(crumpled(90, 0.07));
  Flow flow(s, nullptr, {}, even_settings(inside(*s, 0.08)));
  ASSERT_GT(flow.roughness().smoothing, 0.1);
  run(flow);
  EXPECT_EQ(flow.stop_reason(), StopReason::kConverged);
  EXPECT_LT(flow.history().size(), 320u);
  EXPECT_TRUE(exact_crossings(*s, flow.curve()).empty());
  EXPECT_EQ(&flow.surface(), s.get());
  // Length is that of what is written.
  Polylines lines;
  lines.copy_from(flow.surface(), flow.curve());
  double length = 0;
  const size_t n = lines.point_count();
  for (size_t p = 0; p < n; ++p) {
    const size_t q = (p + 1) % n;
    length += (lines.positions[q] - lines.positions[p]).norm();
  }
  EXPECT_NEAR(flow.length() * s->scale(), length, 1e-9 * length);
  EXPECT_EQ(flow.history().back().length, flow.length());
  // As long as a curve at the spacing of the given surface is: area over spacing.
  EXPECT_NEAR(flow.length() * 2 * flow.settings().radius / s->area(), 1.03, 0.07);
  // The middle of the medial radii on that surface is r.
  std::vector<double> radii;
  for (const Radii& sides : flow.radii()) radii.insert(radii.end(), sides.begin(), sides.end());
  std::ranges::nth_element(radii, radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2));
  EXPECT_NEAR(radii[radii.size() / 2] / flow.settings().radius, 1, 0.08);
}

TEST(RoughFlow, AnOptionFollowsEveryBump) {
  const auto s = shared_surface(crumpled(60, 0.07));
  FlowSettings settings = even_settings(inside(*s, 0.08));
  settings.roughness = 1;
  const Flow flow(s, nullptr, {}, settings);
  EXPECT_EQ(flow.roughness().smoothing, 0);
  EXPECT_EQ(flow.length(), flow.curve().length());
  settings.medial_axis = MedialAxis::kEuclidean;
  settings.roughness = 0;
  EXPECT_EQ(Flow(s, nullptr, {}, settings).roughness().smoothing, 0) << "through space there is nothing to smooth";
}

TEST(RoughFlow, IsTheSameForAnyThreads) {
  const auto s = shared_surface(crumpled(50, 0.07));
  FlowSettings settings = even_settings(inside(*s, 0.1));
  Flow one(s, nullptr, {}, settings);
  settings.threads = 3;
  Flow three(s, nullptr, {}, settings);
  for (int k = 0; k < 40; ++k) {
    ASSERT_TRUE(one.step({}));
    ASSERT_TRUE(three.step({}));
  }
  EXPECT_EQ(points_of(one), points_of(three));
}

TEST(RoughFlow, FollowsTheSpacingAndTheSurfaceWithoutCrossings) {
  Mesh mesh = crumpled(70, 0.07);
  const auto s = shared_surface(mesh);
  Flow flow(s, nullptr, {}, even_settings(inside(*s, 0.1)));
  run(flow);
  ASSERT_EQ(flow.stop_reason(), StopReason::kConverged);
  // Another spacing is another scale.
  const double smoothing = flow.roughness().smoothing, stretch = flow.roughness().stretch;
  flow.revise(flow.settings().with_radius(inside(*s, 0.09)));
  EXPECT_NE(flow.roughness().stretch, stretch);
  EXPECT_TRUE(exact_crossings(*s, flow.curve()).empty());
  run(flow);
  EXPECT_EQ(flow.stop_reason(), StopReason::kConverged);
  EXPECT_TRUE(exact_crossings(*s, flow.curve()).empty());
  // So much of a spacing that nothing is rough any more, and back.
  flow.revise(flow.settings().with_radius(inside(*s, 0.03)));
  EXPECT_LT(flow.roughness().smoothing, smoothing);
  EXPECT_TRUE(exact_crossings(flow.surface(), flow.curve()).empty());
  flow.revise(flow.settings().with_radius(inside(*s, 0.09)));
  EXPECT_TRUE(exact_crossings(flow.surface(), flow.curve()).empty());
  // A surface that moves a little moves the curve a little: the smoothed one does not jump.
  run(flow);
  const double length = flow.length() * flow.surface().scale(), wide = flow.roughness().stretch;
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) mesh.vertices[3 * v + 2] *= 1.001;
  flow.set_vertices(mesh.vertices);
  EXPECT_NEAR(flow.length() * flow.surface().scale(), length, 0.01 * length);
  EXPECT_NEAR(flow.roughness().stretch, wide, 0.002);
  EXPECT_TRUE(exact_crossings(flow.surface(), flow.curve()).empty());
}

}  // namespace
}  // namespace meander::test::roughness_tests
