// SPDX-License-Identifier: GPL-3.0-or-later
//
// The crossing test against a comparison of all pairs in exact integers.
#include <gtest/gtest.h>

#include <array>
#include <ctime>

#include "curve/crossings.h"
#include "curves.h"

namespace meander::test::crossings_tests {
namespace {

using Pairs = std::vector<std::pair<uint32_t, uint32_t>>;

Pairs brute_force(const Surface& s, const Curve& c, const Table<uint8_t>* changed = nullptr) {
  Pairs pairs;
  for (const auto& p : exact_crossings(s, c)) {
    if (!changed || (*changed)[p.first] || (*changed)[p.second]) pairs.push_back(p);
  }
  return pairs;
}

/// Without a list of changes, with random ones, and with thread pools of different sizes.
void expect_equal(const Surface& s, const Curve& curve, Rng& rng) {
  ASSERT_TRUE(whole(s, curve));
  CrossingTest test;
  ThreadPool one(1), three(3);
  const Pairs expected = brute_force(s, curve);
  EXPECT_EQ(test.find(s, curve, one), expected);
  EXPECT_EQ(test.find(s, curve, three), expected);
  for (const double share : {0.0, 0.1, 0.7, 1.0}) {
    Table<uint8_t> changed(curve.size(), 0);
    for (uint8_t& c : changed) c = rng() < share;
    EXPECT_EQ(test.find(s, curve, three, &changed), brute_force(s, curve, &changed));
  }
}

Curve strand_in_face(const Surface& s, const std::vector<Vec2>& points, bool closed) {
  Curve c;
  for (const Vec2 p : points) add_node(c, {0, p});
  c.strands.push_back({0, c.size(), closed});
  join_in_face(s, c);
  return c;
}

TEST(Crossings, EqualBruteForceInACrowdedFace) {
  const Surface s = make_surface(octahedron());
  Rng rng(21);
  for (const uint32_t n : {3u, 10u, 24u, 25u, 60u, 400u}) {
    for (const double step : {0.02, 0.1, 1.0}) {
      for (const bool closed : {true, false}) {
        std::vector<Vec2> points;
        Vec2 at{0.3, 0.3};
        for (uint32_t k = 0; k < n; ++k) {
          at = {at.x + step * rng.in(-1, 1), at.y + step * rng.in(-1, 1)};
          const SurfacePoint p = make_point(0, 1 - at.x - at.y, at.x, at.y);
          at = p.b;
          points.push_back(p.b);
        }
        expect_equal(s, strand_in_face(s, points, closed), rng);
      }
    }
  }
}

/// Coordinates of an 8 x 8 lattice: most pairs touch, overlap or share corners without being
/// neighbours.
TEST(Crossings, EqualBruteForceWhereEverythingTouches) {
  const Surface s = make_surface(octahedron());
  Rng rng(22);
  for (int round = 0; round < 300; ++round) {
    const uint32_t n = 4 + rng.below(round % 10 == 0 ? 80 : 12);
    std::vector<Vec2> points;
    while (points.size() < n) {
      const Vec2 p{(1 + rng.below(7)) / 16.0, (1 + rng.below(7)) / 16.0};
      if (!points.empty() && points.back().x == p.x && points.back().y == p.y) continue;
      points.push_back(p);
    }
    if (points.front().x == points.back().x && points.front().y == points.back().y)
      points.back().x += 1.0 / 32;
    expect_equal(s, strand_in_face(s, points, round % 2 == 0), rng);
  }
}

/// As where strands wind round a limb thinner than the spacing: each piece goes from side to side of its face. When
/// all of them were put into all cells of a grid, this took the cube of their number.
TEST(Crossings, OfPiecesFromSideToSideOfAFaceAreFoundInTime) {
  const Surface s = make_surface(octahedron());
  constexpr uint32_t kLines = 1500;
  std::vector<Vec2> points;
  for (uint32_t k = 0; k < kLines; ++k) {
    const double t = 0.5 + 0.45 * k / kLines;
    const Vec2 one = make_point(0, 0.99 - t, t, 0.01).b, other = make_point(0, 0.99 - t, 0.01, t).b;
    points.push_back(k % 2 ? one : other);
    points.push_back(k % 2 ? other : one);
  }
  CrossingTest test;
  ThreadPool pool(1);
  const auto find = [&] { return test.find(s, strand_in_face(s, points, false), pool); };
  const std::clock_t begin = std::clock();
  EXPECT_TRUE(find().empty());
  std::swap(points[1000], points[1004]);
  EXPECT_EQ(find(), brute_force(s, strand_in_face(s, points, false)));
  EXPECT_FALSE(find().empty());
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 3.0);  // measured: .03; 30 with cells
}

/// As round the tip of a spike: pieces side by side, each across one of the three corners, some of which lean over and
/// touch or cross the next.
TEST(Crossings, EqualBruteForceAcrossEachCornerOfAFace) {
  const Surface s = make_surface(octahedron());
  Rng rng(26);
  for (const uint32_t lines : {20u, 100u, 300u}) {
    for (size_t corner = 0; corner < 3; ++corner) {
      for (const uint32_t lean : {0u, 1u, 3u}) {
        std::vector<Vec2> points;
        const auto add = [&](uint32_t line, bool other_side) {
          const double away = (8 + line + rng.below(lean + 1)) / 512.0, aside = 1.0 / 512;
          std::array<double, 3> w{};
          w[corner] = 1 - away;
          w[(corner + 1) % 3] = other_side ? away - aside : aside;
          w[(corner + 2) % 3] = other_side ? aside : away - aside;
          points.push_back(make_point(0, w[0], w[1], w[2]).b);
        };
        for (uint32_t k = 0; k < lines; ++k) {
          add(k, k % 2 != 0);
          add(k, k % 2 == 0);
        }
        expect_equal(s, strand_in_face(s, points, false), rng);
        EXPECT_EQ(brute_force(s, strand_in_face(s, points, false)).empty(), lean == 0);
      }
    }
  }
}

TEST(Crossings, EqualBruteForceAcrossManyFaces) {
  Rng rng(23);
  for (const Mesh& mesh :
       {sphere(2), torus(15, 8), cube(), bumpy_grid(8), with_noise(sphere(2), 0.3, 6)}) {
    const Surface s = make_surface(mesh);
    for (int round = 0; round < 6; ++round) {
      Curve c;
      add_walk(s, c, random_point(s, rng), 0.06, 60, 1.5, rng);
      add_ring(s, c, random_point(s, rng), 0.1, 12, 0.3, rng);
      add_walk(s, c, random_point(s, rng), 0.2, 10, 1.5, rng);
      expect_equal(s, c, rng);
    }
  }
}

/// Enough segments for several blocks of them, and for several groups of faces.
TEST(Crossings, EqualBruteForceOnALongCurve) {
  Rng rng(24);
  for (const Mesh& mesh : {sphere(4), flat_grid(6), cube()}) {
    const Surface s = make_surface(mesh);
    Curve c;
    add_walk(s, c, random_point(s, rng), 0.008, 7000, 0.5, rng);
    add_ring(s, c, random_point(s, rng), 0.15, 4000, 0.002, rng);
    expect_equal(s, c, rng);
  }
}

/// Moves a share of the nodes a little, and joins them again. Returns the segments that end in one of them.
std::vector<uint32_t> nudge(const Surface& s, Curve& c, double share, double step, Rng& rng) {
  const Curve old = c;
  std::vector<Path> traces(c.size());
  std::vector<uint8_t> moved(c.size());
  for (uint32_t i = 0; i < c.size(); ++i) {
    moved[i] = rng.in(0, 1) < share;
    if (moved[i]) c.nodes[i] = trace_geodesic(s, old.nodes[i], step * rng.direction(), traces[i]).end;
  }
  std::vector<uint32_t> changed;
  PathShortener shortener(s);
  for (uint32_t i = 0; i < c.size(); ++i) {
    const uint32_t j = c.next(i);
    if (!moved[i] && (j == kNone || !moved[j])) continue;
    changed.push_back(i);  // also the last node of an open strand, as it has moved
    if (j == kNone) continue;
    c.shapes[i] = shortener.follow(c.nodes[i], c.nodes[j], old.paths[i], traces[i], traces[j], c.paths[i]);
  }
  return changed;
}

Pairs find_again(CrossingTest& test, const Surface& s, const Curve& c, const std::vector<uint32_t>& changed,
                 ThreadPool& pool) {
  constexpr size_t kBlock = 10;
  test.begin_some(ThreadPool::block_count(changed.size(), kBlock));
  pool.for_blocks(changed.size(), kBlock, [&](size_t block, size_t begin, size_t end) {
    test.collect_some(c, block, std::span(changed).subspan(begin, end - begin));
  });
  return test.find_again(s, c, pool);
}

Pairs find_all(CrossingTest& test, const Surface& s, const Curve& c, ThreadPool& pool) {
  test.begin(c);
  for (size_t block = 0; block * CrossingTest::kSegmentsPerBlock < c.size(); ++block) test.collect(c, block);
  return test.find_collected(s, c, pool);
}

/// Few segments that change, which are looked at by themselves; a fourth in every round, until more have been renewed
/// than are kept; and so many that all are sorted again. The same ones twice, others after them, and all over again on
/// another curve.
TEST(Crossings, EqualBruteForceWhereSomeHaveChanged) {
  Rng rng(26);
  CrossingTest kept;
  ThreadPool one(1), three(3);
  size_t found = 0, none = 0;
  for (const Mesh& mesh : {octahedron(), sphere(2), flat_grid(3), cube()}) {
    const Surface s = make_surface(mesh);
    for (const double share : {0.003, 0.03, 0.12, 0.3}) {
      Curve c;
      add_walk(s, c, random_point(s, rng), 0.02, 400, 0.3, rng);
      add_ring(s, c, random_point(s, rng), 0.2, 100, 0.02, rng);
      CrossingTest fresh;
      EXPECT_EQ(find_all(kept, s, c, three), brute_force(s, c));
      EXPECT_EQ(find_all(fresh, s, c, one), brute_force(s, c));
      for (int round = 0; round < 12; ++round) {
        const std::vector<uint32_t> changed = nudge(s, c, share, 0.03, rng);
        ASSERT_TRUE(whole(s, c));
        Table<uint8_t> marked(c.size(), 0);
        for (const uint32_t i : changed) marked[i] = 1;
        const Pairs expected = brute_force(s, c, &marked);
        ++(expected.empty() ? none : found);
        EXPECT_EQ(find_again(kept, s, c, changed, three), expected) << "share " << share << ", round " << round;
        EXPECT_EQ(find_again(fresh, s, c, changed, one), expected) << "share " << share << ", round " << round;
      }
    }
  }
  EXPECT_GT(found, 60u);
  EXPECT_GT(none, 5u);
}

TEST(Crossings, NeighboursMayMeetInTheirNodeOnly) {
  const Surface s = make_surface(octahedron());
  CrossingTest test;
  ThreadPool pool(1);
  const auto find = [&](const std::vector<Vec2>& points, bool closed = false) {
    return test.find(s, strand_in_face(s, points, closed), pool);
  };
  EXPECT_TRUE(find({{0.1, 0.1}, {0.3, 0.1}, {0.3, 0.4}}).empty());
  EXPECT_TRUE(find({{0.1, 0.1}, {0.3, 0.1}, {0.3, 0.4}}, true).empty());
  // Continuing straight is allowed, going straight back is not.
  EXPECT_TRUE(find({{0.125, 0.125}, {0.25, 0.25}, {0.375, 0.375}}).empty());
  EXPECT_EQ(find({{0.125, 0.125}, {0.375, 0.375}, {0.25, 0.25}}), (Pairs{{0, 1}}));
  // Going back one grain beside it is.
  EXPECT_TRUE(find({{0.125, 0.125}, {0.375, 0.375}, {0.25, 0.25 + kGrain}}).empty());
}

/// All pairs of pieces between the points of a lattice: crossing, touching, on one line together or apart, and without
/// length.
TEST(Crossings, TouchEqualsTheExactTestOnALattice) {
  constexpr uint32_t kPoints = 4;
  std::vector<Vec2> points;
  for (uint32_t k = 0; k < kPoints * kPoints; ++k) points.push_back({(k % kPoints) / 8.0, (k / kPoints) / 8.0});
  const auto whole_number = [](double x) { return static_cast<int64_t>(std::ldexp(x, 50)); };
  const auto exact = [&](const Piece& p) {
    return ExactPiece{whole_number(p.from.x), whole_number(p.from.y), whole_number(p.to.x), whole_number(p.to.y),
                      p.segment,              kNone,                  kNone};
  };
  uint32_t wrong = 0;
  for (const Vec2 a : points) {
    for (const Vec2 b : points) {
      for (const Vec2 c : points) {
        for (const Vec2 d : points) {
          const Piece p{0, 0, a, b}, q{0, 1, c, d};
          wrong += touch(p, q) != exact_touch(exact(p), exact(q));
        }
      }
    }
  }
  EXPECT_EQ(wrong, 0u);
}

/// Segments that run over many faces and come back, so that a segment crosses the next one far from their node.
TEST(Crossings, EqualBruteForceWhereLongSegmentsComeBack) {
  Rng rng(25);
  uint32_t neighbours = 0, ends = 0;
  for (const Mesh& mesh : {cube(), octahedron(), sphere(1), torus(9, 6)}) {
    const Surface s = make_surface(mesh);
    for (int round = 0; round < 60; ++round) {
      Curve c;
      SurfacePoint at = random_point(s, rng);
      add_node(c, at);
      for (uint32_t k = 0; k < 3; ++k) {
        const Trace trace = trace_geodesic(s, at, rng.in(0.3, 2) * rng.direction(), c.paths.back());
        add_node(c, at = trace.end);
      }
      // Every other one is closed by the way back, made short.
      const bool closed = round % 2 == 1;
      if (closed) {
        Path& back = c.paths.back();
        for (uint32_t i = c.size() - 1; i-- > 0;) {
          for (size_t k = c.paths[i].size(); k-- > 0;) back.push_back(reversed(c.paths[i][k]));
        }
        c.shapes.back() = PathShortener(s).shorten(c.nodes.back(), c.nodes.front(), back);
      }
      c.strands.push_back({0, c.size(), closed});
      c.link();
      expect_equal(s, c, rng);
      for (const auto& [a, b] : exact_crossings(s, c)) {
        neighbours += b == a + 1;
        ends += closed && a == 0 && b == 3;
      }
    }
  }
  EXPECT_GT(neighbours, 100u);
  EXPECT_GT(ends, 5u);
}

TEST(Crossings, TouchingCounts) {
  const Surface s = make_surface(octahedron());
  CrossingTest test;
  ThreadPool pool(1);
  // The last node on the first segment, and a grain away from it.
  for (const bool apart : {false, true}) {
    const Vec2 last{0.25, 0.125 + (apart ? kGrain : 0)};
    const Curve c = strand_in_face(s, {{0.125, 0.125}, {0.5, 0.125}, {0.5, 0.375}, last}, false);
    EXPECT_EQ(test.find(s, c, pool), apart ? Pairs{} : (Pairs{{0, 2}}));
  }
}

TEST(Crossings, OnlyGuidesMayCrossGuides) {
  const Surface s = make_surface(octahedron());
  CrossingTest test;
  ThreadPool pool(1);
  for (const bool first : {false, true}) {
    for (const bool second : {false, true}) {
      Curve c;
      for (const Vec2 p : {Vec2{0.125, 0.25}, Vec2{0.5, 0.25}, Vec2{0.25, 0.125}, Vec2{0.25, 0.5}}) add_node(c, {0, p});
      c.strands = {{0, 2, false, first}, {2, 2, false, second}};
      join_in_face(s, c);
      EXPECT_EQ(test.find(s, c, pool), first && second ? Pairs{} : (Pairs{{0, 2}}));
    }
  }
}

TEST(Crossings, SegmentsThroughTheSamePointOfAnEdgeTouch) {
  const Surface s = make_surface(flat_grid(1));
  // The edge between the two faces.
  HalfEdge e = 0;
  while (s.twin(e) == kNone) ++e;
  CrossingTest test;
  ThreadPool pool(1);
  for (const double gap : {0.0, kGrain}) {
    Curve c;
    for (const double t : {0.25, 0.75}) {
      const uint32_t first = c.size();
      const uint32_t f = face_of(e), g = face_of(s.twin(e));
      add_node(c, make_point(f, 0.2 + 0.1 * t, 0.3, 0.5 - 0.1 * t));
      add_node(c, make_point(g, 0.2 + 0.1 * t, 0.4, 0.4 - 0.1 * t));
      c.paths[first] = {crossing_of(s, e, 0.5 + (t > 0.5 ? gap : 0))};
      c.strands.push_back({first, 2, false});
    }
    c.link();
    EXPECT_EQ(test.find(s, c, pool), brute_force(s, c));
    if (gap == 0) {
      EXPECT_EQ(test.find(s, c, pool), (Pairs{{0, 2}}));
    }
  }
}

}  // namespace
}  // namespace meander::test::crossings_tests
