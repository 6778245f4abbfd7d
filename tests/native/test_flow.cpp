// SPDX-License-Identifier: GPL-3.0-or-later
//
// The flow as a whole: what must hold after every iteration on any surface, with either preset.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "api_flows.h"
#include "api_results.h"
#include "flow/flow.h"
#include "outputs/statistics.h"
#include "curves.h"

namespace meander::test::flow_tests {
namespace {

/// What the C API makes of a preset's options; `spacing` is in the mesh's own units.
FlowSettings settings_of(uint32_t preset, const Surface& surface, double spacing) {
  meander_flow_options o;
  EXPECT_EQ(meander_flow_options_init(&o, sizeof o, preset), MEANDER_STATUS_OK);
  FlowSettings s;
  s.radius = 0.5 * spacing / surface.scale();
  s.segment_length = 0.2 * s.radius;
  s.max_radius = (preset == MEANDER_PRESET_PAPER ? 10 : 3) * s.radius;
  s.length_weight = o.length_weight;
  s.bending_weight = o.bending_weight;
  s.medial_weight = o.medial_weight;
  s.step = o.step;
  for (const SettingRange& tuning : kTunings) {
    EXPECT_EQ(meander_flow_options_get_tuning(&o, tuning.name.data(), &(s.*tuning.value), nullptr), MEANDER_STATUS_OK);
  }
  s.polish = o.polish != 0;
  s.polish_bending_weight = o.polish_bending_weight;
  s.hairpin_removal_iterations = o.hairpin_removal_iterations;
  s.grow_into_empty = s.widen_loops = preset != MEANDER_PRESET_PAPER;
  s.stop_rule = o.stop_rule == MEANDER_STOP_RULE_PAPER ? StopRule::kPaper : StopRule::kSettled;
  s.boundary_rule = BoundaryRule::kCentre;
  s.iteration_limit = o.iteration_limit;
  s.threads = 1;
  return s;
}

const auto kNeverCancelled = [] { return false; };

/// Spacing at which a converged curve on the mesh would be about `ratio` spacings long.
double spacing_for(const Surface& s, double ratio) {
  return std::sqrt(s.area() / ratio) * s.scale();
}

void expect_valid(const Surface& s, const Curve& c) {
  ASSERT_TRUE(whole(s, c));
  const auto crossings = exact_crossings(s, c);
  ASSERT_TRUE(crossings.empty()) << crossings.size() << " crossings, first: segments "
                                 << crossings.begin()->first << " and "
                                 << crossings.begin()->second;
}

struct Case {
  const char* name;
  Mesh mesh;
  double ratio;
  int iterations;
};

std::vector<Case> cases() {
  return {
      {"sphere", sphere(3), 60, 30},
      {"torus", torus(24, 12), 60, 30},
      {"noisy_sphere", with_noise(sphere(3), 0.3, 7), 60, 30},
      {"fine_noisy_sphere", with_noise(sphere(4), 0.3, 8), 20, 20},
      {"cube", cube(), 60, 40},
      {"octahedron", octahedron(), 60, 40},
      {"square_of_two_faces", flat_grid(1), 60, 40},
      {"grid_with_hole", grid_with_hole(9), 60, 30},
      {"bumpy_grid", bumpy_grid(12), 60, 30},
      {"two_spheres", joined(sphere(2), octahedron(), 4), 80, 30},
      {"sharp_cone", cone(7, 5, 4), 60, 30},
      {"saddle", cone(12, 4, 0.7, true), 60, 30},
  };
}

class EveryIteration : public testing::TestWithParam<uint32_t> {};

TEST_P(EveryIteration, KeepsTheCurveWhole) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const auto surface = std::make_shared<const Surface>(make_surface(c.mesh));
    const double spacing = spacing_for(*surface, c.ratio);
    Flow flow(surface, nullptr, {}, settings_of(GetParam(), *surface, spacing));
    ASSERT_EQ(flow.curve().strands.size(), surface->component_count());
    expect_valid(*surface, flow.curve());
    for (int k = 0; k < c.iterations && !HasFatalFailure(); ++k) {
      SCOPED_TRACE("iteration " + std::to_string(k + 1));
      ASSERT_TRUE(flow.step(kNeverCancelled));
      expect_valid(*surface, flow.curve());
      ASSERT_EQ(flow.curve().strands.size(), surface->component_count());
      for (const Strand& s : flow.curve().strands) ASSERT_TRUE(s.closed);
    }
    // Shapes are those of the paths, so that lengths and directions in the next step are right.
    const Curve& curve = flow.curve();
    for (uint32_t i = 0; i < curve.size(); ++i) {
      const PathShape shape =
          measure_path(*surface, curve.nodes[i], curve.nodes[curve.next(i)], curve.paths[i]);
      EXPECT_NEAR(shape.length, curve.shapes[i].length, kMeasured);
    }
    EXPECT_EQ(statistics_of(flow).crossings, 0u);
  }
}

