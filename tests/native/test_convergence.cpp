// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order of the phases in a flow with a polish, and that a moving surface does not restart them.
#include <gtest/gtest.h>

#include "flow/convergence.h"
#include "test_curves.h"

namespace meander::test {
namespace {

constexpr uint32_t kHairpinRemoval = 7;

FlowSettings with_polish() {
  FlowSettings settings;
  settings.polish = true;
  settings.segment_length = 1;
  settings.growth_coarsening = 2;
  return settings;
}

class PhasesOf : public testing::TestWithParam<int> {
 protected:
  PhasesOf() {
    Rng rng(3);
    EXPECT_TRUE(add_ring(surface_, curve_, random_point(surface_, rng), 0.02, 12, 0.1, rng));
    metric_ = even_metric(curve_, 0.01);
  }

  /// One more iteration in which nothing changes. At regular intervals the surface moves.
  void note() {
    if (GetParam() > 0 && ++notes_ % GetParam() == 0 && convergence_.phase() != Phase::kGrowing) {
      convergence_ = convergence_.restarted(0);
    }
    IterationFigures figures;
    figures.length = 1;
    figures.wanted = figures.moved = 1;
    convergence_.note(surface_, curve_, metric_, figures, pool_);
  }
  Plan plan() const { return plan_iteration(settings_, convergence_.phase()); }
  /// Iterations until the phase ends, at most `most`.
  uint32_t iterations_of(Phase phase, uint32_t most) {
    uint32_t k = 0;
    for (; k < most && convergence_.phase() == phase; ++k) note();
    return k;
  }

  Surface surface_ = make_surface(sphere(3));
  Curve curve_;
  LocalMetric metric_;
  ThreadPool pool_{1};
  Convergence convergence_{StopRule::kSettled, true, kHairpinRemoval};
  FlowSettings settings_ = with_polish();
  int notes_ = 0;
};

TEST_P(PhasesOf, FollowOneAnother) {
  EXPECT_FALSE(plan().polishing);
  EXPECT_EQ(plan().segment_length, 2);
  EXPECT_EQ(plan().momentum, 0);
  EXPECT_LT(iterations_of(Phase::kGrowing, 100), 100u);
  ASSERT_EQ(convergence_.phase(), Phase::kHairpinRemoval);
  EXPECT_TRUE(plan().polishing);
  EXPECT_EQ(plan().segment_length, 2);
  EXPECT_GT(plan().momentum, 0);
  EXPECT_EQ(iterations_of(Phase::kHairpinRemoval, 100), kHairpinRemoval);
  ASSERT_EQ(convergence_.phase(), Phase::kPolishing);
  EXPECT_EQ(plan().segment_length, 2);
  EXPECT_EQ(iterations_of(Phase::kPolishing, 100), 30u);
  ASSERT_EQ(convergence_.phase(), Phase::kFinishing);
  EXPECT_EQ(plan().segment_length, 1);
  EXPECT_FALSE(convergence_.converged());
}

INSTANTIATE_TEST_SUITE_P(SurfaceMovesEvery, PhasesOf, testing::Values(0, 3, 4));

/// In any phase, and by any rule.
TEST(Convergence, StallsOnlyWhereNodesAreHeld) {
  const Surface surface = make_surface(sphere(2));
  Rng rng(4);
  Curve curve;
  ASSERT_TRUE(add_ring(surface, curve, random_point(surface, rng), 0.02, 12, 0.1, rng));
  const LocalMetric metric = even_metric(curve, 0.01);
  ThreadPool pool(1);
  for (const StopRule rule : {StopRule::kSettled, StopRule::kPaper}) {
    for (const double wanted : {0.0, 1e-3}) {
      for (const double moved : {0.0, 1e-6}) {
        Convergence convergence(rule, true, kHairpinRemoval);
        IterationFigures figures{1, 0, wanted, moved, 1};
        for (int k = 0; k < 4; ++k) convergence.note(surface, curve, metric, figures, pool);
        EXPECT_FALSE(convergence.stalled());
        convergence.note(surface, curve, metric, figures, pool);
        EXPECT_EQ(convergence.stalled(), wanted > 0 && moved == 0);
        EXPECT_FALSE(convergence.restarted(0).stalled());
        figures.moved = 1;
        convergence.note(surface, curve, metric, figures, pool);
        EXPECT_FALSE(convergence.stalled());
      }
    }
  }
}

/// A curve that fills the surface, but has seen no hairpin removal when the surface first moves, is only
/// finished; a curve that does not fill it continues to grow.
TEST(Convergence, DoesNotBeginAnewWhereTheSurfaceMoves) {
  const Convergence growing(StopRule::kSettled, true, kHairpinRemoval), plain(StopRule::kSettled, false, 0);
  EXPECT_EQ(growing.restarted(0).phase(), Phase::kFinishing);
  EXPECT_EQ(growing.restarted(0.5).phase(), Phase::kGrowing);
  EXPECT_EQ(plain.restarted(0).phase(), Phase::kGrowing);
}

}  // namespace
}  // namespace meander::test
