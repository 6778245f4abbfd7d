// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the lines of a field stay as far apart as they are, how wide a surface is across them, and where rows lie.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "api_flows.h"
#include "flow/flow.h"
#include "meshes.h"
#include "mesh/even_lines.h"
#include "seed/even_rows.h"
#include "test_seeds.h"

namespace meander::test::even_lines_tests {
namespace {

constexpr double kSlant = 0.7;  // of a cone: how much it narrows over its height of 2

/// A tube of radius 1 at its foot and height 2.
Surface tube(double narrower) {
  constexpr int kAround = 48, kRings = 12;
  std::vector<double> vertices;
  std::vector<uint32_t> faces;
  for (int j = 0; j <= kRings; ++j) {
    for (int i = 0; i < kAround; ++i) {
      const double a = 2 * kPi * i / kAround, r = 1 - narrower * j / kRings;
      vertices.insert(vertices.end(), {r * std::cos(a), r * std::sin(a), 2.0 * j / kRings});
      const auto at = [&](int row, int column) { return static_cast<uint32_t>(row * kAround + column % kAround); };
      if (j == kRings) continue;
      const uint32_t a0 = at(j, i), b0 = at(j, i + 1), b1 = at(j + 1, i + 1), a1 = at(j + 1, i);
      faces.insert(faces.end(), {a0, b0, b1, a0, b1, a1});
    }
  }
  return Surface(vertices, faces);
}

LineField along_axis(const Surface& s, const Vec3& axis, bool across = false) {
  return LineField(s, VertexData<Vec3>(std::vector<Vec3>(s.vertex_count(), axis)), across);
}

TEST(EvenLines, AreThoseOfSheetsAndPipesAndNotAlongCones) {
  const Surface sheet = make_surface(flat_grid(7)), pipe = tube(0), cone = tube(kSlant);
  EXPECT_FALSE(has_even_lines(sheet, LineField()));
  EXPECT_TRUE(has_even_lines(sheet, along_axis(sheet, {1, 0.3, 0})));
  EXPECT_TRUE(has_even_lines(pipe, along_axis(pipe, {0, 0, 1})));
  EXPECT_TRUE(has_even_lines(pipe, along_axis(pipe, {0, 0, 1}, true)));
  EXPECT_FALSE(has_even_lines(cone, along_axis(cone, {0, 0, 1})));
}

TEST(EvenLines, WidthsAreAcrossThem) {
  const Surface sheet = make_surface(flat_grid(7)), pipe = tube(0);
  const double side = std::sqrt(sheet.area());
  EXPECT_NEAR(heights_across(sheet, along_axis(sheet, {1, 0, 0})).width[0], side, 1e-6);
  EXPECT_NEAR(heights_across(sheet, along_axis(sheet, {1, 1, 0})).width[0], std::sqrt(2.0) * side, 1e-6);
  EXPECT_NEAR(heights_across(pipe, along_axis(pipe, {0, 0, 1}, true)).width[0] * pipe.scale(), 2, 1e-6);
  EXPECT_EQ(heights_across(pipe, along_axis(pipe, {0, 0, 1})).width[0], 0);  // it closes on itself
}

TEST(EvenLines, HeightsAreOneFunctionOfTheSurface) {
  const Surface pipe = tube(0);
  const HeightsAcross across = heights_across(pipe, along_axis(pipe, {0, 0, 1}, true));
  EXPECT_LT(across.gap[0], 1e-9);
  const auto z = [&](const SurfacePoint& p) { return position(pipe, p).z(); };
  const SurfacePoint first = make_point(0, 1, 0, 0);
  const double sign = across.at(pipe, make_point(1, 1, 1, 1)) > across.at(pipe, first) ? 1 : -1;
  for (uint32_t f = 0; f < pipe.face_count(); ++f) {
    const SurfacePoint p = make_point(f, 0.5, 0.3, 0.2);
    EXPECT_NEAR(sign * (across.at(pipe, p) - across.at(pipe, first)), z(p) - z(first), 1e-9);
  }
}

TEST(EvenRows, LieInTheMiddlesOfEqualPartsOfTheWidth) {
  const Surface pipe = tube(0);
  const double length = heights_across(pipe, along_axis(pipe, {0, 0, 1}, true)).width[0];
  constexpr double kRows = 8;
  // Room for 8.4 rows, and there are eight.
  const double spacing = length / (kRows + 0.4);
  const EvenRows rows(pipe, along_axis(pipe, {0, 0, 1}, true), 0.5 * spacing, 0.5, 1);
  EXPECT_NEAR(rows.spread().value_or(0), (kRows + 0.4) / kRows, 1e-9);
  EXPECT_TRUE(rows.go_round());
  double least = 1;
  for (uint32_t f = 0; f < pipe.face_count(); ++f) least = std::min(least, position(pipe, make_point(f, 1, 0, 0)).z());
  for (uint32_t f = 0; f < pipe.face_count(); ++f) {
    for (const SurfacePoint& p : {make_point(f, 1, 1, 1), make_point(f, 0.7, 0.2, 0.1)}) {
      const double row = (position(pipe, p).z() - least) / length * kRows - 0.5;
      const double off = row - std::round(row);
      const double wanted = -std::sin(2 * kPi * off) / (2 * kPi) * length / kRows;
      const Vec2 way = rows.towards_row(pipe, p);
      EXPECT_NEAR(pipe.to_space(f, way).z(), wanted, 1e-9);
      EXPECT_NEAR(norm(way), std::abs(wanted), 1e-9);
    }
  }
  // Rows along a pipe may lie anywhere round it.
  const EvenRows along(pipe, along_axis(pipe, {0, 0, 1}), 0.5 * spacing, 0.5, 1);
  EXPECT_EQ(norm(along.towards_row(pipe, make_point(3, 1, 1, 1))), 0);
  EXPECT_FALSE(along.spread());
  const Surface sheet = make_surface(flat_grid(7));
  EXPECT_FALSE(EvenRows(sheet, along_axis(sheet, {1, 1, 0}), 0.5 * spacing, 0.5, 1).go_round());
}

/// Strands along a field are to be nearer in the r that they follow, which changes once there is one.
TEST(EvenRows, OfAFlowAreThoseOfTheRadiusThatItHasAlongAField) {
  const auto pipe = std::make_shared<const Surface>(tube(0));
  meander_flow_options options = options_of(0.2);
  options.start = MEANDER_START_FULL;
  options.alignment_weight = 2;
  options.boundary_distance = 0.9;
  Flow flow(pipe, nullptr, {}, checked_settings(options, *pipe));
  flow.set_field(along_axis(*pipe, {0, 0, 1}, true));
  const auto [has, anew] = flow.ask([](const Flow::Present& present) {
    const Domain& d = present.state.domain;
    const EvenRows rows(*d.surface, d.directions, d.wanted_radius.most(), 0.9, d.rest);
    return std::pair(d.rows ? d.rows->spread() : std::nullopt, rows.spread());
  });
  ASSERT_TRUE(anew);
  EXPECT_EQ(has, anew);
}

}  // namespace
}  // namespace meander::test::even_lines_tests
