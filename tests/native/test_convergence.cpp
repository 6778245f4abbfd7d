// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order of the phases in a flow with a polish, when each of them ends, and what is left of them when the surface
// has moved or other settings are asked for.
#include <gtest/gtest.h>

#include "curve/refinement.h"
#include "flow/clamped_nodes.h"
#include "flow/constants.h"
#include "flow/convergence.h"
#include "curves.h"

namespace meander::test::convergence_tests {
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
  IterationPlan plan() const { return plan_iteration(settings_, convergence_.phase()); }
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
  Convergence convergence_{StopRule::kSettled, true, kHairpinRemoval, kPolishIterations};
  FlowSettings settings_ = with_polish();
  int notes_ = 0;
};

/// All that goes with it changes one way from rough to gentle.
TEST(Plan, RemovesHairpinsAsGentlyAsAsked) {
  FlowSettings settings = with_polish();
  IterationPlan before;
  for (const double gentleness : {0.0, 0.25, 0.5, 0.99, 1.0}) {
    settings.hairpin_removal_gentleness = gentleness;
    const IterationPlan plan = plan_iteration(settings, Phase::kHairpinRemoval);
    EXPECT_EQ(plan.hairpin_pull == kRoughPull, gentleness == 0);
    EXPECT_EQ(plan.hairpin_pull == kGentlePull, gentleness == 1);
    EXPECT_EQ(plan.momentum == kRoughMomentum, gentleness == 0);
    EXPECT_EQ(plan.momentum == kGentleMomentum, gentleness == 1);
    EXPECT_EQ(plan.medial.boundary_ease, gentleness);
    EXPECT_EQ(plan.medial.boundary_within > 0, gentleness > 0);
    if (gentleness > 0) {
      EXPECT_LT(plan.hairpin_pull, before.hairpin_pull);
      EXPECT_LT(plan.momentum, before.momentum);
    }
    before = plan;
    EXPECT_EQ(plan_iteration(settings, Phase::kPolishing).momentum, kPolishMomentum);
  }
}

/// How many iterations there are for it only says how long it takes.
TEST(Plan, IsTheSameForAnyNumberOfIterations) {
  FlowSettings settings = with_polish();
  for (const Phase phase : {Phase::kHairpinRemoval, Phase::kPolishing}) {
    settings.hairpin_removal_iterations = 1;
    const IterationPlan few = plan_iteration(settings, phase);
    for (const uint32_t iterations : {70u, 150u, 300u, 600u, UINT32_MAX}) {
      settings.hairpin_removal_iterations = iterations;
      const IterationPlan plan = plan_iteration(settings, phase);
      EXPECT_EQ(plan.hairpin_pull, few.hairpin_pull);
      EXPECT_EQ(plan.momentum, few.momentum);
      EXPECT_EQ(plan.most_turn, few.most_turn);
      EXPECT_EQ(plan.medial.boundary_ease, few.medial.boundary_ease);
    }
  }
}

/// Spikes are taken out while hairpins are removed and in the polish: growth needs them, and the last phases end when
/// nothing changes.
TEST(Plan, TakesOutSpikesInThePhasesOfGivenLength) {
  FlowSettings settings = with_polish();
  for (const double gentleness : {0.0, 0.5, 1.0}) {
    settings.hairpin_removal_gentleness = gentleness;
    for (const Phase phase : {Phase::kGrowing, Phase::kFinishing, Phase::kCooling}) {
      EXPECT_EQ(plan_iteration(settings, phase).most_turn, Refinement::kAnyTurn);
    }
    for (const Phase phase : {Phase::kHairpinRemoval, Phase::kPolishing}) {
      const double most = plan_iteration(settings, phase).most_turn;
      EXPECT_GE(most, kMostGentleTurn);
      EXPECT_LE(most, kMostTurn);
      EXPECT_EQ(most == kMostTurn, gentleness == 0);
      EXPECT_EQ(most == kMostGentleTurn, gentleness == 1);
    }
  }
  settings.boundary_distance = 0.75;  // a strip that is to stay empty
  EXPECT_EQ(plan_iteration(settings, Phase::kPolishing).most_turn, Refinement::kAnyTurn);
}

