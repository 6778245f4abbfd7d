// SPDX-License-Identifier: GPL-3.0-or-later
//
// The flow as a whole: what must hold after every iteration on any surface, with either preset.
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "flow.h"
#include "meander/meander.h"
#include "test_curves.h"

namespace meander::test {
namespace {

/// What c_api.cpp makes of a preset's options; `spacing` is in the mesh's own units.
FlowSettings settings_of(uint32_t preset, const Surface& surface, double spacing) {
  meander_flow_options o;
  EXPECT_EQ(meander_flow_options_init(&o, preset), MEANDER_OK);
  FlowSettings s;
  s.radius = 0.5 * spacing / surface.scale();
  s.segment_length = 0.2 * s.radius;
  s.max_radius = (preset == MEANDER_PRESET_PAPER ? 10 : 3) * s.radius;
  s.length_weight = o.length_weight;
  s.bending_weight = o.bending_weight;
  s.medial_weight = o.medial_weight;
  s.step = o.step;
  s.growth_coarsening = o.growth_coarsening;
  s.polish = o.polish != 0;
  s.polish_bending_weight = o.polish_bending_weight;
  s.polish_length_offset = o.polish_length_offset;
  s.polish_length_gain = o.polish_length_gain;
  s.grow_into_empty = s.widen_loops = preset != MEANDER_PRESET_PAPER;
  s.stop_rule = o.stop_rule == MEANDER_STOP_PAPER ? StopRule::kPaper : StopRule::kSettled;
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
                                 << crossings.begin()->first << " and " << crossings.begin()->second;
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
      const PathShape shape = measure_path(*surface, curve.nodes[i], curve.nodes[curve.next(i)], curve.paths[i]);
      EXPECT_EQ(shape.length, curve.shapes[i].length);
    }
    EXPECT_EQ(flow.measure().crossings, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, EveryIteration,
                         testing::Values(uint32_t{MEANDER_PRESET_EVEN}, uint32_t{MEANDER_PRESET_PAPER}));

}  // namespace
}  // namespace meander::test
