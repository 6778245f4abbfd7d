// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the lines of a field stay as far apart as they are, and how wide a surface is across them.
#include <gtest/gtest.h>

#include <cmath>

#include "meshes.h"
#include "mesh/even_lines.h"

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
  EXPECT_NEAR(widths_across(sheet, along_axis(sheet, {1, 0, 0}))[0], side, 1e-6);
  EXPECT_NEAR(widths_across(sheet, along_axis(sheet, {1, 1, 0}))[0], std::sqrt(2.0) * side, 1e-6);
  EXPECT_NEAR(widths_across(pipe, along_axis(pipe, {0, 0, 1}, true))[0] * pipe.scale(), 2, 1e-6);
  EXPECT_EQ(widths_across(pipe, along_axis(pipe, {0, 0, 1}))[0], 0);  // it closes on itself
}

}  // namespace
}  // namespace meander::test::even_lines_tests