/// The same with the polish: as patient as what comes before it.
TEST(Plan, PolishesLongerAfterAGentleRemoval) {
  const auto check = [](bool full, uint32_t least, uint32_t most) {
    FlowSettings settings;
    uint32_t last = least;
    for (const double gentleness : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      settings.hairpin_removal_gentleness = gentleness;
      const uint32_t polish = polish_iterations(settings, full);
      EXPECT_GE(polish, last);
      EXPECT_EQ(polish == least, gentleness == 0);
      EXPECT_EQ(polish == most, gentleness == 1);
      last = polish;
    }
  };
  check(false, kPolishIterations, kLongPolishIterations);
  check(true, kFullPolishIterations, kLongFullPolishIterations);
}

/// Nothing is measured before the polish, nor in its first iterations; what was measured is kept by nodes at rest, but
/// where the flow follows the paper.
TEST(Plan, MeasuresBallsOnceTheCurveHasItsPlace) {
  FlowSettings settings = with_polish();
  for (const Phase phase :
       {Phase::kGrowing, Phase::kHairpinRemoval, Phase::kPolishing, Phase::kFinishing, Phase::kCooling}) {
    for (const uint32_t iterations : {0u, kUnmeasuredPolish - 1, kUnmeasuredPolish, 1000u}) {
      const bool late = phase > Phase::kPolishing ||
                        (phase == Phase::kPolishing && iterations >= kUnmeasuredPolish);
      EXPECT_EQ(plan_iteration(settings, phase, iterations).medial.measure, late);
    }
    FlowSettings unpolished = settings;
    unpolished.polish = false;
    EXPECT_TRUE(plan_iteration(unpolished, phase).medial.measure);
  }
  EXPECT_TRUE(plan_iteration(settings, Phase::kCooling).reuse_balls);
  settings.stop_rule = StopRule::kPaper;
  EXPECT_FALSE(plan_iteration(settings, Phase::kFinishing).reuse_balls);
}

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
  EXPECT_EQ(iterations_of(Phase::kPolishing, 100), kPolishIterations);
  ASSERT_EQ(convergence_.phase(), Phase::kFinishing);
  EXPECT_EQ(plan().segment_length, 1);
  EXPECT_FALSE(convergence_.converged());
}

INSTANTIATE_TEST_SUITE_P(SurfaceMovesEvery, PhasesOf, testing::Values(0, 3, 4));

/// By any rule, while the curve grows and leaves something; all but the paper's tries once to lay that.
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
        Convergence convergence(rule, true, kHairpinRemoval, kPolishIterations);
        IterationFigures figures{1, 0, wanted, moved, 1};
        figures.far_share = 0.5;
        const int before = rule == StopRule::kPaper ? 4 : 5;
        for (int k = 0; k < before; ++k) convergence.note(surface, curve, metric, figures, pool);
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
  const Convergence growing(StopRule::kSettled, true, kHairpinRemoval, kPolishIterations);
  const Convergence plain(StopRule::kSettled, false, 0, 0);
  EXPECT_EQ(growing.restarted(0).phase(), Phase::kFinishing);
  EXPECT_EQ(growing.restarted(0.5).phase(), Phase::kGrowing);
  EXPECT_EQ(plain.restarted(0).phase(), Phase::kGrowing);
}

/// A closed strand around a square in a face, whose nodes may lie anywhere between its corners.
struct Square {
  static constexpr uint32_t kPerSide = 6;
  static constexpr double kSide = 0.25, kRadius = 0.01;

  /// `moved` is how far all of it lies to the right, in r; `slid` how far nodes but the corners have gone along the
  /// sides, as a share of what is between two of them.
  void place(double moved, double slid) {
    curve = Curve();
    const Vec2 corner[4] = {{0, 0}, {kSide, 0}, {kSide, kSide}, {0, kSide}};
    for (uint32_t side = 0; side < 4; ++side) {
      for (uint32_t k = 0; k < kPerSide; ++k) {
        const double along = k == 0 ? 0 : (k + slid) / kPerSide;
        const Vec2 at = (1 - along) * corner[side] + along * corner[(side + 1) % 4];
        add(at.x + 0.4 + kRadius * moved, at.y + 0.05);
      }
    }
    curve.strands.push_back({0, curve.size(), true});
    join();
  }

  /// Adds a guide beside it, of so many nodes.
  void add_guide(uint32_t count) {
    const uint32_t first = curve.size();
    for (uint32_t k = 0; k < count; ++k) add(0.3 + 0.3 * k / count, 0.02, 1);
    curve.strands.push_back({first, count, false, true});
    join();
  }