TEST(GeodesicMedialAxisFlow, KeepsTheCurveWhole) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const auto surface = std::make_shared<const Surface>(make_surface(c.mesh));
    FlowSettings settings = settings_of(MEANDER_PRESET_EVEN, *surface, spacing_for(*surface, c.ratio));
    settings.medial_axis = MedialAxis::kGeodesic;
    Flow flow(surface, nullptr, {}, settings);
    for (int k = 0; k < c.iterations && !HasFatalFailure(); ++k) {
      SCOPED_TRACE("iteration " + std::to_string(k + 1));
      ASSERT_TRUE(flow.step(kNeverCancelled));
      expect_valid(*surface, flow.curve());
      for (const Radii& radii : flow.radii()) ASSERT_TRUE(radii[0] >= 0 && radii[1] >= 0);
    }
  }
}

/// Ends of the seed, in the mesh's own space.
struct Line {
  std::vector<Vec3> points;
  bool closed = false;
  std::vector<uint8_t> fixed;
};

SeedStrands seed_of(const std::vector<Line>& lines) {
  SeedStrands seed;
  seed.offsets.push_back(0);
  for (const Line& line : lines) {
    seed.points.insert(seed.points.end(), line.points.begin(), line.points.end());
    seed.offsets.push_back(static_cast<uint32_t>(seed.points.size()));
    seed.closed.push_back(line.closed);
    seed.fixed.insert(seed.fixed.end(), line.fixed.begin(), line.fixed.end());
  }
  return seed;
}

TEST_P(EveryIteration, KeepsStrandsAndFixedNodesAsSeeded) {
  const std::vector<Line> lines{
      {{{0.1, 0.1, 0}, {0.3, 0.12, 0}, {0.5, 0.1, 0}, {0.9, 0.1, 0}}, false, {1, 0, 1, 1}},
      {{{0.1, 0.9, 0}, {0.3, 0.85, 0}, {0.5, 0.9, 0}}, false, {0, 0, 0}},
      {{{0.1, 0.4, 0}, {0.3, 0.4, 0}, {0.2, 0.6, 0}}, true, {0, 0, 1}}};
  for (const Mesh& mesh : {flat_grid(1), flat_grid(7), grid_with_hole(9)}) {
    const auto surface = std::make_shared<const Surface>(make_surface(mesh));
    const SeedStrands seed = seed_of(lines);
    Flow flow(surface, &seed, {}, settings_of(GetParam(), *surface, 0.08));
    std::vector<SurfacePoint> fixed;
    const auto fixed_now = [&] {
      std::vector<SurfacePoint> points;
      for (uint32_t i = 0; i < flow.curve().size(); ++i) {
        if (flow.curve().fixed[i]) points.push_back(flow.curve().nodes[i]);
      }
      return points;
    };
    fixed = fixed_now();
    ASSERT_EQ(fixed.size(), 4u);
    for (int k = 0; k < 30 && !HasFatalFailure(); ++k) {
      SCOPED_TRACE("iteration " + std::to_string(k + 1));
      ASSERT_TRUE(flow.step(kNeverCancelled));
      expect_valid(*surface, flow.curve());
      ASSERT_EQ(flow.curve().strands.size(), lines.size());
      for (size_t s = 0; s < lines.size(); ++s)
        ASSERT_EQ(flow.curve().strands[s].closed, lines[s].closed);
      const auto now = fixed_now();
      ASSERT_EQ(now.size(), fixed.size());
      for (size_t i = 0; i < now.size(); ++i) ASSERT_TRUE(same_bytes(now[i], fixed[i]));
      // The fixed ends are still the ends.
      const Strand& first = flow.curve().strands[0];
      ASSERT_TRUE(flow.curve().fixed[first.first]);
      ASSERT_TRUE(flow.curve().fixed[first.end() - 1]);
    }
  }
}

