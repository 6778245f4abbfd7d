// SPDX-License-Identifier: GPL-3.0-or-later
//
// Limbs that are thin all round are seen, and lines of a full start lead along them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "curves.h"
#include "geodesic/patch_comparison.h"
#include "seed/full_start.h"
#include "seed/limbs.h"
#include "test_seeds.h"
#include "thin_surfaces.h"

namespace meander::test::limbs_tests {
namespace {

constexpr double kMost = 3;

std::vector<Vec2> limbs_of(const Surface& surface, double r, double most = kMost) {
  ThreadPool pool(1);
  return bending_of_limbs(surface, compared_patches(surface, RadiusField(r), 3, pool), RadiusField(r), most, pool);
}

TEST(Limbs, LieAlongATubeThatIsThin) {
  // Prisms, whose walks round them are as long wherever they begin; fine faces, and long ones.
  for (const uint32_t along : {8u, 160u}) {
    for (const double girth : {1.0, 2.0, 2.7}) {
      SCOPED_TRACE(std::to_string(along) + " " + std::to_string(girth));
      const Surface surface = make_surface(cylinder(8, along, 100));
      const double round = 16 * std::sin(kPi / 8) / surface.scale(), r = round / girth;
      const std::vector<Vec2> limbs = limbs_of(surface, r);
      ASSERT_EQ(limbs.size(), surface.face_count());
      const double bending = std::pow(2 * kPi / round, 2), least = std::pow(2 * kPi / (kMost * r), 2);
      for (uint32_t f = 0; f < surface.face_count(); ++f) {
        const Vec2 axis = unit(surface.to_plane(f, Vec3::UnitZ())), limb = (1 / surface.face_area(f)) * limbs[f];
        if (norm(limb) == 0) continue;  // near an end
        EXPECT_NEAR(norm(limb) + least, bending, 0.1 * bending);
        EXPECT_GT(dot(unit(limb), axis * axis), 0.97);
      }
      const auto held = std::ranges::count_if(limbs, [](Vec2 v) { return norm(v) > 0; });
      EXPECT_GT(static_cast<double>(held), 0.4 * static_cast<double>(limbs.size()));
    }
  }
}

/// A line that winds round a tube at an angle has the girth times the cosine of that from one turn to the next.
TEST(Limbs, WindAsSteeplyAsALineHasRoom) {
  for (const double girth : {4.2, 5.0, 6.0}) {
    SCOPED_TRACE(girth);
    const Surface surface = make_surface(cylinder(8, 160, 100));
    const double round = 16 * std::sin(kPi / 8) / surface.scale();
    const std::vector<Vec2> limbs = limbs_of(surface, round / girth, 6.4);
    ASSERT_EQ(limbs.size(), surface.face_count());
    for (uint32_t f = 0; f < surface.face_count(); ++f) {
      if (norm(limbs[f]) == 0) continue;  // near an end
      const Vec2 axis = unit(surface.to_plane(f, Vec3::UnitZ())), twice = unit(limbs[f]) * conj(axis * axis);
      EXPECT_GT(twice.y, 0);  // one way all over
      EXPECT_NEAR(girth * std::sqrt(0.5 * (1 + twice.x)), 3.7, 0.2);
    }
    const auto held = std::ranges::count_if(limbs, [](Vec2 v) { return norm(v) > 0; });
    EXPECT_GT(static_cast<double>(held), 0.4 * static_cast<double>(limbs.size()));
  }
}

/// A ball of few faces, with one corner three times as far out: thin all round near its point.
Mesh horn() {
  Mesh mesh = sphere(2);
  size_t top = 0;
  for (size_t k = 0; k < mesh.vertices.size(); k += 3) {
    if (mesh.vertices[k + 2] > mesh.vertices[top + 2]) top = k;
  }
  for (size_t k = 0; k < 3; ++k) mesh.vertices[top + k] *= 3;
  return mesh;
}

TEST(Limbs, AreNotWhereNothingIsThinAllRound) {
  const auto none = [](const char* name, const Mesh& mesh, double r) {
    SCOPED_TRACE(name);
    const Surface surface = make_surface(mesh);
    EXPECT_TRUE(limbs_of(surface, r / surface.scale()).empty());
  };
  none("square", flat_grid(12), 0.1);
  none("sphere", sphere(4), 0.2);
  none("cube", cube(), 0.1);
  none("plate", plate(1, 0.01, 12), 0.05);
  none("leaf", leaf(1, 0.02, 0.3, 16), 0.04);
  none("cloth", folded_cloth(1, 1, 0.02, 4, 12), 0.05);
  none("tube", cylinder(16, 40, 20), 1.9);  // 3.3 r round
  none("horn", horn(), 0.35);
}

/// A ball drawn out to a needle of this many radii: as long as that, and thin all round.
Mesh needle(double length) {
  Mesh mesh = sphere(4);
  for (size_t k = 0; k < mesh.vertices.size(); k += 3) mesh.vertices[k] *= length;
  return mesh;
}

/// Two strands along it are the least that a closed line can have there, and of a needle, which is pi / 4 of its girth
/// round in the mean, they make a packing of 4 over that.
TEST(Limbs, HaveLinesAlongThemInEveryVariation) {
  for (const double girth : {2.0, 3.0, 4.0}) {
    const auto surface = std::make_shared<const Surface>(make_surface(needle(30)));
    const double r = 2 * kPi / girth / surface->scale();
    const Flow flow(surface, nullptr, {}, checked_settings(options_of(2 * r * surface->scale()), *surface));
    ThreadPool pool(1);
    for (uint32_t variation = 0; variation < 4; ++variation) {
      SCOPED_TRACE(std::to_string(girth) + " " + std::to_string(variation));
      const Curve full = full_start(*surface, flow.curve(), 0, RadiusField(r), {}, nullptr, 0.5, pool,
                                    StartLines::kPhase, variation)
                             .curve;
      EXPECT_TRUE(exact_crossings(*surface, full).empty());
      const double least = 4 / (0.25 * kPi * girth), packing = full.length() * 2 * r / surface->area();
      EXPECT_LT(packing, 1.2 * least);
      EXPECT_GT(packing, 0.4 * least);
    }
  }
}

/// A ball drawn out to a tube of radius 1 with round ends.
Mesh capsule(double length) {
  Mesh mesh = sphere(4);
  for (size_t k = 0; k < mesh.vertices.size(); k += 3) {
    const double x = mesh.vertices[k];
    mesh.vertices[k] += std::abs(x) < 1e-9 ? 0 : std::copysign(0.5 * length, x);
  }
  return mesh;
}

/// From a spacing and a half round on, two strands can lie at their spacing, one beside the other or wound round.
TEST(Limbs, AreFilledEvenlyInEveryVariation) {
  for (const double girth : {4.0, 4.5, 5.0, 5.5, 6.0}) {
    const auto surface = std::make_shared<const Surface>(make_surface(capsule(40)));
    const double spacing = 4 * kPi / girth, r = 0.5 * spacing / surface->scale();
    const Flow first(surface, nullptr, {}, checked_settings(options_of(spacing), *surface));
    ThreadPool pool(1);
    for (uint32_t variation = 0; variation < 4; ++variation) {
      SCOPED_TRACE(std::to_string(girth) + " " + std::to_string(variation));
      const Curve full = full_start(*surface, first.curve(), 0, RadiusField(r), {}, nullptr, 0.5, pool,
                                    StartLines::kPhase, variation)
                             .curve;
      EXPECT_TRUE(exact_crossings(*surface, full).empty());
      const double packing = full.length() * 2 * r / surface->area();
      EXPECT_LT(packing, 1.15);
      EXPECT_GT(packing, 0.8);
    }
  }
}

}  // namespace
}  // namespace meander::test::limbs_tests