  /// A node at this place in the face, whose first side is the first axis.
  void add(double x, double y, uint8_t fixed = 0) {
    const Triangle& face = surface.face(0);
    const Vec3 origin = surface.position(face[0]), right = (surface.position(face[1]) - origin).normalized();
    const Vec3 slanted = surface.position(face[2]) - origin;
    const Vec3 up = (slanted - slanted.dot(right) * right).normalized(), at = x * right + y * up;
    add_node(curve, point_at(surface, 0, surface.to_plane(0, at)), fixed);
    EXPECT_NEAR((position(surface, curve.nodes.back()) - origin - at).norm(), 0, 1e-12);  // it is in the face
  }
  void join() {
    join_in_face(surface, curve);
    metric = even_metric(curve, kRadius);
  }

  Surface surface = make_surface(flat_grid(1));
  Curve curve;
  LocalMetric metric;
};

/// Notes iterations on the square, with figures that say that nothing is wrong.
struct Noting : Square {
  explicit Noting(bool polish, uint32_t hairpin_removal = kHairpinRemoval, StopRule rule = StopRule::kSettled)
      : convergence(rule, polish, hairpin_removal, 0) {
    place(0, 0);
  }
  void note(double length = 1, double clamped_share = 0, double displacement_norm = 1) {
    convergence.note(surface, curve, metric, {length, clamped_share, 1, 1, displacement_norm}, pool);
  }
  void note_times(size_t times) {
    for (size_t k = 0; k < times; ++k) note();
  }
  /// Until a phase begins; false if it does not.
  bool reaches(Phase phase) {
    for (int k = 0; k < 200 && convergence.phase() != phase; ++k) note();
    return convergence.phase() == phase;
  }

  ThreadPool pool{1};
  Convergence convergence;
};

TEST(Convergence, GrowthEndsWhereTheLengthOfAWindowBeforeIsTheSame) {
  for (const size_t jump : {0u, 1u, 5u, 17u}) {  // iterations before the length changes
    Noting n(true);
    for (size_t k = 1; k <= jump + kGrowthWindow; ++k) {
      n.note(k <= jump ? 1 : 2);
      // Of a jump after the window the first lengths are compared as well, and are equal.
      if (jump <= kGrowthWindow) {
        ASSERT_EQ(n.convergence.phase(), Phase::kGrowing) << k;
      }
    }
    if (jump > kGrowthWindow) continue;
    n.note(2);
    EXPECT_EQ(n.convergence.phase(), Phase::kHairpinRemoval);
    EXPECT_EQ(n.convergence.iterations_in_phase(), 0u);
  }
}

/// Whichever way the length changes, and whether or not there are hairpins to remove.
TEST(Convergence, GrowthEndsByLengthAndEmptiness) {
  struct Case {
    double change, clamped_share;
    bool ends;
  };
  const double little = kGrownLength, sure = kGrownForSure, empty = kGrownClamped;
  for (const Case& c : {Case{1.05 * little, 0, false}, Case{0.95 * little, 0.95 * empty, true},
                        Case{0.95 * little, 1.05 * empty, false}, Case{1.05 * sure, 1.05 * empty, false},
                        Case{0.95 * sure, 1.05 * empty, true}, Case{0.95 * sure, 1, true}}) {
    for (const double sign : {1.0, -1.0}) {
      for (const uint32_t removal : {0u, 1u, kHairpinRemoval}) {
        Noting n(true, removal);
        n.note(1, 1);
        for (size_t k = 1; k < kGrowthWindow; ++k) n.note(5, 1);
        n.note(1 + sign * c.change, c.clamped_share);
        const Phase next = removal > 0 ? Phase::kHairpinRemoval : Phase::kPolishing;
        EXPECT_EQ(n.convergence.phase(), c.ends ? next : Phase::kGrowing) << c.change << " " << c.clamped_share;
      }
    }
  }
}