TEST_P(EveryIteration, GoesOnAfterConvergence) {
  const auto surface = std::make_shared<const Surface>(make_surface(sphere(2)));
  Flow flow(surface, nullptr, {}, settings_of(GetParam(), *surface, spacing_for(*surface, 20)));
  const StopReason reason = flow.run(kNeverCancelled, [](double) {});
  EXPECT_NE(reason, StopReason::kCancelled);
  expect_valid(*surface, flow.curve());
  for (int k = 0; k < 10; ++k) {
    ASSERT_TRUE(flow.step(kNeverCancelled));
    expect_valid(*surface, flow.curve());
  }
}

/// A cancel at any point at which the step asks for it leaves the last whole iteration.
TEST_P(EveryIteration, ACancelledStepChangesNothing) {
  const auto surface = std::make_shared<const Surface>(make_surface(torus(14, 8)));
  Flow flow(surface, nullptr, {}, settings_of(GetParam(), *surface, spacing_for(*surface, 30)));
  for (int k = 0; k < 5; ++k) flow.step(kNeverCancelled);
  int asked = 0;
  bool whole_step = false;
  for (int patience = 0; !whole_step && patience < 1000; ++patience) {
    const Table<SurfacePoint> before = flow.curve().nodes;
    const size_t iterations = flow.history().size();
    asked = 0;
    whole_step = flow.step([&] { return ++asked > patience; });
    if (whole_step) break;
    ASSERT_EQ(flow.history().size(), iterations);
    ASSERT_EQ(flow.curve().nodes.size(), before.size());
    for (size_t i = 0; i < before.size(); ++i)
      ASSERT_TRUE(same_bytes(before[i], flow.curve().nodes[i]));
  }
  EXPECT_TRUE(whole_step);
  EXPECT_GT(asked, 0);
  // And the flow is the one that was never cancelled.
  Flow other(surface, nullptr, {}, settings_of(GetParam(), *surface, spacing_for(*surface, 30)));
  for (int k = 0; k < 6; ++k) other.step(kNeverCancelled);
  ASSERT_EQ(other.curve().size(), flow.curve().size());
  for (uint32_t i = 0; i < flow.curve().size(); ++i) {
    EXPECT_TRUE(same_bytes(other.curve().nodes[i], flow.curve().nodes[i]));
  }
}

/// What a caller of the C API gets after some steps.
struct Output {
  std::vector<uint32_t> faces;
  std::vector<double> barycentrics, positions;
  std::vector<uint64_t> offsets;
  bool operator==(const Output&) const = default;
};

Output run(const Mesh& mesh, double spacing, uint32_t preset, uint32_t threads, int steps) {
  Output out;
  const FlowHandle flow = make_flow(mesh, options_with(spacing, threads, preset));
  step(flow, steps);
  const auto nodes = nodes_of(flow.get());
  const auto curve = polylines_of(flow.get());
  out.faces = copied(nodes->faces, nodes->count);
  out.barycentrics = copied(nodes->barycentrics, 3 * nodes->count);
  out.positions = copied(curve->positions, 3 * curve->point_count);
  out.offsets = copied(curve->offsets, curve->strand_count + 1);
  return out;
}

TEST_P(EveryIteration, GivesTheSameBytesForAnyNumberOfThreads) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Surface s = make_surface(c.mesh);
    const Output one = run(c.mesh, spacing_for(s, c.ratio), GetParam(), 1, 12);
    EXPECT_FALSE(one.faces.empty());
    for (const uint32_t threads : {2u, 5u}) {
      EXPECT_EQ(one, run(c.mesh, spacing_for(s, c.ratio), GetParam(), threads, 12)) << threads;
    }
  }
}

TEST_P(EveryIteration, DoesNotDependOnScale) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Surface s = make_surface(c.mesh);
    const double spacing = spacing_for(s, c.ratio);
    const Output one = run(c.mesh, spacing, GetParam(), 1, 12);
    for (const double factor : {0.001, 1000.0, 3.3, 0x1p-8}) {
      const Output other = run(scaled(c.mesh, factor), factor * spacing, GetParam(), 1, 12);
      EXPECT_EQ(one.faces, other.faces) << factor;
      EXPECT_EQ(one.barycentrics, other.barycentrics) << factor;
    }
  }
}

