// SPDX-License-Identifier: GPL-3.0-or-later
//
// The largest balls that the hierarchy finds, one by one and for neighbours together, among all points and among some,
// against all points.
#include <gtest/gtest.h>

#include <functional>

#include "medial/empty_balls.h"
#include "medial/near_points.h"
#include "meshes.h"

namespace meander::test::curve_bvh_tests {
namespace {

using Sides = std::array<Vec3, 2>;
using Balls = std::array<double, 2>;

/// Squares and sums are rounded before they are compared, so of two points that limit a ball equally
/// either may be found.
constexpr double kRounding = 1e-14;

double brute_force(const std::vector<Vec3>& points, const Vec3& x, const Vec3& b, double most) {
  double radius = most;
  for (const Vec3& p : points) {
    const double ahead = (p - x).dot(b);
    if (ahead > 0) radius = std::min(radius, (p - x).squaredNorm() / (2 * ahead));
  }
  return radius;
}

Vec3 random_direction(Rng& rng) { return Vec3(rng.in(-1, 1), rng.in(-1, 1), rng.in(-1, 1)).normalized(); }

/// Points of a curve that winds at random: some consecutive, some not.
std::vector<Vec3> winding(size_t count, double step, Rng& rng) {
  std::vector<Vec3> points;
  Vec3 at(0, 0, 0), direction = random_direction(rng);
  for (size_t i = 0; i < count; ++i) {
    if (i % 37 == 0) at = Vec3(rng.in(-0.5, 0.5), rng.in(-0.5, 0.5), rng.in(-0.1, 0.1));
    direction = (direction + 0.3 * random_direction(rng)).normalized();
    at = (at + step * direction).cwiseMax(-1).cwiseMin(1);
    points.push_back(at);
  }
  return points;
}

TEST(CurveBvh, BallsOfNeighboursEqualBruteForce) {
  Rng rng(7);
  ThreadPool pool(2);
  size_t limited = 0, clamped = 0;
  for (const size_t count : {1, 2, 7, 8, 9, 64, 500, 3001}) {
    const std::vector<Vec3> points = winding(count, 0.01, rng);
    const CurveBvh tree(points, pool);
    std::vector<Sides> b(count);
    for (Sides& sides : b) {
      const Vec3 along = random_direction(rng);
      sides = {along, rng.in(0, 1) < 0.5 ? Vec3(-along) : random_direction(rng)};
    }
    // The last of these meets hundreds of runs, more than are kept for neighbours.
    for (const double most : {0.004, 0.03, 0.2, 4.0}) {
      std::vector<Balls> start(count);
      for (Balls& balls : start) {
        for (double& r : balls) r = rng.in(0, 1) < 0.1 ? 0 : rng.in(0.2, 1) * most;
      }
      std::vector<Balls> together = start, parts = start;
      std::vector<std::array<uint32_t, 2>> touching(count, {0, 0});
      largest_balls(tree, {0, count, b, together, touching}, SeeAll{});
      for (size_t first = 0; first < count; first += 13) {
        largest_balls(tree, {first, std::min(count, first + 13), b, parts}, SeeAll{});
      }
      EXPECT_EQ(parts, together);
      for (size_t i = 0; i < count; ++i) {
        for (size_t side = 0; side < 2; ++side) {
          const double expected = start[i][side] > 0 ? brute_force(points, points[i], b[i][side], start[i][side]) : 0;
          ASSERT_NEAR(together[i][side], expected, kRounding * expected) << count << " points, ball " << i;
          if (start[i][side] == 0) continue;
          const BallStart from{points[i], b[i][side]};
          const double alone = largest_ball(tree, from, start[i][side], CountAll{}).radius;
          EXPECT_NEAR(alone, expected, kRounding * expected);
          const BallLimit first = largest_ball(tree, from, start[i][side], CountAllInOrder{});
          EXPECT_NEAR(first.radius, expected, kRounding * expected);
          EXPECT_EQ(first.touched == UINT32_MAX, expected == start[i][side]);
          const uint32_t limit = touching[i][side];
          ASSERT_EQ(limit == UINT32_MAX, expected == start[i][side]);
          if (limit != UINT32_MAX) {
            const Vec3 d = points[limit] - points[i];
            EXPECT_NEAR(d.squaredNorm() / (2 * d.dot(b[i][side])), expected, kRounding * expected);
          }
          ++(expected < start[i][side] ? limited : clamped);
        }
      }
    }
  }
  EXPECT_GT(limited, 1000u);
  EXPECT_GT(clamped, 1000u);
}

/// Points at even distances, where many limit a ball equally.
TEST(CurveBvh, BallsOfAGridEqualBruteForce) {
  ThreadPool pool(1);
  std::vector<Vec3> points;
  for (int row = 0; row < 12; ++row) {
    for (int k = 0; k < 40; ++k) points.emplace_back(0.0125 * (row % 2 ? 39 - k : k), 0.05 * row, 0);
  }
  const CurveBvh tree(points, pool);
  const std::vector<Sides> b(points.size(), Sides{Vec3(0, 1, 0), Vec3(0, -1, 0)});
  std::vector<Balls> radii(points.size(), Balls{0.1, 0.1});
  largest_balls(tree, {0, points.size(), b, radii}, SeeAll{});
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t side = 0; side < 2; ++side) {
      const double expected = brute_force(points, points[i], b[i][side], 0.1);
      EXPECT_NEAR(radii[i][side], expected, kRounding * expected);
    }
  }
}