/// Without a polish growth ends when the curve rests, which two pictures a window apart decide. Nodes may slide along
/// the curve.
TEST(Convergence, RestIsMeasuredAcrossTheCurve) {
  // Two of the four sides lie along the move, and their nodes but for the corners in front lie on the curve as it was,
  // so 2 sides and those 2 corners are `moved` away from it.
  const double share = (2.0 * Square::kPerSide + 2 - 2) / (4.0 * Square::kPerSide);
  for (const double distance : {0.5, 0.97, 1.03, 2.0}) {
    for (const double slid : {0.0, 0.5}) {
      for (const double change : {-1.05, -0.95, 0.0, 0.95, 1.05}) {
        for (const double wide : {1.0, 2.0}) {  // the local r
          Noting n(false);
          for (size_t k = 0; k < kSettledWindow; ++k) {
            n.note(k == 0 ? 1 : 3);
            ASSERT_EQ(n.convergence.phase(), Phase::kGrowing);
          }
          n.place(distance * wide * kSettledDistance / share, slid);
          n.metric = even_metric(n.curve, wide * Square::kRadius);
          n.note(1 + change * kSettledLength);
          const bool rests = distance < 1 && std::abs(change) < 1;
          EXPECT_EQ(n.convergence.phase(), rests ? Phase::kCooling : Phase::kGrowing) << distance << " " << slid;
          if (rests) continue;
          // The next picture is compared with this one, another window later.
          for (size_t k = 1; k < kSettledWindow; ++k) {
            n.note(1 + change * kSettledLength);
            ASSERT_EQ(n.convergence.phase(), Phase::kGrowing);
          }
          n.note(1 + change * kSettledLength);
          EXPECT_EQ(n.convergence.phase(), Phase::kCooling);
        }
      }
    }
  }
}

/// However many nodes are on guides, which never move, those that may move decide.
TEST(Convergence, GuidesAreNoSignOfRest) {
  constexpr uint32_t kOnGuide = 16 * Square::kPerSide;  // four fifths
  for (const bool rests : {false, true}) {
    Noting n(false);
    n.add_guide(kOnGuide);
    n.note_times(kSettledWindow);
    n.place((rests ? 0.9 : 4) * kSettledDistance, 0);
    n.add_guide(kOnGuide);
    n.note();
    EXPECT_EQ(n.convergence.phase(), rests ? Phase::kCooling : Phase::kGrowing);
  }
}

/// What hardly moves in an iteration may yet move in a window of them.
TEST(Convergence, DriftIsNoRest) {
  Noting n(false);
  for (size_t k = 0; k < 4 * kSettledWindow; ++k) {
    n.place(0.8 * kSettledDistance * static_cast<double>(k), 0);
    n.note();
    ASSERT_EQ(n.convergence.phase(), Phase::kGrowing);
  }
  n.note_times(2 * kSettledWindow);
  EXPECT_EQ(n.convergence.phase(), Phase::kCooling);
}

TEST(Convergence, EndsWithSomeShortSteps) {
  for (const bool polish : {false, true}) {
    Noting n(polish);
    ASSERT_TRUE(n.reaches(polish ? Phase::kFinishing : Phase::kGrowing));
    if (polish) {
      n.note_times(kSettledWindow);
      EXPECT_EQ(n.convergence.phase(), Phase::kFinishing);
      EXPECT_EQ(n.convergence.iterations_in_phase(), kSettledWindow);
    }
    ASSERT_TRUE(n.reaches(Phase::kCooling));
    for (uint32_t k = 0; k < kCoolingIterations; ++k) {
      EXPECT_EQ(n.convergence.iterations_in_phase(), k);
      EXPECT_FALSE(n.convergence.converged());
      n.note();
    }
    EXPECT_TRUE(n.convergence.converged());
  }
}

/// Nodes that move by the limit itself do move, and those that are to move by it are asked to. Each iteration in which
/// something moves begins the count anew.
TEST(Convergence, StallsAfterSomeIterationsInARow) {
  Noting n(true);
  double length = 1;
  const auto idle = [&](double wanted, double moved) {
    length *= 1.1;  // it grows
    const double far = wanted >= kIdle && moved < kIdle ? 0.5 : 0;
    n.convergence.note(n.surface, n.curve, n.metric, {length, 0, wanted, moved, 1, far}, n.pool);
    return n.convergence.stalled();
  };
  EXPECT_FALSE(idle(1, 0));  // the rest is laid
  for (size_t k = 0; k < 2 * kIdleIterations; ++k) EXPECT_FALSE(idle(1, kIdle));
  for (size_t k = 0; k < 2 * kIdleIterations; ++k) EXPECT_FALSE(idle(0.99 * kIdle, 0));
  for (int round = 0; round < 2; ++round) {
    for (size_t k = 1; k < kIdleIterations; ++k) EXPECT_FALSE(idle(kIdle, 0.99 * kIdle));
    EXPECT_TRUE(idle(1, 0));
    EXPECT_TRUE(idle(1, 0));
    EXPECT_FALSE(idle(1, 1));
  }
}

