// SPDX-License-Identifier: GPL-3.0-or-later
//
// Hairpins: found where a strand is known to turn back, and the short runs between them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "curve/hairpins.h"
#include "curves.h"

namespace meander::test::hairpins_tests {
namespace {

constexpr double kRadius = 0.01;  // r; the face below is about 0.7 wide

/// A strand through points in units of r from the middle of the only face.
Curve strand_through(const Surface& s, const std::vector<Vec2>& points, bool closed, double radius = kRadius) {
  Curve curve;
  const uint32_t face = 0;
  // All of one large face: coordinates relative to its middle.
  const Vec2 middle = flat(s, SurfacePoint{face, {1.0 / 3, 1.0 / 3}});
  for (const Vec2& p : points) add_node(curve, point_at(s, face, middle + radius * p));
  curve.strands.push_back({0, static_cast<uint32_t>(points.size()), closed});
  curve.link();
  join_in_face(s, curve);
  return curve;
}

std::vector<Vec2> line(Vec2 from, Vec2 to) {
  std::vector<Vec2> points;
  const double length = norm(to - from);
  for (double t = 0; t < length - 1e-9; t += 0.25) points.push_back(from + (t / length) * (to - from));
  return points;
}

/// Half a circle of radius 1 about `centre`, counter-clockwise (side 1) or clockwise (-1) from `angle`.
std::vector<Vec2> half_turn(Vec2 centre, double angle, int side) {
  std::vector<Vec2> points;
  for (int k = 0; k < 12; ++k) {
    const double a = angle + side * std::numbers::pi * k / 12;
    points.push_back(centre + Vec2{std::cos(a), std::sin(a)});
  }
  return points;
}

void append(std::vector<Vec2>& to, const std::vector<Vec2>& from) { to.insert(to.end(), from.begin(), from.end()); }

/// Rows 2 r apart of these lengths, joined by half turns: right, left, right... from (0, 0).
std::vector<Vec2> serpentine(const std::vector<double>& rows) {
  std::vector<Vec2> points;
  Vec2 at{0, 0};
  double direction = 1;
  for (size_t k = 0; k < rows.size(); ++k) {
    const Vec2 end = at + Vec2{direction * rows[k], 0};
    append(points, line(at, end));
    if (k + 1 == rows.size()) {
      points.push_back(end);
      break;
    }
    append(points, half_turn(end + Vec2{0, 1}, -std::numbers::pi / 2, direction > 0 ? 1 : -1));
    at = end + Vec2{0, 2};
    direction = -direction;
  }
  return points;
}

std::vector<Hairpin> hairpins_of(const Curve& curve, double radius = kRadius, unsigned threads = 2) {
  ThreadPool pool(threads);
  return find_hairpins(curve, curve.strands[0], even_metric(curve, radius), pool);
}

NodeData<uint8_t> marked_of(const Curve& curve, double share, double radius = kRadius) {
  ThreadPool pool(2);
  return mark_short_runs(curve, even_metric(curve, radius), share, pool);
}

Surface one_face() { return make_surface(Mesh{{-1, -1, 0, 1, -1, 0, 0, 1, 0}, {0, 1, 2}}); }

TEST(Hairpins, OneForEveryTurnOfASerpentine) {
  const Surface s = one_face();
  const Curve curve = strand_through(s, serpentine({10, 8, 6, 8}), false);
  const auto hairpins = hairpins_of(curve);
  ASSERT_EQ(hairpins.size(), 3u);
  const double pi = std::numbers::pi;
  const double middle[3] = {10 + pi / 2, 10 + pi + 8 + pi / 2, 10 + pi + 8 + pi + 6 + pi / 2};
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(hairpins[k].side, k % 2 == 0 ? 1 : -1);
    EXPECT_NEAR(hairpins[k].at, middle[k], 0.5);
  }
}

TEST(Hairpins, OfALongStrandAreFoundByAllThreads) {
  const Surface s = one_face();
  constexpr double kSmall = 0.002;
  constexpr size_t kRows = 40;
  constexpr double kLength = 30;
  const Curve curve = strand_through(s, serpentine(std::vector<double>(kRows, kLength)), false, kSmall);
  ASSERT_GT(curve.size(), 5000u) << "several blocks";
  for (const unsigned threads : {1u, 3u}) {
    const auto hairpins = hairpins_of(curve, kSmall, threads);
    ASSERT_EQ(hairpins.size(), kRows - 1);
    for (size_t k = 0; k + 1 < kRows; ++k) {
      EXPECT_EQ(hairpins[k].side, k % 2 == 0 ? 1 : -1);
      const double turns = std::numbers::pi * (static_cast<double>(k) + 0.5);
      EXPECT_NEAR(hairpins[k].at, kLength * static_cast<double>(k + 1) + turns, 0.5);
    }
  }
}

TEST(Hairpins, NoneOnAWideArcOrARightAngle) {
  const Surface s = one_face();
  std::vector<Vec2> points;
  for (int k = 0; k <= 60; ++k) {
    const double a = std::numbers::pi * k / 60;
    points.push_back(5.0 * Vec2{std::cos(a), std::sin(a)});
  }
  append(points, line({-5, -0.25}, {-5, -8}));
  append(points, line({-5, -8}, {3, -8}));
  const Curve curve = strand_through(s, points, false);
  EXPECT_TRUE(hairpins_of(curve).empty());
}

TEST(Hairpins, OfAClosedStrandDoNotDependOnItsFirstNode) {
  const Surface s = one_face();
  // A long loop: two turns to the left, far apart.
  std::vector<Vec2> points;
  append(points, line({0, 0}, {12, 0}));
  append(points, half_turn({12, 1}, -std::numbers::pi / 2, 1));
  append(points, line({12, 2}, {0, 2}));
  append(points, half_turn({0, 1}, std::numbers::pi / 2, 1));
  for (const size_t shift : {size_t{0}, size_t{7}, size_t{50}, points.size() - 6, points.size() - 1}) {
    std::vector<Vec2> turned(points);
    std::rotate(turned.begin(), turned.begin() + static_cast<long>(shift), turned.end());
    const Curve curve = strand_through(s, turned, true);
    const auto hairpins = hairpins_of(curve);
    ASSERT_EQ(hairpins.size(), 2u) << "shift " << shift;
    EXPECT_EQ(hairpins[0].side, 1);
    EXPECT_EQ(hairpins[1].side, 1);
    EXPECT_NEAR(hairpins[1].at - hairpins[0].at, 12 + std::numbers::pi, 0.5);
    // Both turn in the same direction: there is nothing between them to draw in.
    for (const uint8_t m : marked_of(curve, 1)) EXPECT_EQ(m, 0);
  }
}

TEST(Hairpins, TheShortestRunIsMarkedWithItsTurns) {
  const Surface s = one_face();
  const Curve curve = strand_through(s, serpentine({10, 9, 5, 9, 8}), false);
  const auto hairpins = hairpins_of(curve);
  ASSERT_EQ(hairpins.size(), 4u);
  const auto marked = marked_of(curve, 0.34);  // one of three
  double arc_length = 0;
  for (uint32_t i = 0; i < curve.size(); ++i) {
    const bool in = arc_length > hairpins[1].at - 1.99 && arc_length < hairpins[2].at + 1.99;
    const bool out = arc_length < hairpins[1].at - 2.01 || arc_length > hairpins[2].at + 2.01;
    if (in) { EXPECT_EQ(marked[i], 1) << "at " << arc_length; }
    if (out) { EXPECT_EQ(marked[i], 0) << "at " << arc_length; }
    if (curve.has_segment(i)) arc_length += curve.shapes[i].length / kRadius;
  }
}

}  // namespace
}  // namespace meander::test::hairpins_tests
