// SPDX-License-Identifier: GPL-3.0-or-later
//
// The step of an iteration: how far nodes may go, whatever the model asks for.
#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "flow/constants.h"
#include "flow/step.h"
#include "curves.h"

namespace meander::test::step_tests {
namespace {

constexpr double kRadius = 0.01;     // r; the face below is about 0.7 wide
constexpr double kRounding = 1e-12;  // in r

/// A straight strand in one large face, at rest but for what is left of its last step.
struct Scene {
  Scene() {
    settings.radius = kRadius;
    settings.segment_length = 0.5 * kRadius;
    settings.max_radius = 3 * kRadius;
    const Vec2 middle = flat(*surface, SurfacePoint{0, {1.0 / 3, 1.0 / 3}});
    for (uint32_t k = 0; k < kNodes; ++k) add_node(curve, point_at(*surface, 0, middle + Vec2{0.5 * kRadius * k, 0}));
    curve.strands.push_back({0, kNodes, false});
    join_in_face(*surface, curve);
    const ReachOfSide open{settings.max_radius, settings.max_radius, settings.max_radius};
    medial.reach.assign(kNodes, Reach{open, open});
    radii.assign(kNodes, Radii{2 * kRadius, 2 * kRadius});
  }

  /// Steps along the strand and to the side of the bitangent, in r. The last ones have left .2 and `sideways`.
  std::vector<Vec2> steps(double sideways, bool firm) {
    const LocalMetric metric = even_metric(curve, kRadius, settings.max_radius);
    compute_frames(*surface, curve, metric, RadiusField(kRadius), pool, medial.frames);
    medial.felt_radii.assign(kNodes, Radii{kRadius, kRadius});  // the same on both sides: nothing drives a node
    FlowState state{{curve, metric, {}}, settings, Domain(surface, {}, settings, pool)};
    medial.radii = radii;
    state.nodes.steps.assign(kNodes, kRadius * Vec2{0.4, 2 * sideways});
    IterationPlan plan;
    plan.momentum = 0.5;
    plan.longest_step = std::numeric_limits<double>::infinity();
    plan.firm_boundary = firm;
    Weights weights;
    weights.length.assign(kNodes, 0);
    weights.bending.assign(kNodes, 0);
    StrandSolver strands;
    Step step;
    const NodeData<Vec2>& d = step.find(plan, state, medial, weights, strands, pool);
    std::vector<Vec2> result;
    for (uint32_t i = 0; i < kNodes; ++i) {
      const Vec2 in_r = (1 / kRadius) * d[i];
      result.push_back({dot(in_r, medial.frames.tangent[i]), dot(in_r, medial.frames.bitangent2[i])});
    }
    return result;
  }

  static constexpr uint32_t kNodes = 6;
  std::shared_ptr<const Surface> surface = std::make_shared<const Surface>(make_surface(flat_grid(1)));
  ThreadPool pool{1};
  FlowSettings settings;
  Curve curve;
  MedialState medial;
  NodeData<Radii> radii;
};

TEST(Step, KeepsItsDistanceFromTheBoundary) {
  for (const uint32_t side : {0u, 1u}) {
    Scene s;
    const double sign = side == 0 ? 1 : -1;
    const double left[] = {1.5, 0.9, 0.7, 0.62, 0.5};  // of the balls of nodes 0 to 4, which the boundary ends
    for (uint32_t i = 0; i < 5; ++i) s.radii[i][side] = s.medial.reach[i][side].radius = left[i] * kRadius;
    s.radii[5][side] = 0.5 * kRadius;  // another strand ends it
    const std::vector<Vec2> kept = s.steps(0.4 * sign, true), free = s.steps(0.4 * sign, false);
    const std::vector<Vec2> away = s.steps(-0.4 * sign, true);
    const double least = kLeastTowardsBoundary, far = kKeptFromBoundary;
    const double expected[] = {0.4, 0.9 - far, 0.7 - far, least, least, 0.4};
    for (uint32_t i = 0; i < Scene::kNodes; ++i) {
      EXPECT_NEAR(kept[i].y, sign * expected[i], kRounding) << i;
      EXPECT_NEAR(kept[i].x, 0.2, kRounding) << "along the strand, node " << i;
      EXPECT_NEAR(free[i].y, sign * 0.4, kRounding) << i;
      EXPECT_NEAR(away[i].y, -sign * 0.4, kRounding) << i;
    }
  }
}

}  // namespace
}  // namespace meander::test::step_tests