/// Where the rest that was laid is most of the curve, that is finished as one that has filled the surface from its
/// start: it has no hairpins to remove.
TEST(Convergence, OfWhatIsMostlyLaid) {
  for (const double laid : {1.5, 3.0}) {
    FlowSettings settings = with_polish();
    settings.hairpin_removal_iterations = kHairpinRemoval;
    Noting n(true);
    n.convergence = Convergence(settings, Beginning::kGrown);
    IterationFigures figures;
    figures.length = 1;
    figures.wanted = figures.moved = 1;
    figures.far_share = 0.5;
    const auto note = [&] { n.convergence.note(n.surface, n.curve, n.metric, figures, n.pool); };
    while (n.convergence.phase() != Phase::kLayingRest) note();
    figures.length = laid;
    figures.laid = true;
    figures.far_share = 0;
    note();
    figures.laid = false;
    while (grows_in(n.convergence.phase())) note();
    EXPECT_EQ(n.convergence.phase(), laid > 2 ? Phase::kPolishing : Phase::kHairpinRemoval);
    EXPECT_EQ(n.convergence.began_full(), laid > 2);
  }
}

/// Where nothing can turn all that growth would do is to run on: it ends when nothing is far, and what is far is laid
/// for as long as it becomes less, without a wait between.
TEST(Convergence, OfWhatIsTooNarrowToTurn) {
  FlowSettings settings = with_polish();
  settings.hairpin_removal_iterations = kHairpinRemoval;
  for (const bool laid : {true, false}) {
    Noting n(true);
    n.convergence = Convergence(settings, Beginning::kNarrow);
    IterationFigures figures;
    figures.length = 1;
    figures.wanted = figures.moved = 1;
    figures.laid = laid;
    std::vector<Phase> phases;
    for (const double far : {0.1, 0.05, 0.0497, 0.0}) {
      EXPECT_EQ(n.convergence.asks_what_is_far(figures, 10), laid && grows_in(n.convergence.phase()));
      figures.far_share = laid ? far : 0;
      n.convergence.note(n.surface, n.curve, n.metric, figures, n.pool);
      figures.laid = false;
      phases.push_back(n.convergence.phase());
    }
    const std::vector<Phase> expected = {Phase::kLayingRest, Phase::kLayingRest, Phase::kPolishing, Phase::kPolishing};
    EXPECT_EQ(phases == expected, laid);
    EXPECT_EQ(phases == std::vector<Phase>(4, Phase::kGrowing), !laid);
  }
}

/// What lies in balance when growth would end is pushed first, once, however little it is.
TEST(Convergence, OfWhatLiesInBalance) {
  for (const double share : {0.0, 1e-4, 0.1}) {
    Noting n(true);
    IterationFigures figures;
    figures.length = 1;
    figures.wanted = figures.moved = 1;
    figures.balanced_share = share;
    const auto note = [&] { n.convergence.note(n.surface, n.curve, n.metric, figures, n.pool); };
    while (n.convergence.phase() == Phase::kGrowing) note();
    EXPECT_EQ(n.convergence.phase() == Phase::kLoosening, share > 0);
    while (n.convergence.phase() == Phase::kLoosening) note();
    EXPECT_FALSE(grows_in(n.convergence.phase()));
  }
}

