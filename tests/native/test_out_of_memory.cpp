// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whichever allocation fails, in whichever thread: what was there stays intact, and the next call works.
#include <gtest/gtest.h>

#include <algorithm>
#include <new>

#include "blocked_changes.h"
#include "curve/crossings.h"
#include "curve/refinement.h"
#include "failing_allocations.h"
#include "flow/flow.h"
#include "outputs/job.h"
#include "test_seeds.h"

namespace meander::test::out_of_memory_tests {
namespace {

enum class Outcome {
  kNotReached,   // fewer allocations were made
  kThrown,       // std::bad_alloc came out
  kDoneWithout,  // it was that of a thread of a pool which was only beginning: the others do its share
};

/// Calls work() with its n-th allocation failing.
template <class Work>
Outcome run_out_of_memory(long n, const Work& work) {
  bool thrown = false;
  const bool reached = with_failing_allocation(n, [&] {
    try {
      work();
    } catch (const std::bad_alloc&) {
      thrown = true;
    }
  });
  return thrown ? Outcome::kThrown : reached ? Outcome::kDoneWithout : Outcome::kNotReached;
}

/// Two crossing walks and a ring.
Curve tangle(const Surface& s, Rng& rng) {
  Curve c;
  add_walk(s, c, random_point(s, rng), 0.06, 80, 1.5, rng);
  add_ring(s, c, random_point(s, rng), 0.1, 30, 0.3, rng);
  add_walk(s, c, random_point(s, rng), 0.05, 40, 1.5, rng);
  return c;
}

TEST(OutOfMemory, CrossingsAreFoundAfterwards) {
  const Surface s = make_surface(sphere(2));
  Rng rng(91);
  const Curve curve = tangle(s, rng);
  Table<uint8_t> changed(curve.size(), 0);
  for (uint8_t& c : changed) c = rng() < 0.4;
  ThreadPool pool(2);
  const auto all = CrossingTest().find(s, curve, pool), some = CrossingTest().find(s, curve, pool, &changed);
  ASSERT_FALSE(some.empty());
  ASSERT_LT(some.size(), all.size());
  long failures = 0;
  for (const Table<uint8_t>* which : {static_cast<const Table<uint8_t>*>(nullptr),
                                      static_cast<const Table<uint8_t>*>(&changed)}) {
    for (long n = 0;; ++n) {
      CrossingTest test;
      const Outcome outcome = run_out_of_memory(n, [&] { test.find(s, curve, pool, which); });
      if (outcome == Outcome::kNotReached) break;
      failures += outcome == Outcome::kThrown;
      ASSERT_EQ(test.find(s, curve, pool), all) << "allocation " << n;
      ASSERT_EQ(test.find(s, curve, pool, &changed), some) << "allocation " << n;
    }
  }
  EXPECT_GT(failures, 20);
}

/// The same for the test of a few segments that have changed after one of all.
TEST(OutOfMemory, CrossingsOfChangedSegmentsAreFoundAfterwards) {
  const Surface s = make_surface(sphere(2));
  Rng rng(92);
  const Curve curve = tangle(s, rng);
  std::vector<uint32_t> changed;
  for (uint32_t i = 0; i < curve.size(); i += 9) changed.push_back(i);
  ThreadPool pool(2);
  const auto find_all = [&](CrossingTest& test) {
    test.begin(curve);
    test.collect(curve, 0);
    return test.find_collected(s, curve, pool);
  };
  const auto find_some = [&](CrossingTest& test) {
    test.begin_some(1);
    test.collect_some(curve, 0, changed);
    return test.find_again(s, curve, pool);
  };
  ASSERT_LE(curve.size(), CrossingTest::kSegmentsPerBlock);
  CrossingTest first;
  const auto all = find_all(first), some = find_some(first);
  ASSERT_FALSE(some.empty());
  ASSERT_LT(some.size(), all.size());
  long failures = 0;
  for (long n = 0;; ++n) {
    CrossingTest test;
    find_all(test);
    const Outcome outcome = run_out_of_memory(n, [&] { find_some(test); });
    if (outcome == Outcome::kNotReached) break;
    failures += outcome == Outcome::kThrown;
    ASSERT_EQ(find_all(test), all) << "allocation " << n;
    ASSERT_EQ(find_some(test), some) << "allocation " << n;
  }
  EXPECT_GT(failures, 5);
}

/// Whether two curves are the same, but for what their segments are like besides their lengths.
bool same(const Curve& a, const Curve& b) {
  const auto same_crossing = [](const Crossing& p, const Crossing& q) {
    return p.e == q.e && p.twin == q.twin && p.t == q.t;
  };
  return std::ranges::equal(a.nodes, b.nodes, same_bytes) && a.fixed == b.fixed &&
         std::ranges::equal(a.paths, b.paths,
                            [&](const Path& p, const Path& q) { return std::ranges::equal(p, q, same_crossing); }) &&
         std::ranges::equal(a.shapes, b.shapes, {}, &PathShape::length, &PathShape::length);
}

/// Also where it runs out after changes were taken back, and after an earlier curve was refined.
TEST(OutOfMemory, RefinementLeavesTheCurve) {
  const Surface s = make_surface(octahedron());
  const Blocked b = blocked_splits(s, 3, 2, [](uint32_t i) { return i % 2 == 0; });
  ThreadPool pool(2);
  Curve expected = b.curve;
  NodeData<uint32_t> origin;
  ASSERT_TRUE(Refinement().refine(s, expected, b.target, pool, origin));
  ASSERT_EQ(origin, NodeData<uint32_t>(b.origin));
  for (const bool again : {false, true}) {
    long failures = 0;
    for (long n = 0;; ++n) {
      Refinement refinement;
      if (again) {
        Curve earlier = b.curve;
        refinement.refine(s, earlier, b.target, pool, origin);
      }
      Curve curve = b.curve;
      const NodeData<uint32_t> before = origin;
      const Outcome outcome = run_out_of_memory(n, [&] { refinement.refine(s, curve, b.target, pool, origin); });
      if (outcome == Outcome::kNotReached) break;
      if (outcome == Outcome::kDoneWithout) {
        ASSERT_TRUE(same(curve, expected)) << "allocation " << n;
        continue;
      }
      ++failures;
      ASSERT_TRUE(same(curve, b.curve)) << "allocation " << n;
      ASSERT_EQ(origin, before) << "allocation " << n;
      ASSERT_TRUE(refinement.refine(s, curve, b.target, pool, origin));
      ASSERT_TRUE(same(curve, expected)) << "allocation " << n;
      ASSERT_EQ(origin, NodeData<uint32_t>(b.origin));
    }
    EXPECT_GT(failures, again ? 10 : 20);  // with memory that is kept from before: 15
  }
}

TEST(OutOfMemory, AFlowGoesOn) {
  auto surface = std::make_shared<const Surface>(make_surface(sphere(2)));
  for (const bool grown : {false, true}) {
    FlowSettings settings = checked_settings(options_of(0.2), *surface);
    settings.threads = 2;
    Flow flow(surface, nullptr, {}, settings);
    for (int k = 0; k < (grown ? 30 : 2); ++k) ASSERT_TRUE(flow.step(kNeverCancelled));
    long failures = 0, in_a_row = 0;
    for (long n = 0; in_a_row < 20 && failures < 400; n += 3) {
      const Outcome outcome = run_out_of_memory(n, [&] { flow.step(kNeverCancelled); });
      in_a_row = outcome == Outcome::kThrown ? 0 : in_a_row + 1;
      failures += in_a_row == 0;
      ASSERT_TRUE(whole(*surface, flow.curve())) << "allocation " << n;
      ASSERT_TRUE(exact_crossings(*surface, flow.curve()).empty()) << "allocation " << n;
      ASSERT_TRUE(flow.radii().empty() || flow.radii().size() == flow.curve().size());
      ASSERT_TRUE(flow.step(kNeverCancelled));
      ASSERT_EQ(flow.radii().size(), flow.curve().size());
    }
    EXPECT_GT(failures, 20);
  }
}

/// What a caller can see of a flow, and what it goes on from.
struct Seen {
  double scale, radius;
  std::vector<std::pair<uint32_t, Vec2>> nodes;
  std::vector<double> lengths, radii, history;

