// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moves of any size leave a curve without crossings, and one knot does not hold up the rest.
#include <gtest/gtest.h>

#include <algorithm>

#include "curve/retraction.h"
#include "random_curves.h"

namespace meander::test::retraction_tests {
namespace {

constexpr double kRounding = 1e-9;  // relative, of lengths that are walked face by face

TEST(Move, OfAnySizeLeavesNoCrossings) {
  for (const Mesh& mesh : varied_meshes()) {
    const Surface s = make_surface(mesh);
    Rng rng(71);
    ThreadPool pool(2);
    Retraction retraction;
    MoveSeconds seconds;
    for (const double size : {0.01, 0.1, 0.7}) {
      Curve curve = random_curve(s, 6, rng);
      ASSERT_TRUE(whole(s, curve));
      ASSERT_GT(curve.size(), 0u);
      for (uint8_t& f : curve.fixed) f = rng() < 0.1;
      for (int round = 0; round < 4; ++round) {
        const Curve old = curve;
        NodeData<Vec2> d(curve.size());
        for (Vec2& v : d) v = size * rng() * rng.direction();
        const NodeData<double>& moved = retraction.move(s, old, d, curve, pool, seconds);
        ASSERT_EQ(moved.size(), old.size());
        for (uint32_t i = 0; i < old.size(); ++i) {
          EXPECT_LE(moved[i], norm(d[i]) * (1 + kRounding));
          EXPECT_EQ(moved[i] == 0, same_bytes(curve.nodes[i], old.nodes[i])) << i;
          // A node goes all of its way, or half of it, down to a 16th, or stays; less only where the boundary ends it.
          if (!s.boundary().empty() || moved[i] == 0) continue;
          const double halvings = std::log2(norm(d[i]) / moved[i]);
          EXPECT_NEAR(halvings, std::round(halvings), kRounding);
          EXPECT_LT(halvings, 4.5);
        }
        ASSERT_TRUE(whole(s, curve));
        ASSERT_TRUE(exact_crossings(s, curve).empty());
        ASSERT_EQ(curve.size(), old.size());
        for (uint32_t i = 0; i < curve.size(); ++i) {
          ASSERT_EQ(curve.fixed[i], old.fixed[i]);
          if (curve.fixed[i]) {
            ASSERT_TRUE(same_bytes(curve.nodes[i], old.nodes[i]));
          }
          if (!curve.has_segment(i)) continue;
          const PathShape shape =
              measure_path(s, curve.nodes[i], curve.nodes[curve.next(i)], curve.paths[i]);
          ASSERT_NEAR(shape.length, curve.shapes[i].length, kMeasured);
        }
      }
    }
  }
}

/// A node that would cross a fixed strand. It and its neighbours go half or a quarter of their way where that is short
/// enough. Where nothing is, what is within 8 nodes of its segments stays with it in the end, on both sides and across
/// the join of a closed strand; all others go all of their way.
TEST(Move, AKnotHoldsWhatIsNear) {
  constexpr uint32_t kNodes = 60;
  constexpr double kRadius = 0.08;
  const Surface s = make_surface(flat_grid(1));
  const Vec2 middle = flat(s, SurfacePoint{0, {1.0 / 3, 1.0 / 3}});
  struct Case {
    double gap, share;  // what part of their way the knot and what it holds can go
    uint32_t reach;
  };
  for (const auto& [gap, share, reach] : {Case{1e-7, 0, 8}, Case{0.006, 0.5, 0}, Case{0.003, 0.25, 0}}) {
    for (const bool closed : {false, true}) {
      for (const uint32_t knot : {1u, 6u, 30u, 58u}) {
        Curve curve;
        const auto add = [&](Vec2 p, bool fixed) { add_node(curve, point_at(s, 0, middle + p), fixed); };
        NodeData<Vec2> d(kNodes + 2);
        for (uint32_t k = 0; k < kNodes; ++k) {
          const double a = 2 * kPi * (static_cast<double>(k) - knot) / kNodes - kPi / 2;
          const Vec2 out{std::cos(a), std::sin(a)};
          add(k == knot ? Vec2{0, -1.1 * kRadius} : kRadius * out, false);
          d[k] = k == knot ? Vec2{0, -0.01} : -0.001 * out;
        }
        curve.strands.push_back({0, kNodes, closed});
        for (const double x : {-0.05, 0.05}) add({x, -1.1 * kRadius - gap}, true);
        curve.strands.push_back({kNodes, 2, false});
        join_in_face(s, curve);
        ASSERT_TRUE(exact_crossings(s, curve).empty());
        ThreadPool pool(1);
        Retraction retraction;
        MoveSeconds seconds;
        Curve next;
        const NodeData<double>& moved = retraction.move(s, curve, d, next, pool, seconds);
        for (uint32_t k = 0; k < kNodes; ++k) {
          uint32_t away = k > knot ? k - knot : knot - k;
          if (closed) away = std::min(away, kNodes - away);
          EXPECT_NEAR(moved[k], (away <= 1 + reach ? share : 1) * norm(d[k]), kRounding * norm(d[k]))
              << (closed ? "closed, " : "open, ") << "knot at " << knot << ", node " << k;
        }
        EXPECT_GT(seconds.retract, 0);
        EXPECT_GT(seconds.reconnect, 0);
        EXPECT_GT(seconds.crossings, 0);
      }
    }
  }
}

/// Paths become shortest between nodes that stay, but for guides, which stay as drawn.
TEST(Straighten, MovesNoNodeAndNoGuide) {
  const Surface s = make_surface(bumpy_grid(12));
  Rng rng(76);
  uint32_t bent = 0;
  for (const bool guide_first : {true, false}) {
    Curve curve;
    for (const bool second : {false, true}) {
      const SurfacePoint centre{second ? 78u : 208u, {1.0 / 3, 1.0 / 3}};  // far from the outline
      ASSERT_TRUE(add_ring(s, curve, centre, 0.08, 12, 0, rng));
      curve.strands.back().guide = second != guide_first;
    }
    curve.link();
    ASSERT_TRUE(exact_crossings(s, curve).empty());
    // On this ring they were the shortest; on the same faces with other corners they are not.
    const Surface moved = make_surface(with_noise(bumpy_grid(12), 0.15, 5));
    for (uint32_t i = 0; i < curve.size(); ++i) {
      curve.shapes[i] = measure_path(moved, curve.nodes[i], curve.nodes[curve.next(i)], curve.paths[i]);
    }
    const Curve old = curve;
    ThreadPool pool(2);
    Retraction retraction;
    MoveSeconds seconds;
    Curve spare;
    retraction.straighten(moved, curve, spare, pool, seconds);
    ASSERT_TRUE(whole(moved, curve));
    for (uint32_t i = 0; i < curve.size(); ++i) {
      EXPECT_TRUE(same_bytes(curve.nodes[i], old.nodes[i]));
      Path path = old.paths[i];
      if (curve.on_guide(i)) {
        ASSERT_EQ(curve.paths[i].size(), path.size());
        for (size_t k = 0; k < path.size(); ++k) EXPECT_EQ(curve.paths[i][k].t, path[k].t);
        EXPECT_EQ(curve.shapes[i].length, old.shapes[i].length);
        continue;
      }
      const PathShape shortest =
          PathShortener(moved).shorten(curve.nodes[i], curve.nodes[curve.next(i)], path);
      EXPECT_NEAR(curve.shapes[i].length, shortest.length, kMeasured);
      bent += old.shapes[i].length > shortest.length + 1e3 * kMeasured;
    }
  }
  EXPECT_GT(bent, 0u);
}

TEST(Move, OneKnotDoesNotHoldTheOthers) {
  const Surface s = make_surface(torus(24, 12));
  Rng rng(72);
  Curve curve;
  ASSERT_TRUE(add_ring(s, curve, make_point(0, 0.3, 0.3, 0.4), 0.08, 40, 0, rng));
  const uint32_t knot = curve.size();
  ASSERT_TRUE(add_ring(s, curve, make_point(s.face_count() > 300 ? 288 : 0, 0.3, 0.3, 0.4), 0.08,
                       40, 0, rng));
  ASSERT_TRUE(exact_crossings(s, curve).empty());
  const Curve old = curve;
  // The first ring shrinks a little, the second moves wildly.
  NodeData<Vec2> d(curve.size());
  for (uint32_t i = 0; i < curve.size(); ++i) {
    const uint32_t before = curve.previous(i);
    const Vec2 inwards = Vec2{0, 1} * unit(curve.shapes[before].arriving + curve.shapes[i].leaving);
    d[i] = i < knot ? 0.01 * inwards : 0.2 * rng.direction();
  }
  ThreadPool pool(2);
  Retraction retraction;
  MoveSeconds seconds;
  retraction.move(s, old, d, curve, pool, seconds);
  ASSERT_TRUE(exact_crossings(s, curve).empty());
  for (uint32_t i = 0; i < knot; ++i) {
    Path path;
    EXPECT_TRUE(same_bytes(curve.nodes[i], trace_geodesic(s, old.nodes[i], d[i], path).end));
  }
}

TEST(Move, OfNothingChangesNothing) {
  const Surface s = make_surface(sphere(2));
  Rng rng(73);
  Curve curve = random_curve(s, 5, rng);
  const Curve old = curve;
  ThreadPool pool(1);
  Retraction retraction;
  MoveSeconds seconds;
  retraction.move(s, old, NodeData<Vec2>(old.size()), curve, pool, seconds);
  for (uint32_t i = 0; i < curve.size(); ++i) {
    EXPECT_TRUE(same_bytes(curve.nodes[i], old.nodes[i]));
    EXPECT_EQ(curve.paths[i].size(), old.paths[i].size());
  }
  ASSERT_TRUE(exact_crossings(s, curve).empty());
}

/// Where nodes walk over many faces their segments are guessed first, on surfaces without handles and holes.
/// The result equals that of following the ends, face after face, even where a step is so long that the
/// first guess misses and has to be aimed again.
TEST(Move, FarOverSmallFacesFindsThePathsThatFollowTheEnds) {
  struct Case {
    Mesh mesh;
    bool simply_connected;
  };
  for (const Case& c : {Case{sphere(4), true}, Case{bumpy_grid(40), true}, Case{torus(90, 40), false},
                        Case{grid_with_hole(30), false}}) {
    const Surface s = make_surface(c.mesh);
    ASSERT_EQ(s.simply_connected(), c.simply_connected);
    Rng rng(75);
    ThreadPool pool(2);
    Retraction retraction;
    MoveSeconds seconds;
    size_t far = 0;
    for (int round = 0; round < 60; ++round) {
      const double step = round < 40 ? 0.05 : 0.3;
      Curve curve;
      while (!add_ring(s, curve, random_point(s, rng), rng.in(0.05, 0.1), 12 + rng.below(20), 0, rng)) {
      }
      const Curve old = curve;
      const Vec2 slant = rng.direction();
      NodeData<Vec2> d(curve.size());
      std::vector<Path> traces(curve.size());
      std::vector<SurfacePoint> ends;
      bool near_boundary = false;
      for (uint32_t i = 0; i < curve.size(); ++i) {
        // Outwards, and a little along the ring.
        const Vec2 along = unit(curve.shapes[curve.previous(i)].arriving + curve.shapes[i].leaving);
        d[i] = rng.in(step, 1.1 * step) * unit(Vec2{0, -1} * along + 0.2 * slant * along);
        const Trace trace = trace_geodesic(s, curve.nodes[i], d[i], traces[i]);
        ends.push_back(trace.end);
        near_boundary |= trace.hit_boundary;
      }
      if (near_boundary) continue;
      retraction.move(s, old, d, curve, pool, seconds);
      if (!std::ranges::equal(curve.nodes, ends, same_bytes)) continue;  // some have backed off
      ASSERT_TRUE(whole(s, curve));
      PathShortener shortener(s);
      for (uint32_t i = 0; i < curve.size(); ++i) {
        const uint32_t j = curve.next(i);
        Path path;
        const PathShape followed =
            shortener.follow(curve.nodes[i], curve.nodes[j], old.paths[i], traces[i], traces[j], path);
        EXPECT_NEAR(curve.shapes[i].length, followed.length, kMeasured);
        far += traces[i].size() + traces[j].size() >= 8;
      }
    }
    EXPECT_GT(far, 50u);
  }
}

TEST(Move, IsTheSameForAnyNumberOfThreads) {
  const Surface s = make_surface(sphere(2));
  Rng rng(74);
  const Curve old = random_curve(s, 8, rng);
  NodeData<Vec2> d(old.size());
  for (Vec2& v : d) v = 0.1 * rng.direction();
  std::vector<Curve> results;
  for (const unsigned threads : {1u, 2u, 5u}) {
    ThreadPool pool(threads);
    Retraction retraction;
    MoveSeconds seconds;
    retraction.move(s, old, d, results.emplace_back(), pool, seconds);
  }
  for (const Curve& c : results) {
    for (uint32_t i = 0; i < old.size(); ++i) {
      EXPECT_TRUE(same_bytes(c.nodes[i], results[0].nodes[i]));
      ASSERT_EQ(c.paths[i].size(), results[0].paths[i].size());
      for (size_t k = 0; k < c.paths[i].size(); ++k)
        EXPECT_EQ(c.paths[i][k].t, results[0].paths[i][k].t);
    }
  }
}

}  // namespace
}  // namespace meander::test::retraction_tests