double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a).normalized();
  const auto to_side = [&](const Vec3& u, const Vec3& v) {
    const double t = std::clamp((p - u).dot(v - u) / (v - u).squaredNorm(), 0.0, 1.0);
    return (p - u - t * (v - u)).norm();
  };
  const bool inside = n.cross(b - a).dot(p - a) >= 0 && n.cross(c - b).dot(p - b) >= 0 &&
                      n.cross(a - c).dot(p - c) >= 0;
  if (inside) return std::abs(n.dot(p - a));
  return std::min({to_side(a, b), to_side(b, c), to_side(c, a)});
}

/// Every straight piece of the output lies in the mesh as the caller gave it.
TEST_P(EveryIteration, PolylinesAreOnTheCallersMesh) {
  // Points are sums of three products of numbers of about 1 (the meshes' size).
  constexpr double kRounding = 4e-15;
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Surface s = make_surface(c.mesh);
    const Output out = run(c.mesh, spacing_for(s, 40), GetParam(), 2, 20);
    const double most = kRounding * s.scale();
    uint32_t last = 0;  // the face of the piece before, which is mostly near that of the next
    for (size_t strand = 0; strand + 1 < out.offsets.size(); ++strand) {
      const uint64_t first = out.offsets[strand], count = out.offsets[strand + 1] - first;
      for (uint32_t k = 0; k < count; ++k) {
        const auto point = [&](uint32_t i) {
          return Vec3(out.positions.data() + 3 * (first + i % count));
        };
        const Vec3 middle = 0.5 * (point(k) + point(k + 1));
        double nearest = std::numeric_limits<double>::infinity();
        for (uint32_t other = 0; other < c.mesh.face_count() && nearest > most; ++other) {
          const uint32_t f = (last + other) % c.mesh.face_count();
          const auto corner = [&](uint32_t i) { return c.mesh.at(c.mesh.faces[3 * f + i]); };
          nearest =
              std::min(nearest, distance_to_triangle(middle, corner(0), corner(1), corner(2)));
          if (nearest <= most) last = f;
        }
        ASSERT_LE(nearest, most) << "strand " << strand << ", piece " << k;
      }
    }
  }
}

/// Where r grows from side to side, strands are evenly spaced when the distance between them, measured
/// in the r along it, is 2; then both sides of each must feel the same, or they would drift for ever.
TEST(FlowUnderADensity, StrandsInMetricDistanceAreAtRest) {
  const Mesh mesh = flat_grid(16);
  const auto surface = std::make_shared<const Surface>(mesh.vertices, mesh.faces);
  const double low = 0.02, slope = 0.08;  // r = low + slope x
  VertexData<double> density(mesh.vertex_count());
  for (uint32_t v = 0; v < density.size(); ++v) {
    density[v] = std::pow(low / (low + slope * mesh.at(v).x()), 2);
  }
  SeedStrands seed;
  seed.offsets.push_back(0);
  for (double x = 0.05; x < 0.95; x = ((low + slope * x) * std::exp(2 * slope) - low) / slope) {
    for (int k = 0; k <= 50; ++k) seed.points.emplace_back(x, 0.001 + 0.998 * k / 50, 0);
    seed.offsets.push_back(static_cast<uint32_t>(seed.points.size()));
    seed.closed.push_back(0);
  }
  FlowSettings settings = settings_of(MEANDER_PRESET_EVEN, *surface, 2 * low);
  Flow flow(surface, &seed, density, settings);
  std::vector<double> spacing = statistics_of(flow).spacing;
  for (double& d : spacing) d /= 2 * settings.radius;
  // Only the outer sides of the first and the last strand face the boundary. There are nine strands,
  // and most nodes are on the first, where r is least.
  EXPECT_GT(spacing.front(), 0.99);
  size_t at_rest = 0;
  for (const double d : spacing) at_rest += std::abs(d - 1) < 0.01;
  EXPECT_GT(static_cast<double>(at_rest) / static_cast<double>(spacing.size()), 0.7);
}