/// A strand lies in balance where it has room for a whole wave; shorter ones are what two tips leave between them.
TEST(Convergence, ABalancedStretchIsAsLongAsAWave) {
  const Surface s = make_surface(Mesh{{-1, -1, 0, 1, -1, 0, 0, 1, 0}, {0, 1, 2}});
  constexpr uint32_t kNodes = 100;
  constexpr double kRadius = 0.004;
  Curve curve;
  const Vec2 middle = flat(s, SurfacePoint{0, {1.0 / 3, 1.0 / 3}});
  for (uint32_t k = 0; k < kNodes; ++k) add_node(curve, point_at(s, 0, middle + Vec2{0.25 * k * kRadius, 0}));
  curve.strands.push_back({0, kNodes, false});
  curve.link();
  join_in_face(s, curve);
  const LocalMetric metric = even_metric(curve, kRadius, 4 * kRadius);
  ThreadPool pool(1);
  for (const uint32_t roomy : {0u, 20u, 31u, 33u, 70u}) {  // 8 r are 32 segments
    NodeData<Radii> radii(kNodes, {kRadius, kRadius});
    for (uint32_t k = 10; k < 10 + roomy; ++k) radii[k] = {1.7 * kRadius, 2 * kRadius};
    EXPECT_DOUBLE_EQ(balanced_share(curve, radii, metric, pool), roomy > 32 ? roomy / 100.0 : 0);
    for (uint32_t k = 10; k < 10 + roomy; ++k) radii[k] = {1.7 * kRadius, 4 * kRadius};
    EXPECT_DOUBLE_EQ(balanced_share(curve, radii, metric, pool), roomy > 32 ? roomy / 100.0 : 0);
    for (uint32_t k = 10; k < 10 + roomy; ++k) radii[k] = {1.4 * kRadius, 2 * kRadius};
    EXPECT_EQ(balanced_share(curve, radii, metric, pool), 0);
  }
}

/// What cannot move, but leaves nothing, has come to rest; by the paper's rule it is stuck all the same.
TEST(Convergence, OfWhatFillsAndIsHeld) {
  for (const StopRule rule : {StopRule::kSettled, StopRule::kPaper}) {
    Noting n(true, kHairpinRemoval, rule);
    const IterationFigures held{1, 0, 1, 0, 1};
    for (size_t k = 0; k < kIdleIterations + kCoolingIterations; ++k) {
      n.convergence.note(n.surface, n.curve, n.metric, held, n.pool);
    }
    EXPECT_EQ(n.convergence.stalled(), rule == StopRule::kPaper);
    EXPECT_EQ(n.convergence.converged(), rule == StopRule::kSettled);
  }
}

/// By the paper's rule, whatever the curve does.
TEST(Convergence, OfThePaperIsQuietForSomeIterationsInARow) {
  Noting n(true, kHairpinRemoval, StopRule::kPaper);
  const double quiet = 0.99 * kPaperLimit, loud = kPaperLimit;  // what counts is below it
  for (uint32_t k = 1; k < kPaperIterations; ++k) {
    n.note(1, 0, quiet);
    EXPECT_EQ(n.convergence.quiet_iterations(), k);
  }
  n.note(1, 0, loud);
  EXPECT_EQ(n.convergence.quiet_iterations(), 0u);
  for (uint32_t k = 0; k < kPaperIterations; ++k) {
    EXPECT_FALSE(n.convergence.converged());
    n.note(1, 0, quiet);
  }
  EXPECT_TRUE(n.convergence.converged());
  EXPECT_EQ(n.convergence.phase(), Phase::kGrowing);
}