TEST(CurveBvh, DistanceEqualsBruteForce) {
  Rng rng(9);
  ThreadPool pool(2);
  size_t near = 0, far = 0;
  for (const size_t count : {0, 1, 7, 9, 64, 3001}) {
    const std::vector<Vec3> points = winding(count, 0.01, rng);
    const CurveBvh tree(points, pool);
    for (int k = 0; k < 500; ++k) {
      const Vec3 from(rng.in(-1, 1), rng.in(-1, 1), rng.in(-1, 1));
      const double most = rng.in(0, 1) < 0.2 ? 4 : rng.in(0, 0.5);
      double expected = most;
      for (const Vec3& p : points) expected = std::min(expected, (p - from).norm());
      EXPECT_NEAR(nearest_distance(tree, from, most), expected, 10 * kRounding);
      if (count > 0) {
        const auto squared = [&](const Vec3& p) { return (p - from).squaredNorm(); };
        const uint32_t found = nearest_point(tree, from, rng.below(static_cast<uint32_t>(count)));
        EXPECT_EQ(squared(points[found]), squared(*std::ranges::min_element(points, {}, squared)));
      }
      ++(expected < most ? near : far);
    }
    if (count > 0) {
      EXPECT_EQ(nearest_distance(tree, points[count / 2], 1), 0);
      EXPECT_EQ(nearest_point(tree, points[count / 2], 0), count / 2);
    }
  }
  EXPECT_GT(near, 500u);
  EXPECT_GT(far, 500u);
}

/// The ball of one point among those that count: of several that limit it alike, the first does.
template <class Counts>
BallLimit brute_force_seen(const std::vector<Vec3>& points, const Vec3& x, const Vec3& b, double most,
                       const Counts& counts) {
  BallLimit limit{most};
  for (uint32_t j = 0; j < points.size(); ++j) {
    const double ahead = (points[j] - x).dot(b);
    if (!(ahead > 0) || !counts(j)) continue;
    const double radius = (points[j] - x).squaredNorm() / (2 * ahead);
    if (radius < limit.radius) limit = {radius, j};
  }
  return limit;
}

using Kinds = std::vector<uint32_t>;
using Share = std::function<RunShare(size_t first, size_t last, uint32_t run)>;

/// What points of a kind see of each run, by a function of the kind and of a point.
template <class Sees>
auto lanes_seen(const Kinds& kind, const Sees& sees) {
  return [&kind, sees](uint32_t of, uint32_t run) {
    uint32_t lanes = 0;
    for (uint32_t lane = 0; lane < CurveBvh::kRun; ++lane) {
      const uint32_t j = run * CurveBvh::kRun + lane;
      if (j < kind.size() && sees(of, j)) lanes |= 1u << lane;
    }
    return lanes;
  };
}

