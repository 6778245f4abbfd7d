// SPDX-License-Identifier: GPL-3.0-or-later
//
// The orientation predicate and the grid of coordinates, against integers of 128 bits; clipped triangles, against
// random points.
#include <gtest/gtest.h>

#include "base/clipped_triangle.h"
#include "base/plane.h"
#include "mesh/surface_point.h"
#include "curves.h"

namespace meander::test::plane_tests {
namespace {

int64_t units(double x) { return std::llround(std::ldexp(x, 50)); }
double from_units(int64_t x) { return std::ldexp(static_cast<double>(x), -50); }
constexpr int64_t kOne = int64_t{1} << 50;

int exact(Vec2 a, Vec2 b, Vec2 c) {
  return exact_sign(units(a.x), units(a.y), units(b.x), units(b.y), units(c.x), units(c.y));
}

Vec2 random_snapped(Rng& rng) { return {snap(rng()), snap(rng())}; }

TEST(Orientation, EqualsIntegersOnRandomPoints) {
  Rng rng(1);
  for (int k = 0; k < 20000; ++k) {
    const Vec2 a = random_snapped(rng), b = random_snapped(rng), c = random_snapped(rng);
    ASSERT_EQ(orientation(a, b, c), exact(a, b, c));
  }
}

TEST(Orientation, EqualsIntegersOnNearlyCollinearPoints) {
  Rng rng(2);
  int differ_from_rounded = 0;
  for (int k = 0; k < 50000; ++k) {
    const Vec2 a = random_snapped(rng), b = random_snapped(rng);
    const double t = rng.in(-0.2, 1.2);
    // A point of the line, rounded, and moved by up to two grains.
    const auto beside = [&](double x) {
      return std::clamp(snap(x) + (static_cast<double>(rng.below(5)) - 2) * kGrain, 0.0, 1.0);
    };
    const Vec2 c{beside((1 - t) * a.x + t * b.x), beside((1 - t) * a.y + t * b.y)};
    const int sign = exact(a, b, c);
    ASSERT_EQ(orientation(a, b, c), sign);
    ASSERT_EQ(orientation(b, a, c), -sign);
    ASSERT_EQ(orientation(b, c, a), sign);
    const double rounded = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    differ_from_rounded += (rounded > 0 ? 1 : (rounded < 0 ? -1 : 0)) != sign;
  }
  // The test would prove nothing if plain arithmetic passed it too.
  EXPECT_GT(differ_from_rounded, 0);
}

TEST(Orientation, IsZeroExactlyOnLines) {
  Rng rng(3);
  for (int k = 0; k < 20000; ++k) {
    // Integer steps (dx, dy), so that all three points are exactly on one line; then one is moved
    // off it.
    const int64_t dx = static_cast<int64_t>(rng.below(size_t{1} << 30)) + 1;
    const int64_t dy = static_cast<int64_t>(rng.below(size_t{1} << 30)) + 1;
    const int64_t x = rng.below(size_t{1} << 31), y = rng.below(size_t{1} << 31);
    const int64_t m = rng.below(1u << 18), n = rng.below(1u << 18);
    const auto at = [&](int64_t steps, int64_t off) {
      return Vec2{from_units(x + steps * dx), from_units(y + steps * dy + off)};
    };
    ASSERT_EQ(orientation(at(0, 0), at(m, 0), at(n, 0)), 0);
    for (const int64_t off : {-1, 1}) {
      ASSERT_EQ(orientation(at(0, 0), at(m, 0), at(n, off)), exact(at(0, 0), at(m, 0), at(n, off)));
      ASSERT_EQ(orientation(at(0, 0), at(m, 0), at(n, off)), m == 0 ? 0 : static_cast<int>(off));
    }
  }
}

TEST(Grain, SnappedSharesSeenFromBothSidesAreExact) {
  Rng rng(4);
  for (int k = 0; k < 20000; ++k) {
    const double t = clear_of_ends(k % 4 == 0 ? rng() * 0x1p-28 : rng());
    ASSERT_GE(t, kClearance);
    ASSERT_LE(t, 1 - kClearance);
    ASSERT_EQ(units(1 - t), kOne - units(t));
    ASSERT_EQ(1 - (1 - t), t);
    ASSERT_EQ(snap(t), t);
    ASSERT_EQ(from_units(units(t)), t);
  }
}

TEST(Grain, SnappingTakesTheNearestMultiple) {
  Rng rng(6);
  for (int k = 0; k < 50000; ++k) {
    // Any numbers, some a few grains in size, and ties between two multiples.
    double t = rng.in(-2, 2) * (k % 3 == 0 ? 8 * kGrain : 1);
    if (k % 5 == 0) t = (std::floor(rng() * 0x1p50) + 0.5) * kGrain;
    ASSERT_EQ(snap(t), std::nearbyint(t * 0x1p50) * 0x1p-50) << t;
  }
  EXPECT_EQ(snap(0), 0);
  EXPECT_EQ(snap(1), 1);
}

TEST(Grain, PointsStayInsideTheirFaceWhateverTheWeights) {
  Rng rng(5);
  const Surface s = make_surface(octahedron());
  for (int k = 0; k < 20000; ++k) {
    const auto weight = [&] {
      switch (rng.below(4)) {
        case 0:
          return rng.in(-1, 2);
        case 1:
          return rng.in(-4, 4) * kClearance;
        case 2:
          return 0.0;
        default:
          return rng();
      }
    };
    const double w0 = weight(), w1 = weight(), w2 = weight();
    const SurfacePoint p = make_point(0, w0, w1, w2);
    ASSERT_TRUE(inside_face(s, p)) << w0 << " " << w1 << " " << w2;
    ASSERT_EQ(units(p.weight(0)) + units(p.b.x) + units(p.b.y), kOne);
  }
}

TEST(ComplexNumbers, ProductTurnsAndScales) {
  Rng rng(6);
  // Products of a few numbers below 1 round to within a few units of 2^-53.
  constexpr double kRounding = 1e-15;
  for (int k = 0; k < 1000; ++k) {
    const Vec2 a = rng.direction(), b = rng.direction(), v{rng.in(-1, 1), rng.in(-1, 1)};
    EXPECT_NEAR(norm(a * v), norm(v), kRounding);
    EXPECT_NEAR(norm((a * b) * v - a * (b * v)), 0, 4 * kRounding);
    EXPECT_NEAR(norm(conj(a) * (a * v) - v), 0, 4 * kRounding);
    EXPECT_NEAR(cross(a, Vec2{0, 1} * a), 1, kRounding);
  }
  EXPECT_EQ(norm(unit(Vec2{})), 0);
}

TEST(ClippedTriangle, IsWhatRandomPointsSay) {
  constexpr uint32_t kPoints = 4000;
  constexpr double kShare = 0.05, kRounding = 1e-12;
  Rng rng(12);
  for (int k = 0; k < 200; ++k) {
    std::array<Vec2, 3> triangle;
    for (Vec2& p : triangle) p = {rng.in(-1, 1), rng.in(-1, 1)};
    if (cross(triangle[1] - triangle[0], triangle[2] - triangle[0]) < 0) std::swap(triangle[1], triangle[2]);
    const Vec2 low{rng.in(-1, 0.5), rng.in(-1, 0.5)}, high{low.x + rng.in(0.1, 1), low.y + rng.in(0.1, 1)};
    const ClippedTriangle part = clip_triangle(triangle, low, high);
    uint32_t inside = 0;
    Vec2 sum{0, 0};
    for (uint32_t n = 0; n < kPoints; ++n) {
      const Vec2 p{rng.in(low.x, high.x), rng.in(low.y, high.y)};
      bool in = true;
      for (size_t c = 0; c < 3; ++c) in = in && cross(triangle[(c + 1) % 3] - triangle[c], p - triangle[c]) >= 0;
      if (!in) continue;
      ++inside;
      sum = sum + p;
    }
    const double whole = (high.x - low.x) * (high.y - low.y);
    EXPECT_NEAR(part.area, whole * inside / kPoints, kShare * whole);
    if (part.empty) {
      EXPECT_EQ(inside, 0u);
      EXPECT_EQ(part.area, 0);
      continue;
    }
    EXPECT_GE(part.middle.x, low.x);
    EXPECT_LE(part.middle.x, high.x);
    EXPECT_GE(part.middle.y, low.y);
    EXPECT_LE(part.middle.y, high.y);
    // The middle of a convex part is inside of it.
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_GE(cross(triangle[(c + 1) % 3] - triangle[c], part.middle - triangle[c]), -kRounding);
    }
    if (inside < kPoints / 10) continue;
    EXPECT_LT(norm(part.middle - (1.0 / inside) * sum), kShare);
  }
}

TEST(ClippedTriangle, IsAllInsideAndNothingOutside) {
  const std::array<Vec2, 3> triangle{Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}};
  const ClippedTriangle all = clip_triangle(triangle, {-1, -1}, {2, 2});
  EXPECT_DOUBLE_EQ(all.area, 0.5);
  EXPECT_DOUBLE_EQ(all.middle.x, 1.0 / 3);
  EXPECT_DOUBLE_EQ(all.middle.y, 1.0 / 3);
  EXPECT_TRUE(clip_triangle(triangle, {0.8, 0.8}, {2, 2}).empty);
  EXPECT_FALSE(clip_triangle(triangle, {1, -1}, {2, 2}).empty) << "a corner touches it";
}

}  // namespace
}  // namespace meander::test::plane_tests