/// A curve is fitted by the end of a polish: what was at its end cools right after, what was not is finished first.
TEST(Convergence, GoesOnWithAPolishWhereSettingsAreRevised) {
  const FlowSettings settings = [] {
    FlowSettings s = with_polish();
    s.hairpin_removal_iterations = kHairpinRemoval;
    return s;
  }();
  for (const Phase from : {Phase::kFinishing, Phase::kCooling}) {
    for (const bool moves : {false, true}) {  // the surface, right after
      Noting n(true);
      ASSERT_TRUE(n.reaches(from));
      n.convergence = n.convergence.revised(settings, 0.1, false);
      n.note_times(3);
      n.convergence = n.convergence.revised(settings, 0.1, false);  // once more: it is fitted anew
      if (moves) n.convergence = n.convergence.restarted(1);
      ASSERT_EQ(n.convergence.phase(), Phase::kPolishing);
      n.note_times(kFittingIterations - 1);
      EXPECT_EQ(n.convergence.phase(), Phase::kPolishing);
      n.note();
      EXPECT_EQ(n.convergence.phase(), from);
    }
  }
  // What is removed goes on being removed, for as many iterations as are left.
  Noting n(true);
  ASSERT_TRUE(n.reaches(Phase::kHairpinRemoval));
  n.note_times(3);
  EXPECT_EQ(n.convergence.iterations_in_phase(), 3u);
  n.convergence = n.convergence.revised(settings, 0, false);
  EXPECT_EQ(n.convergence.phase(), Phase::kHairpinRemoval);
  n.note_times(kHairpinRemoval - 3 - 1);
  EXPECT_EQ(n.convergence.phase(), Phase::kHairpinRemoval);
  // What is past it does not go back, though more are asked for than were made.
  FlowSettings more = settings;
  more.hairpin_removal_iterations = kHairpinRemoval + 5;
  Noting finishing(true);
  ASSERT_TRUE(finishing.reaches(Phase::kFinishing));
  EXPECT_EQ(finishing.convergence.revised(more, 0, false).phase(), Phase::kPolishing);
  // If no more are asked for, the polish begins, with all of its iterations.
  FlowSettings fewer = settings;
  fewer.hairpin_removal_iterations = kHairpinRemoval - 1;
  Convergence polishing = n.convergence.revised(fewer, 0, false);
  EXPECT_EQ(polishing.phase(), Phase::kPolishing);
  EXPECT_EQ(polishing.iterations_in_phase(), 0u);
  n.note();
  ASSERT_EQ(n.convergence.phase(), Phase::kPolishing);
  n.note_times(2);
  n.convergence = n.convergence.revised(settings, 0, false);
  EXPECT_EQ(n.convergence.iterations_in_phase(), 2u);
  n.note_times(kPolishIterations - 2);
  EXPECT_EQ(n.convergence.phase(), Phase::kFinishing);
}

TEST(Convergence, GrowsAgainWhereTooMuchIsRevised) {
  const FlowSettings settings = with_polish();
  Noting n(true);
  EXPECT_EQ(n.convergence.revised(settings, 0, false).phase(), Phase::kGrowing);
  ASSERT_TRUE(n.reaches(Phase::kFinishing));
  const Convergence& made = n.convergence;
  EXPECT_EQ(made.revised(settings, 0, true).phase(), Phase::kGrowing);
  FlowSettings plain = settings;
  plain.polish = false;
  EXPECT_EQ(made.revised(plain, 0, false).phase(), Phase::kGrowing);
  // Changes add up until it grows again, also over a moving surface, and count from then on.
  const double most = kMostFitted;
  EXPECT_EQ(made.revised(settings, 0.98 * most, false).phase(), Phase::kPolishing);
  EXPECT_EQ(made.revised(settings, most, false).phase(), Phase::kPolishing);
  EXPECT_EQ(made.revised(settings, 1.02 * most, false).phase(), Phase::kGrowing);
  const Convergence half = made.revised(settings, 0.6 * most, false).restarted(0);
  EXPECT_EQ(half.revised(settings, 0.38 * most, false).phase(), Phase::kPolishing);
  n.convergence = half.revised(settings, 0.42 * most, false);
  EXPECT_EQ(n.convergence.phase(), Phase::kGrowing);
  ASSERT_TRUE(n.reaches(Phase::kPolishing));
  EXPECT_EQ(n.convergence.revised(settings, 0.98 * most, false).phase(), Phase::kPolishing);
  // One that was made without a polish grows by other rules, so it begins anew.
  Noting unpolished(false);
  ASSERT_TRUE(unpolished.reaches(Phase::kCooling));
  EXPECT_EQ(unpolished.convergence.revised(settings, 0, false).phase(), Phase::kGrowing);
}

/// How much of the curve still sees nothing beside it decides whether it has filled the surface when this moves.
TEST(Convergence, OnAMovedSurfaceGrowsOnlyWhereItHasNotFilledIt) {
  const Convergence growing(StopRule::kSettled, true, kHairpinRemoval, kPolishIterations);
  EXPECT_EQ(growing.restarted(0.95 * kGrownClamped).phase(), Phase::kFinishing);
  EXPECT_EQ(growing.restarted(kGrownClamped).phase(), Phase::kGrowing);
  EXPECT_EQ(growing.restarted(1.05 * kGrownClamped).phase(), Phase::kGrowing);
  for (const Phase phase : {Phase::kFinishing, Phase::kCooling}) {
    Noting n(true);
    ASSERT_TRUE(n.reaches(phase));
    EXPECT_EQ(n.convergence.restarted(1).phase(), Phase::kFinishing);
  }
}

}  // namespace
}  // namespace meander::test::convergence_tests