template <class Sees>
Share share_seen(const Kinds& kind, const Sees& sees) {
  return [&kind, sees](size_t first, size_t last, uint32_t run) {
    const size_t begin = size_t{run} * CurveBvh::kRun, end = std::min(begin + CurveBvh::kRun, kind.size());
    size_t seen = 0;
    for (size_t i = first; i < last; ++i) {
      for (size_t j = begin; j < end; ++j) seen += sees(kind[i], static_cast<uint32_t>(j));
    }
    const size_t all = (last - first) * (end - begin);
    if (seen == 0) return RunShare::kNothing;
    return seen == all ? RunShare::kAll : RunShare::kMaybe;
  };
}

/// `share`  if not null, in place of what is known of runs as wholes
template <class Sees>
auto sight_of(const Kinds& kind, const Sees& sees, const Share& share = nullptr) {
  return SeeByKind{[&kind](size_t i) { return kind[i]; }, lanes_seen(kind, sees),
                   share ? share : share_seen(kind, sees)};
}

TEST(CurveBvh, BallsAmongWhatIsSeenEqualBruteForce) {
  Rng rng(9);
  ThreadPool pool(2);
  size_t limited = 0, clamped = 0, passed_over = 0, unseen = 0, all_seen = 0;
  for (const size_t count : {1, 2, 7, 8, 9, 64, 500, 1501}) {
    const std::vector<Vec3> points = winding(count, 0.01, rng);
    const CurveBvh tree(points, pool);
    // A point sees those of some kinds only, at random; runs of kinds are as long as those of strands in a patch.
    std::vector<uint32_t> kind(count);
    for (size_t i = 0; i < count; ++i) kind[i] = i % 5 == 0 || i == 0 ? rng.below(6) : kind[i - 1];
    std::array<std::array<bool, 6>, 6> visible{};
    for (auto& row : visible) {
      for (bool& each : row) each = rng.in(0, 1) < 0.6;
    }
    const auto sees = [&](size_t i, uint32_t j) { return visible[kind[i]][kind[j]]; };
    const auto of_kind = [&](uint32_t of, uint32_t j) { return visible[of][kind[j]]; };
    const auto sight = sight_of(kind, of_kind);
    std::vector<Sides> b(count);
    for (Sides& sides : b) sides = {random_direction(rng), random_direction(rng)};
    // The last of these meets more runs than are kept for neighbours.
    for (const double most : {0.004, 0.03, 0.2, 4.0}) {
      std::vector<Balls> start(count);
      for (Balls& balls : start) {
        for (double& r : balls) r = rng.in(0, 1) < 0.1 ? 0 : rng.in(0.2, 1) * most;
      }
      std::vector<Balls> together = start, parts = start;
      std::vector<std::array<uint32_t, 2>> touched(count, {UINT32_MAX, UINT32_MAX}), touched_in_parts = touched;
      largest_balls(tree, {0, count, b, together, touched}, sight);
      for (size_t first = 0; first < count; first += 13) {
        largest_balls(tree, {first, std::min(count, first + 13), b, parts, std::span(touched_in_parts).subspan(first)},
                      sight);
      }
      EXPECT_EQ(parts, together);
      EXPECT_EQ(touched_in_parts, touched);
      // What knows of no run as a whole only costs time.
      const auto hopeful = sight_of(kind, of_kind, [&](size_t of, size_t end, uint32_t run) {
        unseen += sight.share(of, end, run) == RunShare::kNothing;
        all_seen += sight.share(of, end, run) == RunShare::kAll;
        return RunShare::kMaybe;
      });
      std::vector<Balls> again = start;
      std::vector<std::array<uint32_t, 2>> touched_again(count, {UINT32_MAX, UINT32_MAX});
      largest_balls(tree, {0, count, b, again, touched_again}, hopeful);
      EXPECT_EQ(again, together);
      EXPECT_EQ(touched_again, touched);
      for (size_t i = 0; i < count; ++i) {
        for (size_t side = 0; side < 2; ++side) {
          if (start[i][side] == 0) {
            EXPECT_EQ(together[i][side], 0);
            EXPECT_EQ(touched[i][side], UINT32_MAX);
            continue;
          }
          const auto counts = [&](uint32_t j) { return sees(i, j); };
          const BallLimit expected = brute_force_seen(points, points[i], b[i][side], start[i][side], counts);
          ASSERT_NEAR(together[i][side], expected.radius, kRounding * expected.radius)
              << count << " points, ball " << i;
          ASSERT_EQ(touched[i][side], expected.touched) << count << " points, ball " << i;
          const BallLimit alone = largest_ball(tree, {points[i], b[i][side]}, start[i][side], count_where(counts));
          EXPECT_EQ(alone.radius, together[i][side]);
          EXPECT_EQ(alone.touched, expected.touched);
          ++(expected.touched == UINT32_MAX ? clamped : limited);
          passed_over += brute_force(points, points[i], b[i][side], start[i][side]) < expected.radius;
        }
      }
    }
  }
  EXPECT_GT(limited, 1000u);
  EXPECT_GT(clamped, 1000u);
  EXPECT_GT(passed_over, 1000u) << "the filter is meant to matter";
  EXPECT_GT(unseen, 100u) << "whole runs are meant to be passed over";
  EXPECT_GT(all_seen, 100u) << "whole runs are meant to be seen without being asked for";
}

