// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lines of full starts where no direction is asked for: they follow the boundary, and are at their distance.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "seed/full_start.h"
#include "seed/start_places.h"
#include "curves.h"
#include "test_seeds.h"

namespace meander::test::start_lines_tests {
namespace {

/// The radius of a shallow cone, in the caller's unit, by how much it rises to its tip from one unit to the next, and
/// how much longer that makes a way outwards.
constexpr double kRings = 12, kSlope = 0.5;
const double kLonger = std::sqrt(1 + kSlope * kSlope);

/// A cone, which has a boundary and no even lines, and the first curve of a full start on it.
struct FullCone {
  std::shared_ptr<const Surface> surface;
  double rim, r;
  Curve curve;

  Vec3 centre() const { return surface->position(0); }
};

FullCone full_cone(double spacing) {
  const auto surface = std::make_shared<const Surface>(make_surface(cone(96, static_cast<uint32_t>(kRings), kSlope)));
  const Flow flow(surface, nullptr, {}, checked_settings(options_of(spacing), *surface));
  const double r = flow.settings().radius;
  ThreadPool pool(1);
  FullStart start = full_start(*surface, flow.curve(), 0, RadiusField(r), {}, nullptr, 0.5, pool);
  return {surface, kRings / surface->scale(), r, std::move(start.curve)};
}

/// Every place of a face is near to one where a line may begin, and a long face has no more of these than its area and
/// its boundary ask for: of 300 x .8 r it had 11,325.
TEST(StartLines, LongFacesHaveFewPlaces) {
  for (const double height : {0.8, 3.0, 20.0, 200.0}) {
    for (const double foot : {0.0, 0.01, 0.5, 0.7}) {
      for (const uint32_t first : {0u, 1u, 2u}) {
        const std::array<Vec3, 3> corners = {Vec3(0, 0, 0), Vec3(300, 0, 0), Vec3(300 * foot, height, 0)};
        Mesh mesh;
        for (uint32_t k = 0; k < 3; ++k) {
          const Vec3& p = corners[(first + k) % 3];
          mesh.add(p.x(), p.y(), p.z());
        }
        mesh.face(0, 1, 2);
        const Surface s = make_surface(mesh);
        const double r = 1 / s.scale();
        std::vector<Vec3> places;
        for_places_in_face(s, 0, r, [&](const SurfacePoint& p) { places.push_back(s.scale() * position(s, p)); });
        EXPECT_LT(places.size(), 300 * height / 2 / 4 + 300) << height;
        const auto at = [&](uint32_t corner) { return Vec3(s.scale() * s.position(s.face(0)[corner])); };
        for (double x = 0; x <= 1; x += 0.05) {
          for (double y = 0; x + y <= 1; y += 0.05) {
            const Vec3 p = (1 - x - y) * at(0) + x * at(1) + y * at(2);
            EXPECT_TRUE(std::ranges::any_of(places, [&](const Vec3& q) { return (p - q).norm() < 2.5; }))
                << height << " " << foot << " " << x << " " << y;
          }
        }
      }
    }
  }
}

TEST(StartLines, FollowTheBoundary) {
  for (const double spacing : {0.4, 0.55, 0.7}) {
    SCOPED_TRACE(spacing);
    const FullCone cone = full_cone(spacing);
    double all = 0, along = 0;
    for (uint32_t i = 0; i < cone.curve.size(); ++i) {
      const Vec3 a = position(*cone.surface, cone.curve.nodes[i]);
      const Vec3 b = position(*cone.surface, cone.curve.nodes[cone.curve.next(i)]);
      Vec3 middle = 0.5 * (a + b) - cone.centre();
      middle.z() = 0;
      const Vec3 step = b - a;
      if ((cone.rim - middle.norm()) * kLonger > 3 * cone.r) continue;  // the outermost two rows
      const double outwards = kLonger * std::abs(step.dot(middle)) / (step.norm() * middle.norm());
      all += step.norm();
      if (outwards < std::sin(kPi / 12)) along += step.norm();
    }
    EXPECT_GT(along, 0.9 * all);
  }
}

TEST(StartLines, AreTheSameForAnyNumberOfThreads) {
  // So near to each other that every loop is shared; with a boundary, and without.
  for (const Mesh& mesh : {bumpy_grid(24), torus(96, 48)}) {
    const auto surface = std::make_shared<const Surface>(make_surface(mesh));
    const double spacing = 0.015 * std::sqrt(surface->area()) * surface->scale();
    const Flow flow(surface, nullptr, {}, checked_settings(options_of(spacing), *surface));
    const RadiusField radius(flow.settings().radius);
    std::vector<Curve> curves;
    for (const unsigned threads : {1u, 3u}) {
      ThreadPool pool(threads);
      curves.push_back(full_start(*surface, flow.curve(), 0, radius, {}, nullptr, 0.5, pool).curve);
    }
    ASSERT_EQ(curves[1].size(), curves[0].size());
    EXPECT_GT(curves[0].size(), 4096u);
    for (uint32_t i = 0; i < curves[0].size(); ++i) {
      const SurfacePoint &a = curves[0].nodes[i], &b = curves[1].nodes[i];
      ASSERT_TRUE(a.face == b.face && a.b.x == b.b.x && a.b.y == b.b.y) << i;
    }
  }
}

/// Where a line from the middle outwards crosses the curve, as shares of the rim's radius.
std::vector<double> on_spoke(const FullCone& cone, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  std::vector<double> found;
  for (uint32_t i = 0; i < cone.curve.size(); ++i) {
    const Vec3 a = position(*cone.surface, cone.curve.nodes[i]) - cone.centre();
    const Vec3 b = position(*cone.surface, cone.curve.nodes[cone.curve.next(i)]) - cone.centre();
    const double from = c * a.y() - s * a.x(), to = c * b.y() - s * b.x();
    if ((from < 0) == (to < 0)) continue;
    const Vec3 p = a + from / (from - to) * (b - a);
    if (c * p.x() + s * p.y() > 0) found.push_back((c * p.x() + s * p.y()) / cone.rim);
  }
  std::ranges::sort(found);
  return found;
}

/// The curve runs on both sides of every line, so its every second strand is on the same side of the next line. In the
/// middle lines turn. Of streamlines, two fifths of the gaps are within a tenth of what they should be.
TEST(StartLines, AreAtTheirDistance) {
  const FullCone cone = full_cone(0.4);
  size_t gaps = 0, right = 0;
  for (int k = 0; k < 64; ++k) {
    const std::vector<double> strands = on_spoke(cone, (k + 0.37) * kPi / 32);
    for (size_t i = 0; i + 2 < strands.size(); ++i) {
      if (strands[i] < 0.4) continue;
      ++gaps;
      right += std::abs((strands[i + 2] - strands[i]) * kLonger * cone.rim / (4 * cone.r) - 1) < 0.1;
    }
  }
  ASSERT_GT(gaps, 64u * 10u);
  EXPECT_GT(static_cast<double>(right), 0.6 * static_cast<double>(gaps));
}

/// Round a thin tube that closes, lines along it are two, three or four, whatever is wanted. So the field is turned
/// until the curve is as long as it is to be.
TEST(StartLines, AreAsLongAsTheyAreToBeRoundATubeThatCloses) {
  const Mesh mesh = joined(torus(96, 24, 1, 0.2), torus(80, 24, 1, 0.25), 4);
  const auto surface = std::make_shared<const Surface>(make_surface(mesh));
  for (const double lines : {2.5, 2.8, 3.2, 3.5}) {  // along the first tube
    SCOPED_TRACE(lines);
    const Flow flow(surface, nullptr, {}, checked_settings(options_of(2 * kPi * 0.2 / lines / 2), *surface));
    const double r = flow.settings().radius;
    ThreadPool pool(1);
    for (const uint32_t variation : {0, 1}) {
      const Curve full = full_start(*surface, flow.curve(), 0, RadiusField(r), {}, nullptr, 0.5, pool,
                                    StartLines::kPhase, variation).curve;
      std::vector<double> length(2, 0), area(2, 0);
      for (uint32_t i = 0; i < full.size(); ++i) {
        length[surface->component(full.nodes[i].face)] += full.shapes[i].length;
      }
      for (uint32_t f = 0; f < surface->face_count(); ++f) area[surface->component(f)] += surface->face_area(f);
      for (size_t k = 0; k < 2; ++k) EXPECT_NEAR(length[k] * 2 * r / area[k], 1, 0.05);
    }
  }
}

}  // namespace
}  // namespace meander::test::start_lines_tests
