// SPDX-License-Identifier: GPL-3.0-or-later
//
// Splits and collapses keep segments near the target length, and the curve intact.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "blocked_changes.h"
#include "curve/refinement.h"
#include "random_curves.h"

namespace meander::test::refinement_tests {
namespace {

/// Cuts are rounded into the face (clearance and grain), and each changes the length by up to this.
constexpr double kCut = 8 * kClearance;

struct Refined {
  Curve curve;
  NodeData<uint32_t> origin;
  bool changed = false;
};

Refined refine(const Surface& s, const Curve& curve, double h, unsigned threads = 2,
               double most_turn = Refinement::kAnyTurn) {
  Refined r{curve, {}};
  ThreadPool pool(threads);
  Refinement refinement;
  r.changed = refinement.refine(s, r.curve, NodeData<double>(curve.size(), h), pool, r.origin, most_turn);
  if (!r.changed) {
    r.origin.resize(curve.size());
    std::iota(r.origin.begin(), r.origin.end(), 0u);
  }
  return r;
}

double longest(const Curve& c) {
  double l = 0;
  for (uint32_t i = 0; i < c.size(); ++i) {
    if (c.has_segment(i)) l = std::max(l, c.shapes[i].length);
  }
  return l;
}

double shortest(const Curve& c) {
  double l = 1e9;
  for (uint32_t i = 0; i < c.size(); ++i) {
    if (c.has_segment(i)) l = std::min(l, c.shapes[i].length);
  }
  return l;
}

/// The new nodes come from the old ones, in order; what was fixed stays to the last bit.
void expect_origin(const Curve& old, const Refined& r) {
  ASSERT_EQ(r.origin.size(), r.curve.size());
  ASSERT_EQ(r.curve.strands.size(), old.strands.size());
  std::vector<uint8_t> seen(old.size(), 0);
  for (size_t k = 0; k < old.strands.size(); ++k) {
    const Strand &a = old.strands[k], &b = r.curve.strands[k];
    EXPECT_EQ(a.closed, b.closed);
    uint32_t last = kNone;
    for (uint32_t i = b.first; i < b.end(); ++i) {
      const uint32_t o = r.origin[i];
      ASSERT_GE(o, a.first);
      ASSERT_LT(o, a.end());
      if (o == last) {
        EXPECT_FALSE(r.curve.fixed[i]) << "a new node is free";
        continue;
      }
      ASSERT_TRUE(last == kNone || o > last);
      last = o;
      seen[o] = 1;
      EXPECT_TRUE(same_bytes(r.curve.nodes[i], old.nodes[o]));
      EXPECT_EQ(r.curve.fixed[i], old.fixed[o]);
    }
    EXPECT_EQ(r.origin[b.first], a.first);
    if (!a.closed) {
      EXPECT_TRUE(same_bytes(r.curve.nodes[b.end() - 1], old.nodes[a.end() - 1])) << "ends stay";
    }
  }
  for (uint32_t i = 0; i < old.size(); ++i) {
    if (old.fixed[i]) {
      EXPECT_TRUE(seen[i]) << "fixed node " << i << " was removed";
    }
  }
}

/// Some of whose nodes are fixed.
Curve partly_fixed(const Surface& s, Rng& rng) {
  Curve curve = random_curve(s, 4, rng);
  for (uint8_t& f : curve.fixed) f = rng() < 0.05;
  return curve;
}

TEST(Refine, KeepsTheCurveWholeAndItsSegmentsShort) {
  for (const Mesh& mesh : varied_meshes()) {
    const Surface s = make_surface(mesh);
    Rng rng(81);
    for (int round = 0; round < 12; ++round) {
      const Curve old = partly_fixed(s, rng);
      const double h = rng.in(0.002, 0.06);
      const Refined r = refine(s, old, h);
      ASSERT_TRUE(whole(s, r.curve));
      ASSERT_TRUE(exact_crossings(s, r.curve).empty());
      expect_origin(old, r);
      for (uint32_t i = 0; i < r.curve.size(); ++i) {
        if (!r.curve.has_segment(i)) continue;
        const double l = r.curve.shapes[i].length;
        const PathShape shape =
            measure_path(s, r.curve.nodes[i], r.curve.nodes[r.curve.next(i)], r.curve.paths[i]);
        EXPECT_NEAR(l, shape.length, kMeasured);
        if (l <= 2 * h + kCut) continue;
        // A split is omitted only if it made segments cross: then the old segment is still there.
        const uint32_t o = r.origin[i];
        EXPECT_EQ(l, old.shapes[o].length);
      }
    }
  }
}

TEST(Refine, SplittingKeepsLengthAndPlace) {
  for (const Mesh& mesh : varied_meshes()) {
    const Surface s = make_surface(mesh);
    Rng rng(82);
    for (int round = 0; round < 8; ++round) {
      const Curve old = partly_fixed(s, rng);
      const double h = 0.99 * std::min(shortest(old), longest(old) / 3);  // nothing is short
      const Refined r = refine(s, old, h);
      EXPECT_GT(r.curve.size(), old.size());
      EXPECT_LE(longest(r.curve), 2 * h + kCut);
      EXPECT_GE(shortest(r.curve), h - kCut) << "a split makes no segment that should collapse";
      EXPECT_NEAR(r.curve.length(), old.length(), kCut * r.curve.size());
      // No old node is gone, and a second pass has nothing to do.
      size_t kept = 0;
      for (uint32_t i = 0; i < r.curve.size(); ++i)
        kept += i == 0 || r.origin[i] != r.origin[i - 1];
      EXPECT_EQ(kept, old.size());
      const Refined again = refine(s, r.curve, h);
      EXPECT_EQ(again.curve.size(), r.curve.size());
      EXPECT_FALSE(again.changed);
    }
  }
}

/// One pass removes at most every other node; the passes come to an end, and none splits what an
/// earlier one joined.
TEST(Refine, RepeatedComesToRest) {
  for (const Mesh& mesh : varied_meshes()) {
    const Surface s = make_surface(mesh);
    Rng rng(83);
    for (int round = 0; round < 8; ++round) {
      Refined r{partly_fixed(s, rng), {}};
      const double h = rng.in(0.002, 0.06);
      r = refine(s, r.curve, h);
      bool rest = false;
      for (uint32_t pass = 0; pass < 40 && !rest; ++pass) {
        const Refined next = refine(s, r.curve, h);
        ASSERT_LE(next.curve.size(), r.curve.size());
        ASSERT_TRUE(exact_crossings(s, next.curve).empty());
        for (uint32_t i = 1; i < next.curve.size(); ++i)
          ASSERT_NE(next.origin[i], next.origin[i - 1]) << "a split";
        rest = next.curve.size() == r.curve.size();
        r = next;
      }
      EXPECT_TRUE(rest);
      // Whatever could still be joined would then cross something.
      for (const Strand& strand : r.curve.strands) {
        for (uint32_t i = strand.first; i + 2 < strand.end() && strand.count > 3; ++i) {
          const double l = r.curve.shapes[i].length, l2 = r.curve.shapes[i + 1].length;
          if (r.curve.fixed[i + 1] || std::min(l, l2) >= h || l + l2 > 2 * h) continue;
          Curve joined = r.curve;
          joined.nodes.erase(joined.nodes.begin() + i + 1);
          Path path = joined.paths[i];
          path.insert(path.end(), joined.paths[i + 1].begin(), joined.paths[i + 1].end());
          PathShortener(s).shorten(r.curve.nodes[i], r.curve.nodes[i + 2], path);
          joined.paths[i] = path;
          joined.paths.erase(joined.paths.begin() + i + 1);
          for (Strand& other : joined.strands) {
            if (other.first == strand.first) --other.count;
            if (other.first > strand.first) --other.first;
          }
          joined.link();
          EXPECT_FALSE(exact_crossings(s, joined).empty()) << "nodes " << i << " to " << i + 2;
        }
      }
    }
  }
}

/// The rule, node after node, where nothing would cross: the origins of the new nodes.
std::vector<uint32_t> one_after_another(const Curve& curve, double h) {
  std::vector<uint32_t> origin;
  for (const Strand& strand : curve.strands) {
    uint32_t left = strand.count;
    for (uint32_t i = strand.first; i < strand.end(); ++i) {
      origin.push_back(i);
      if (!curve.has_segment(i)) continue;
      const uint32_t j = i + 1;
      const double l = curve.shapes[i].length;
      if (j < strand.end() && curve.has_segment(j) && !curve.fixed[j] && left > (strand.closed ? 3u : 2u)) {
        const double l2 = curve.shapes[j].length;
        if (std::min(l, l2) < h && l + l2 <= 2 * h) {
          --left;
          ++i;  // goes
          continue;
        }
      }
      if (l <= 2 * h) continue;
      const int parts = std::max(2, static_cast<int>(std::round(l / (1.5 * h))));
      for (int p = 1; p < parts; ++p) origin.push_back(i);
    }
  }
  return origin;
}

TEST(Refine, ManyNodesAreRefinedAsOneAfterAnother) {
  const Surface s = make_surface(flat_grid(8));  // flat, so that rays never meet
  Rng rng(85);
  for (int round = 0; round < 4; ++round) {
    Curve old;
    const SurfacePoint centre{static_cast<uint32_t>(s.face_count()) / 2 + 8, {0.3, 0.3}};  // in the middle
    for (const double radius : {0.1, 0.15, 0.2}) {  // rings of neighbours at unequal distances
      ASSERT_TRUE(add_ring(s, old, centre, radius, 3000 + rng.below(3000), 0.002, rng));
    }
    ASSERT_TRUE(exact_crossings(s, old).empty());
    const double h = rng.in(0.5, 1.5) * old.length() / old.size();
    const NodeData<uint32_t> expected(one_after_another(old, h));
    const Refined r = refine(s, old, h, 1);
    ASSERT_TRUE(whole(s, r.curve));
    EXPECT_EQ(r.origin, expected);
    EXPECT_NE(r.origin.size(), old.size());
    for (const unsigned threads : {2u, 16u}) {
      const Refined other = refine(s, old, h, threads);
      ASSERT_EQ(other.origin, r.origin);
      for (uint32_t i = 0; i < r.curve.size(); ++i) {
        EXPECT_TRUE(same_bytes(other.curve.nodes[i], r.curve.nodes[i]));
        EXPECT_EQ(other.curve.shapes[i].length, r.curve.shapes[i].length);
      }
    }
  }
}

/// However many there are before: a pass removes every other node of most strands.
TEST(Refine, KeepsTheLeastNumberOfNodes) {
  const Surface s = make_surface(sphere(2));
  Rng rng(84);
  for (uint32_t count = 3; count <= 20; ++count) {
    Curve curve;
    ASSERT_TRUE(add_ring(s, curve, random_point(s, rng), 0.02, count, 0, rng));
    add_walk(s, curve, random_point(s, rng), 0.001, count - 1, 0.1, rng);
    ASSERT_TRUE(exact_crossings(s, curve).empty());
    Refined r{curve, {}};
    for (int pass = 0; pass < 12; ++pass) {
      const NodeData<uint32_t> expected(one_after_another(r.curve, 0.9));
      r = refine(s, r.curve, 0.9);
      ASSERT_TRUE(whole(s, r.curve));
      EXPECT_EQ(r.origin, expected);
    }
    EXPECT_EQ(r.curve.strands[0].count, 3u);
    EXPECT_EQ(r.curve.strands[1].count, 2u);
  }
}

/// Nothing crosses before, and what has to come of it does.
void expect_refined(const Surface& s, const Blocked& b) {
  ASSERT_TRUE(whole(s, b.curve));
  ASSERT_TRUE(exact_crossings(s, b.curve).empty());
  ThreadPool pool(2);
  Curve curve = b.curve;
  NodeData<uint32_t> origin;
  ASSERT_TRUE(Refinement().refine(s, curve, b.target, pool, origin));
  ASSERT_TRUE(whole(s, curve));
  EXPECT_TRUE(exact_crossings(s, curve).empty());
  expect_origin(b.curve, {curve, origin, true});
  ASSERT_EQ(origin, NodeData<uint32_t>(b.origin));
  for (uint32_t n = 0; n < curve.size(); ++n) {
    EXPECT_TRUE(same_bytes(curve.nodes[n], b.new_nodes[n])) << "node " << n;
    if (!curve.has_segment(n)) continue;
    const PathShape shape = measure_path(s, curve.nodes[n], curve.nodes[curve.next(n)], curve.paths[n]);
    EXPECT_NEAR(curve.shapes[n].length, shape.length, kMeasured) << "segment " << n;
  }
}

/// A segment is left whole where one of its cuts would touch something; all others are split.
TEST(Refine, ASplitThatTouchesIsTakenBack) {
  const Surface s = make_surface(octahedron());
  for (const uint32_t parts : {2u, 3u, 5u}) {
    for (uint32_t k = 1; k < parts; ++k) {
      SCOPED_TRACE(testing::Message() << "cut " << k << " of " << parts << " parts");
      size_t count = 0;
      for (uint32_t i = 0; i < 12; ++i) {
        const Blocked b = blocked_splits(s, parts, k, [&](uint32_t j) { return j == i; });
        count += b.count;
        expect_refined(s, b);
      }
      EXPECT_GT(count, 5u);
      const Blocked b = blocked_splits(s, parts, k, [](uint32_t j) { return j % 3 != 1; });
      EXPECT_GT(b.count, 2u);
      expect_refined(s, b);
    }
  }
}

/// A node stays where the shorter way would cross something, and what is beside it is left as it is; all others that
/// may go do.
TEST(Refine, ACollapseThatCrossesIsTakenBack) {
  const Surface s = make_surface(octahedron());
  for (const bool closed : {false, true}) {
    for (const bool long_after : {false, true}) {
      SCOPED_TRACE(testing::Message() << "closed " << closed << " long_after " << long_after);
      for (uint32_t i = 1; i < (closed ? 12u : 11u); i += 2) {
        SCOPED_TRACE(i);
        expect_refined(s, blocked_collapses(s, closed, long_after, [&](uint32_t j) { return j == i; }));
      }
      expect_refined(s, blocked_collapses(s, closed, long_after, [](uint32_t j) { return j == 3 || j == 7; }));
    }
  }
}

constexpr double kDoubledBack = 2 * std::numbers::pi / 3;

/// A ring in face 0 of the octahedron with a spike: four segments out to its tip and four back, close beside each
/// other.
struct Spike {
  Curve curve;
  double target = 0;  // lets every segment be as long as it is
  uint32_t tip = 0;
  Vec2 short_of_tip, at_tip;  // inside of the spike: farther back than the nodes before and after its tip, and beyond