/// Where all count, or none.
TEST(CurveBvh, BallsAmongAllAndAmongNone) {
  Rng rng(10);
  ThreadPool pool(1);
  const std::vector<Vec3> points = winding(700, 0.01, rng);
  const CurveBvh tree(points, pool);
  for (int k = 0; k < 200; ++k) {
    const Vec3& x = points[rng.below(points.size())];
    const Vec3 b = random_direction(rng);
    const BallLimit all = largest_ball(tree, {x, b}, 0.5, count_where([](uint32_t) { return true; }));
    const BallLimit unasked = largest_ball(tree, {x, b}, 0.5, CountAllInOrder{});
    EXPECT_NEAR(all.radius, unasked.radius, kRounding);
    EXPECT_EQ(all.touched, unasked.touched);
    const BallLimit none = largest_ball(tree, {x, b}, 0.5, count_where([](uint32_t) { return false; }));
    EXPECT_EQ(none.radius, 0.5);
    EXPECT_EQ(none.touched, UINT32_MAX);
  }
}

/// What belongs to other parts costs nothing: nobody is asked about a run that holds none of one's own.
TEST(CurveBvh, PartsFindWhatTheyWouldAlone) {
  Rng rng(12);
  ThreadPool pool(2);
  size_t limited = 0, passed_over = 0, asked = 0;
  for (const size_t count : {1, 9, 64, 1501}) {
    const std::vector<Vec3> points = winding(count, 0.01, rng);
    // Some parts begin within runs, some come back, and some have no points.
    std::vector<uint32_t> part(count);
    for (size_t i = 0; i < count; ++i) part[i] = i > 0 && rng.below(40) > 0 ? part[i - 1] : 2 * rng.below(20);
    CurveBvh tree;
    tree.build(points, pool, part);
    const auto holds = [&](uint32_t run, uint32_t of) {
      const size_t begin = size_t{run} * CurveBvh::kRun, end = std::min(begin + CurveBvh::kRun, count);
      return std::find(part.begin() + begin, part.begin() + end, of) != part.begin() + end;
    };
    const auto of_part = [&](uint32_t of, uint32_t j) { return part[j] == of; };
    const Share share = share_seen(part, of_part);
    const auto sight = sight_of(part, of_part, [&](size_t first, size_t last, uint32_t run) {
      ++asked;
      bool own = false;
      for (size_t i = first; i < last; ++i) own = own || holds(run, part[i]);
      EXPECT_TRUE(own);
      return share(first, last, run);
    });
    std::vector<Sides> b(count);
    for (Sides& sides : b) sides = {random_direction(rng), random_direction(rng)};
    for (const double most : {0.03, 0.2, 4.0}) {
      std::vector<Balls> radii(count, Balls{most, most});
      std::vector<std::array<uint32_t, 2>> touched(count);
      largest_balls(tree, {0, count, b, radii, touched}, sight);
      for (uint32_t i = 0; i < count; ++i) {
        const auto own = [&](uint32_t j) { return part[j] == part[i]; };
        for (size_t side = 0; side < 2; ++side) {
          const BallLimit expected = brute_force_seen(points, points[i], b[i][side], most, own);
          ASSERT_NEAR(radii[i][side], expected.radius, kRounding * expected.radius);
          ASSERT_EQ(touched[i][side], expected.touched);
          const BallStart from{points[i], b[i][side]};
          const BallLimit by_lanes = largest_ball(tree, from, most, sight.alone(part[i]), part[i]);
          EXPECT_EQ(by_lanes.radius, radii[i][side]);
          EXPECT_EQ(by_lanes.touched, expected.touched);
          const auto counts = [&](uint32_t j) {
            EXPECT_TRUE(holds(j / CurveBvh::kRun, part[i]));
            return own(j);
          };
          EXPECT_EQ(largest_ball(tree, from, most, count_where(counts), part[i]).radius, radii[i][side]);
          limited += expected.touched != UINT32_MAX;
          passed_over += brute_force(points, points[i], b[i][side], most) < expected.radius;
        }
      }
    }
    std::vector<uint32_t> inside;
    for (uint32_t of = 0; of < 45; ++of) {
      const Vec3 from(rng.in(-0.5, 0.5), rng.in(-0.5, 0.5), 0);
      double own = 4, run = 4;  // of its points, and of all that share a run with one
      for (uint32_t j = 0; j < count; ++j) {
        const double apart = (points[j] - from).norm();
        if (part[j] == of) own = std::min(own, apart);
        if (holds(j / CurveBvh::kRun, of)) run = std::min(run, apart);
      }
      EXPECT_LE(nearest_distance(tree, from, 4, of), own * (1 + kRounding));
      EXPECT_GE(nearest_distance(tree, from, 4, of), run * (1 - kRounding));
      find_inside(tree, from, 0.3, inside, of);
      for (uint32_t j = 0; j < count; ++j) {
        const bool found = std::ranges::find(inside, j) != inside.end(), near = (points[j] - from).norm() < 0.3;
        EXPECT_EQ(found, near && holds(j / CurveBvh::kRun, of));
      }
    }
  }
  EXPECT_GT(limited, 1000u);
  EXPECT_GT(passed_over, 500u) << "parts are meant to lie through each other";
  EXPECT_GT(asked, 100u);
}