/// Of every node from the curve before, in units of r; by comparing with all segments.
double largest_movement(const std::vector<Vec3>& before, const std::vector<Vec3>& after, double r) {
  double largest = 0;
  for (const Vec3& p : after) {
    double nearest = std::numeric_limits<double>::infinity();
    for (size_t k = 0; k < before.size(); ++k) {
      const Vec3 &a = before[k], &b = before[(k + 1) % before.size()];
      const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (p - a - t * (b - a)).norm());
    }
    largest = std::max(largest, nearest / r);
  }
  return largest;
}

std::vector<Vec3> positions_of(const Flow& flow) {
  std::vector<Vec3> positions;
  for (const SurfacePoint& p : flow.curve().nodes) positions.push_back(position(flow.surface(), p));
  return positions;
}

TEST(FlowToTheEnd, RemovesHairpinsKeepsItsInvariantsAndEndsStill) {
  const Mesh mesh = torus(24, 12);
  const auto surface = std::make_shared<const Surface>(mesh.vertices, mesh.faces);
  FlowSettings settings = settings_of(MEANDER_PRESET_FINEST, *surface, spacing_for(*surface, 150));
  settings.hairpin_removal_iterations = 60;
  settings.full_start = false;
  Flow flow(surface, nullptr, {}, settings);
  std::vector<Vec3> before;
  int steps = 0;
  while (flow.stop_reason() == StopReason::kRunning) {
    before = positions_of(flow);
    ASSERT_TRUE(flow.step(kNeverCancelled));
    if (++steps % 10 == 0) expect_valid(*surface, flow.curve());
  }
  EXPECT_EQ(flow.stop_reason(), StopReason::kConverged);
  EXPECT_TRUE(flow.polishing());
  expect_valid(*surface, flow.curve());
  EXPECT_LE(largest_movement(before, positions_of(flow), settings.radius), 0.05);
}

/// What nodes at rest keep from earlier iterations changes only with whole iterations, even if figures are
/// asked for in between, and is the same for any number of threads.
TEST(FlowToTheEnd, DoesNotDependOnWhoLooksAtIt) {
  const Mesh mesh = torus(24, 12);
  const auto surface = std::make_shared<const Surface>(mesh.vertices, mesh.faces);
  FlowSettings settings = settings_of(MEANDER_PRESET_EVEN, *surface, spacing_for(*surface, 100));
  settings.hairpin_removal_iterations = 20;
  Flow alone(surface, nullptr, {}, settings);
  settings.threads = 3;
  Flow watched(surface, nullptr, {}, settings);
  for (int k = 0; alone.stop_reason() == StopReason::kRunning; ++k) {
    ASSERT_TRUE(alone.step(kNeverCancelled));
    int asked = 0;
    if (k % 3 == 0) statistics_of(watched);
    if (k % 5 == 0) {
      EXPECT_FALSE(watched.step([&] { return ++asked > 1 + k % 2; }));
    }
    ASSERT_TRUE(watched.step(kNeverCancelled));
    ASSERT_EQ(alone.curve().size(), watched.curve().size()) << "iteration " << k;
    for (uint32_t i = 0; i < alone.curve().size(); ++i) {
      ASSERT_TRUE(same_bytes(alone.curve().nodes[i], watched.curve().nodes[i])) << "iteration " << k;
    }
  }
  EXPECT_EQ(watched.stop_reason(), alone.stop_reason());
}

/// Without a polish only the size of the steps changes at the end.
TEST(FlowToTheEnd, WithoutAPolishKeepsItsLengthWhileItCoolsDown) {
  const Mesh mesh = torus(24, 12);
  const auto surface = std::make_shared<const Surface>(mesh.vertices, mesh.faces);
  FlowSettings settings = settings_of(MEANDER_PRESET_PAPER, *surface, spacing_for(*surface, 60));
  settings.stop_rule = StopRule::kSettled;
  Flow flow(surface, nullptr, {}, settings);
  EXPECT_EQ(flow.run(kNeverCancelled, [](double) {}), StopReason::kConverged);
  EXPECT_FALSE(flow.polishing());
  ASSERT_GT(flow.history().size(), 20u);
  const double before = flow.history()[flow.history().size() - 12].length;
  EXPECT_NEAR(flow.history().back().length, before, 0.01 * before);
}

INSTANTIATE_TEST_SUITE_P(Presets, EveryIteration,
                         testing::Values(uint32_t{MEANDER_PRESET_EVEN},
                                         uint32_t{MEANDER_PRESET_PAPER}));

}  // namespace
}  // namespace meander::test::flow_tests