  static constexpr Vec2 kCentre{0.4, 0.3};
  static constexpr double kRadius = 0.16;

  // The face is equilateral, and x and y are the weights of two of its corners.
  static Vec2 in_plane(Vec2 b) { return {b.x + 0.5 * b.y, std::sqrt(0.75) * b.y}; }
  static Vec2 in_face(double x, double y) {
    const Vec2 p = kCentre + Vec2{x, y};
    const double second = p.y / std::sqrt(0.75);
    return {snap(p.x - 0.5 * second), snap(second)};
  }
};

Spike ring_with_spike(const Surface& s, bool fixed_tip = false) {
  constexpr int kCount = 20, kLeg = 3;
  constexpr double kStep = 0.05, kSide = 0.0025;
  Spike spike;
  const auto add = [&](double x, double y, bool fixed = false) {
    add_node(spike.curve, {0, Spike::in_face(x, y)}, fixed);
  };
  for (int k = 0; k < kCount; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.5) / kCount + std::numbers::pi / 2;
    add(Spike::kRadius * std::cos(angle), Spike::kRadius * std::sin(angle));
    if (k + 1 != 3 * kCount / 4) continue;
    for (int leg = 1; leg <= kLeg; ++leg) add(Spike::kRadius + leg * kStep, -kSide);
    spike.tip = spike.curve.size();
    add(Spike::kRadius + (kLeg + 1) * kStep, 0, fixed_tip);
    for (int leg = kLeg; leg > 0; --leg) add(Spike::kRadius + leg * kStep, kSide);
  }
  spike.short_of_tip = Spike::in_face(Spike::kRadius + (kLeg - 0.5) * kStep, 0);
  spike.at_tip = Spike::in_face(Spike::kRadius + (kLeg + 0.5) * kStep, 0);
  spike.curve.strands = {{0, spike.curve.size(), true}};
  join_in_face(s, spike.curve);
  spike.target = spike.curve.shapes[spike.tip].length / 1.5;
  return spike;
}

/// The sharpest turn of a curve in one face, from its places.
double sharpest_turn(const Curve& c) {
  double most = 0;
  for (uint32_t i = 0; i < c.size(); ++i) {
    if (c.previous(i) == kNone || c.next(i) == kNone) continue;
    const Vec2 before = Spike::in_plane(c.nodes[c.previous(i)].b), here = Spike::in_plane(c.nodes[i].b);
    const Vec2 in = here - before, out = Spike::in_plane(c.nodes[c.next(i)].b) - here;
    most = std::max(most, std::acos(std::clamp(dot(in, out) / (norm(in) * norm(out)), -1.0, 1.0)));
  }
  return most;
}

/// No other rule touches a spike: its segments are as long as they are to be.
TEST(Refine, TakesOutWhereAStrandDoublesBack) {
  const Surface s = make_surface(octahedron());
  const Spike spike = ring_with_spike(s);
  ASSERT_TRUE(whole(s, spike.curve));
  ASSERT_TRUE(exact_crossings(s, spike.curve).empty());
  ASSERT_GT(sharpest_turn(spike.curve), kDoubledBack);
  EXPECT_FALSE(refine(s, spike.curve, spike.target).changed);

  Refined r{spike.curve, {}};
  for (int pass = 0; pass < 20; ++pass) {
    const Refined next = refine(s, r.curve, spike.target, 2, kDoubledBack);
    if (pass == 0) {
      std::vector<uint32_t> expected(spike.curve.size());
      std::iota(expected.begin(), expected.end(), 0u);
      expected.erase(expected.begin() + spike.tip);
      EXPECT_EQ(next.origin, NodeData<uint32_t>(expected));
    }
    expect_origin(r.curve, next);
    ASSERT_TRUE(whole(s, next.curve));
    ASSERT_TRUE(exact_crossings(s, next.curve).empty());
    ASSERT_LE(next.curve.size(), r.curve.size()) << "a node that goes does not come back";
    r = next;
    if (!next.changed) break;
  }
  EXPECT_FALSE(r.changed) << "comes to rest";
  EXPECT_LE(sharpest_turn(r.curve), kDoubledBack);
  EXPECT_GE(r.curve.size(), 18u);
  for (const SurfacePoint& p : r.curve.nodes) {
    EXPECT_NEAR(norm(Spike::in_plane(p.b) - Spike::kCentre), Spike::kRadius, 0.01) << "what is left is the ring";
  }
}

/// A tip that is held stays, and so does one where the shorter way would cross something.
TEST(Refine, LeavesATipThatIsHeld) {
  const Surface s = make_surface(octahedron());
  EXPECT_FALSE(refine(s, ring_with_spike(s, true).curve, ring_with_spike(s).target, 2, kDoubledBack).changed);

  Blocked b;
  const Spike spike = ring_with_spike(s);
  b.curve = spike.curve;
  b.target = NodeData<double>(b.curve.size(), spike.target);
  add_needle(s, b, spike.short_of_tip, spike.at_tip);
  ASSERT_TRUE(exact_crossings(s, b.curve).empty());
  ThreadPool pool(2);
  NodeData<uint32_t> origin;
  EXPECT_FALSE(Refinement().refine(s, b.curve, b.target, pool, origin, kDoubledBack));
  EXPECT_EQ(b.curve.size(), spike.curve.size() + 2);
}

/// One change anywhere along a curve of several blocks, which threads lay out one by one.
TEST(Refine, OneChangeIsMadeBesideAnyBlock) {
  const Surface s = make_surface(flat_grid(8));
  Rng rng(86);
  Curve old;
  constexpr uint32_t kBlock = kNodeGrain, kCount = 2 * kBlock + 100;
  ASSERT_TRUE(add_ring(s, old, {static_cast<uint32_t>(s.face_count()) / 2 + 8, {0.3, 0.3}}, 0.2, kCount, 0, rng));
  const double l = old.length() / kCount;
  ThreadPool pool(2);
  for (const uint32_t at : {0u, 1u, kBlock - 2, kBlock - 1, kBlock, 2 * kBlock - 1, kCount - 2}) {
    for (const bool splits : {false, true}) {
      SCOPED_TRACE(testing::Message() << (splits ? "split after " : "collapse after ") << at);
      NodeData<double> target(kCount, 0.8 * l);
      target[at] = splits ? l / 3 : 1.2 * l;
      std::vector<uint32_t> expected(kCount);
      std::iota(expected.begin(), expected.end(), 0u);
      if (splits) {
        expected.insert(expected.begin() + at, at);
      } else {
        expected.erase(expected.begin() + at + 1);
      }
      Curve curve = old;
      NodeData<uint32_t> origin;
      ASSERT_TRUE(Refinement().refine(s, curve, target, pool, origin));
      ASSERT_TRUE(whole(s, curve));
      EXPECT_EQ(origin, NodeData<uint32_t>(expected));
    }
  }
}

}  // namespace
}  // namespace meander::test::refinement_tests