/// Of several that limit a ball equally it is the first, whichever the walk meets first.
TEST(CurveBvh, TheFirstOfEqualsIsTouched) {
  ThreadPool pool(1);
  std::vector<Vec3> points;
  for (int row = 0; row < 8; ++row) {
    for (int k = 0; k < 32; ++k) points.emplace_back(0.125 * (row % 2 ? 31 - k : k), 0.25 * row, 0);
  }
  // Distances and their squares are exact in binary. Half of the points a second time, in an order that no walk has.
  points.insert(points.end(), points.begin(), points.begin() + 128);
  Rng rng(11);
  for (size_t k = points.size() - 1; k > 0; --k) std::swap(points[k], points[rng.below(k + 1)]);
  const CurveBvh tree(points, pool);
  const std::vector<Sides> b(points.size(), Sides{Vec3(0, 1, 0), Vec3(0, -1, 0)});
  std::vector<Balls> radii(points.size(), Balls{1, 1});
  std::vector<std::array<uint32_t, 2>> touched(points.size());
  const std::vector<uint32_t> kind(points.size(), 0);
  const auto sees = [&](size_t, uint32_t j) { return j % 3 != 0; };
  largest_balls(tree, {0, points.size(), b, radii, touched}, sight_of(kind, sees));
  for (uint32_t i = 0; i < points.size(); ++i) {
    for (size_t side = 0; side < 2; ++side) {
      const BallLimit expected =
          brute_force_seen(points, points[i], b[i][side], 1, [&](uint32_t j) { return sees(i, j); });
      EXPECT_EQ(radii[i][side], expected.radius);
      EXPECT_EQ(touched[i][side], expected.touched);
      // Of all points, for this one alone; a ball that is as large as it may be is limited by none.
      for (const double most : {1.0, 0.125}) {
        const BallLimit of_all = brute_force_seen(points, points[i], b[i][side], most, [](uint32_t) { return true; });
        const BallLimit alone = largest_ball(tree, {points[i], b[i][side]}, most, CountAllInOrder{});
        EXPECT_EQ(alone.radius, of_all.radius);
        EXPECT_EQ(alone.touched, of_all.touched);
      }
    }
  }
}

