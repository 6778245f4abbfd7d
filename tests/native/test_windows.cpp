// SPDX-License-Identifier: GPL-3.0-or-later
//
// Balls by windows: against the definition in the plane, on surfaces that unroll into it, and among sheets.
#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "geodesic/windows.h"
#include "thin_surfaces.h"

namespace meander::test::windows_tests {
namespace {

struct Scattered {
  Surface surface;
  std::vector<SurfacePoint> nodes;
  PointsOfFaces points;

  Scattered(const Mesh& mesh, uint32_t count, uint64_t seed) : surface(make_surface(mesh)) {
    Rng rng(seed);
    for (uint32_t i = 0; i < count; ++i) nodes.push_back(random_point(surface, rng));
    ThreadPool pool(2);
    points.sort(surface, count, [&](uint32_t i) { return nodes[i]; }, pool);
  }
};

/// A direction of the plane of a face, where faces may lie in any direction in a plane of space.
Vec2 random_direction(Rng& rng) {
  const double angle = rng.in(0, 2 * kPi);
  return {std::cos(angle), std::sin(angle)};
}

/// A long quad as two faces whose corners begin at one or another: each of them is the far one in a turn.
Mesh thin_quad(uint32_t turn) {
  Mesh mesh;
  for (const auto& [x, y] : {std::pair(0.0, 0.0), {1.0, 0.0}, {1.0, 0.03}, {0.0, 0.03}}) mesh.add(x, y, 0);
  for (const auto& corners : {std::array{0u, 1u, 2u}, std::array{0u, 2u, 3u}}) {
    mesh.face(corners[turn % 3], corners[(turn + 1) % 3], corners[(turn + 2) % 3]);
  }
  return mesh;
}

/// On faces with hundreds of points, of which only a strip is looked at, thin ones among them, and on faces with few.
TEST(Windows, AreTheBallsOfThePlane) {
  constexpr double kRounding = 1e-9;
  size_t limited = 0, clamped = 0;
  for (const Mesh& mesh :
       {flat_grid(1), flat_grid(3), flat_grid(12), thin_quad(0), thin_quad(1), thin_quad(2)}) {
    Scattered s(mesh, 900, 20);
    WindowSearch search(s.surface, s.points);
    Rng rng(5);
    for (uint32_t i = 0; i < 900; ++i) {
      const Vec2 ahead = random_direction(rng);
      const Vec3 x = position(s.surface, s.nodes[i]), b = s.surface.to_space(s.nodes[i].face, ahead);
      const double most = rng.in(0.001, 0.1);
      double expected = most;
      uint32_t touched = kNone;
      for (uint32_t j = 0; j < 900; ++j) {
        const Vec3 d = position(s.surface, s.nodes[j]) - x;
        if (j == i || !(d.dot(b) > 0) || d.squaredNorm() >= 2 * expected * d.dot(b)) continue;
        expected = d.squaredNorm() / (2 * d.dot(b));
        touched = j;
      }
      const std::optional<double> radius = search.largest(s.nodes[i], i, ahead, most);
      ASSERT_TRUE(radius.has_value());
      EXPECT_NEAR(*radius, expected, kRounding);
      EXPECT_EQ(search.touched(), touched);
      ++(touched == kNone ? clamped : limited);
    }
  }
  EXPECT_GT(limited, 500u);
  EXPECT_GT(clamped, 200u);
}

/// A sheet that is folded has the balls that it has when it is flat, however sharp the fold.
TEST(Windows, DoNotDependOnHowASheetIsFolded) {
  constexpr double kRounding = 1e-6;  // positions are rounded where they lie
  constexpr uint32_t kCount = 600;
  Scattered flat_one(scaled(bent_sheet(10, 0), 10), kCount, 31);
  size_t across = 0;
  for (const double angle : {0.7, 1.6, 3.0}) {
    Scattered bent(scaled(bent_sheet(10, angle), 10), kCount, 31);
    WindowSearch of_flat(flat_one.surface, flat_one.points), of_bent(bent.surface, bent.points);
    Rng rng(6);
    for (uint32_t i = 0; i < kCount; ++i) {
      ASSERT_EQ(flat_one.nodes[i].face, bent.nodes[i].face);
      const Vec2 ahead = random_direction(rng);
      const double r = 1 / flat_one.surface.scale(), other = 1 / bent.surface.scale();
      const std::optional<double> expected = of_flat.largest(flat_one.nodes[i], i, ahead, 1.2 * r);
      const std::optional<double> radius = of_bent.largest(bent.nodes[i], i, ahead, 1.2 * other);
      ASSERT_TRUE(expected && radius);
      EXPECT_NEAR(*radius / other, *expected / r, kRounding);
      if (of_bent.touched() == kNone) continue;
      const uint32_t f = bent.nodes[i].face, g = bent.nodes[of_bent.touched()].face;
      across += bent.surface.face_normal(f).dot(bent.surface.face_normal(g)) < 0.9;
    }
  }
  EXPECT_GT(across, 25u) << "balls are meant to reach across the fold";
}

/// What lies on another sheet is never looked at, and where faces are fine the search gives up.
TEST(Windows, SeeNoOtherSheetAndGiveUpOnFineFaces) {
  Scattered both(two_sheets(4, 0, 0.01), 400, 41);
  WindowSearch search(both.surface, both.points);
  Rng rng(7);
  size_t limited = 0;
  for (uint32_t i = 0; i < 400; ++i) {
    ASSERT_TRUE(search.largest(both.nodes[i], i, random_direction(rng), 0.2));
    if (search.touched() == kNone) continue;
    ++limited;
    EXPECT_EQ(both.surface.component(both.nodes[search.touched()].face), both.surface.component(both.nodes[i].face));
  }
  EXPECT_GT(limited, 100u);
  const Scattered fine(flat_grid(60), 1, 42);
  WindowSearch of_fine(fine.surface, fine.points);
  const auto middle = static_cast<uint32_t>(fine.surface.face_count() / 2 + 60);
  EXPECT_FALSE(of_fine.largest(make_point(middle, 0.3, 0.3, 0.4), kNone, {1, 0}, 0.15));
}

}  // namespace
}  // namespace meander::test::windows_tests