  explicit Seen(const Flow& flow) : scale(flow.surface().scale()), radius(flow.settings().radius) {
    for (const SurfacePoint& p : flow.curve().nodes) nodes.push_back({p.face, p.b});
    for (const PathShape& shape : flow.curve().shapes) lengths.push_back(shape.length);
    for (const Radii& r : flow.radii()) radii.insert(radii.end(), r.begin(), r.end());
    for (const IterationRecord& record : flow.history()) history.insert(history.end(), {record.length, record.energy});
  }
  bool operator==(const Seen& other) const {
    return scale == other.scale && radius == other.radius && lengths == other.lengths && radii == other.radii &&
           history == other.history && std::ranges::equal(nodes, other.nodes, [](const auto& a, const auto& b) {
             return a.first == b.first && a.second.x == b.second.x && a.second.y == b.second.y;
           });
  }
};

/// A boundary, a density, a guide, and vertices that double the size of the surface, or another spacing.
class FlowOutOfMemory : public testing::TestWithParam<bool> {};

TEST_P(FlowOutOfMemory, IsAsItWasWhereItCannotChange) {
  const Mesh mesh = flat_grid(5);
  auto surface = std::make_shared<const Surface>(make_surface(mesh));
  const std::vector<Line> lines{{{{0.2, 0.5, 0}, {0.8, 0.5, 0}}, false, true, false}};
  const SeedStrands seed = seed_of(lines, true);
  VertexData<double> density(surface->vertex_count(), 1);
  std::vector<double> moved = mesh.vertices;
  density[0] = 2;
  for (double& x : moved) x *= 2;
  const auto change = [&](Flow& flow) {
    if (GetParam()) {
      flow.set_vertices(moved);
    } else {
      flow.revise(flow.settings().with_radius(0.9 * flow.settings().radius));
    }
  };
  const auto flow_at = [&](int iterations) {
    FlowSettings settings = checked_settings(options_of(0.3), *surface);
    settings.threads = 2;
    auto flow = std::make_unique<Flow>(surface, &seed, density, settings);
    for (int k = 0; k < iterations; ++k) flow->step(kNeverCancelled);
    return flow;
  };
  for (const int iterations : {6, 60}) {  // while it grows, and in the polish
    const auto undisturbed = flow_at(iterations);
    const Seen before(*undisturbed);
    change(*undisturbed);
    const Seen after(*undisturbed);
    ASSERT_FALSE(before == after);
    auto flow = flow_at(iterations);
    long failures = 0;
    for (long n = 0;; n += failures < 60 ? 1 : 7) {
      const Outcome outcome = run_out_of_memory(n, [&] { change(*flow); });
      if (outcome == Outcome::kNotReached) break;
      if (outcome == Outcome::kDoneWithout) {
        ASSERT_TRUE(Seen(*flow) == after) << "allocation " << n;
        flow = flow_at(iterations);
        continue;
      }
      ++failures;
      ASSERT_TRUE(Seen(*flow) == before) << "allocation " << n;
      ASSERT_EQ(&flow->surface(), surface.get());
    }
    EXPECT_GT(failures, 20);
    EXPECT_TRUE(Seen(*flow) == after);
    // What failed has left nothing behind that the next iterations would see.
    for (int k = 0; k < 3; ++k) {
      undisturbed->step(kNeverCancelled);
      flow->step(kNeverCancelled);
    }
    EXPECT_TRUE(Seen(*flow) == Seen(*undisturbed));
  }
}

INSTANTIATE_TEST_SUITE_P(SurfaceMoves, FlowOutOfMemory, testing::Bool());

TEST(OutOfMemory, ARunThatCannotStartIsNotRunning) {
  auto surface = std::make_shared<const Surface>(make_surface(sphere(2)));
  FlowSettings settings = checked_settings(options_of(0.3), *surface);
  settings.iteration_limit = 1;
  Flow flow(surface, nullptr, {}, settings);
  flow.step(kNeverCancelled);  // at its limit, so that the run itself asks for nothing
  long failures = 0;
  for (long n = 0;; ++n) {
    Job job;
    const Outcome outcome = run_out_of_memory(n, [&] { job.start(flow, nullptr); });
    if (outcome != Outcome::kThrown) {
      try {
        job.wait();
        if (outcome == Outcome::kNotReached) break;
      } catch (const std::bad_alloc&) {
        // The run's own thread met the allocation that failed before this one allowed all again.
      }
      continue;
    }
    ++failures;
    ASSERT_FALSE(job.running()) << "allocation " << n;
    ASSERT_FALSE(job.started()) << "allocation " << n;
    job.start(flow, nullptr);
    EXPECT_EQ(job.wait(), StopReason::kIterationLimit);
  }
  EXPECT_GT(failures, 3);
}

}  // namespace
}  // namespace meander::test::out_of_memory_tests