/// The same where the ball is far larger than the distance to what limits it, so that little is left of its square and
/// of its share ahead once they are subtracted.
TEST(CurveBvh, TheFirstOfEqualsCloseByIsTouched) {
  ThreadPool pool(1);
  Rng rng(13);
  constexpr double kRadius = 0.5;
  size_t limited = 0;
  for (int repeat = 0; repeat < 200; ++repeat) {
    const Vec3 x(rng.in(-0.5, 0.5), rng.in(-0.5, 0.5), rng.in(-0.5, 0.5)), b = random_direction(rng);
    const Vec3 along = b.unitOrthogonal(), across = b.cross(along);
    // On balls of half the radius to all of it, each point twice, and x itself.
    std::vector<Vec3> points{x};
    for (int k = 0; k < 32; ++k) {
      const double turned = rng.in(0, 2 * kPi), distance = rng.in(0.002, 0.02);
      const double ahead = distance * distance / (2 * kRadius * rng.in(0.5, 1));
      const double beside = std::sqrt(distance * distance - ahead * ahead);
      points.push_back(x + ahead * b + beside * (std::cos(turned) * along + std::sin(turned) * across));
      points.push_back(points.back());
    }
    for (size_t k = points.size() - 1; k > 1; --k) std::swap(points[k], points[1 + rng.below(k)]);
    const CurveBvh tree(points, pool);
    const auto all = [](size_t, uint32_t) { return true; };
    const std::vector<uint32_t> kind(points.size(), 0);
    const std::vector<Sides> sides(points.size(), Sides{b, -b});
    std::vector<Balls> radii(points.size(), Balls{kRadius, kRadius});
    std::vector<std::array<uint32_t, 2>> touched(points.size());
    largest_balls(tree, {0, points.size(), sides, radii, touched}, sight_of(kind, all));
    for (uint32_t i = 0; i < points.size(); ++i) {
      for (size_t side = 0; side < 2; ++side) {
        const BallLimit expected =
            brute_force_seen(points, points[i], sides[i][side], kRadius, [](uint32_t) { return true; });
        EXPECT_EQ(radii[i][side], expected.radius) << "from point " << i;
        EXPECT_EQ(touched[i][side], expected.touched) << "from point " << i;
        limited += expected.touched != UINT32_MAX;
      }
    }
  }
  EXPECT_GT(limited, 1000u);
}

TEST(CurveBvh, InsideEqualsBruteForce) {
  Rng rng(8);
  ThreadPool pool(1);
  const std::vector<Vec3> points = winding(900, 0.01, rng);
  const CurveBvh tree(points, pool);
  std::vector<uint32_t> found;
  for (int k = 0; k < 100; ++k) {
    const Vec3 centre(rng.in(-1, 1), rng.in(-1, 1), rng.in(-1, 1));
    const double radius = rng.in(0, 1);
    std::vector<uint32_t> expected;
    for (uint32_t i = 0; i < points.size(); ++i) {
      if ((points[i] - centre).squaredNorm() < radius * radius) expected.push_back(i);
    }
    find_inside(tree, centre, radius, found);
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace meander::test::curve_bvh_tests
