// SPDX-License-Identifier: GPL-3.0-or-later
//
// Curvature and direction fields on surfaces on which they are known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesh/fields.h"
#include "mesh/line_relaxation.h"
#include "mesh/line_field.h"
#include "meshes.h"

namespace meander::test::fields_tests {
namespace {

constexpr uint32_t kAround = 60, kAcross = 30;
constexpr double kBig = 1, kSmall = 0.4;

/// What is known at vertex (i, j) of torus(kAround, kAcross).
struct TorusPoint {
  explicit TorusPoint(uint32_t vertex) {
    const double u = 2 * kPi * (vertex / kAcross) / kAround, v = 2 * kPi * (vertex % kAcross) / kAcross;
    along = Vec3(-std::sin(u), std::cos(u), 0);
    round = Vec3(-std::sin(v) * std::cos(u), -std::sin(v) * std::sin(u), std::cos(v));
    k1 = 1 / kSmall;
    k2 = std::cos(v) / (kBig + kSmall * std::cos(v));
  }
  Vec3 along, round;  // directions of the two principal curvatures k2 and k1
  double k1, k2;
};

TEST(Curvature, OfATorusIsThatOfTheSmoothOne) {
  // Discretisation: the mesh's angles are 2 pi / 30, their square is 0.04.
  constexpr double kDiscrete = 0.02;
  const Surface s = make_surface(torus(kAround, kAcross, kBig, kSmall));
  const auto gaussian = curvature(s, CurvatureKind::kGaussian, 0);
  const auto mean = curvature(s, CurvatureKind::kMean, 0);
  const auto curvedness = curvature(s, CurvatureKind::kCurvedness, 0);
  for (uint32_t v = 0; v < s.vertex_count(); ++v) {
    const TorusPoint p(v);
    EXPECT_NEAR(gaussian[v] / (s.scale() * s.scale()), p.k1 * p.k2, kDiscrete * p.k1 * p.k1);
    EXPECT_NEAR(mean[v] / s.scale(), (p.k1 + p.k2) / 2, kDiscrete * p.k1);
    EXPECT_NEAR(curvedness[v] / s.scale(), std::sqrt((p.k1 * p.k1 + p.k2 * p.k2) / 2), kDiscrete * p.k1);
  }
}

/// The square of the first underflows to a denormal number, that of the second to zero.
TEST(Curvature, TinySmoothingLeavesAMeshWithAnUnusedVertexAsItIs) {
  Mesh mesh = torus(kAround, kAcross, kBig, kSmall);
  const uint32_t unused = mesh.add(0.1, 0.2, 0.3);
  const Surface s = make_surface(mesh);
  for (const double radius : {1e-160, 1e-170}) {
    for (const auto kind : {CurvatureKind::kGaussian, CurvatureKind::kMean, CurvatureKind::kCurvedness}) {
      const auto sharp = curvature(s, kind, 0), smoothed = curvature(s, kind, radius);
      for (uint32_t v = 0; v < s.vertex_count(); ++v) EXPECT_NEAR(smoothed[v], sharp[v], 1e-12 * std::abs(sharp[v]));
      EXPECT_EQ(smoothed[unused], 0);
    }
    for (const bool most : {false, true}) {
      const auto sharp = principal_directions(s, most, 0), smoothed = principal_directions(s, most, radius);
      for (uint32_t v = 0; v < s.vertex_count(); ++v) EXPECT_LT((smoothed[v] - sharp[v]).norm(), 1e-9);
    }
  }
}

TEST(Curvature, SmoothedKeepsItsIntegralAndFlattens) {
  constexpr double kRounding = 1e-9;
  const Surface s = make_surface(with_noise(torus(kAround, kAcross, kBig, kSmall), 0.2, 3));
  std::vector<double> area(s.vertex_count(), 0);
  for (uint32_t f = 0; f < s.face_count(); ++f) {
    for (const uint32_t v : s.face(f)) area[v] += s.face_area(f) / 3;
  }
  const auto moments = [&](const VertexData<double>& x) {
    double sum = 0, square = 0;
    for (size_t v = 0; v < x.size(); ++v) {
      sum += area[v] * x[v];
      square += area[v] * x[v] * x[v];
    }
    return std::pair(sum, square);
  };
  const auto [raw, raw_square] = moments(curvature(s, CurvatureKind::kAbsoluteGaussian, 0));
  double before = raw_square;
  for (const double radius : {0.02, 0.05, 0.2}) {
    const auto [sum, square] = moments(curvature(s, CurvatureKind::kAbsoluteGaussian, radius));
    EXPECT_NEAR(sum, raw, kRounding * raw);
    EXPECT_LT(square, before);
    before = square;
  }
}

TEST(Directions, OfCurvatureAreTheCirclesOfATorus) {
  constexpr double kStraight = 1e-4;  // 1 - cos of the angle between the two
  const Surface s = make_surface(torus(kAround, kAcross, kBig, kSmall));
  for (const double radius : {0.0, 0.05}) {
    const auto least = principal_directions(s, false, radius), most = principal_directions(s, true, radius);
    for (uint32_t v = 0; v < s.vertex_count(); ++v) {
      const TorusPoint p(v);
      EXPECT_NEAR(std::abs(least[v].dot(p.along)), 1, kStraight);
      EXPECT_NEAR(std::abs(most[v].dot(p.round)), 1, kStraight);
    }
  }
}

TEST(Directions, OfCurvatureAreNotThereOnAPlane) {
  for (const Vec3& d : principal_directions(make_surface(flat_grid(6)), true, 0.1)) EXPECT_EQ(d.norm(), 0);
}

TEST(Directions, SmoothestOnFlatSheetsAreParallel) {
  constexpr double kRounding = 1e-6;
  // The second sheet is smaller, separate, and stands on its edge.
  Mesh upright = grid(
      5, 0.2, [](double x, double y) { return Vec3(0.3 * x, 0, 0.3 * y); }, no_hole);
  const Surface s = make_surface(joined(flat_grid(8), upright, 3));
  const VertexData<Vec3> d = smoothest_directions(s);
  for (const size_t first : {size_t{0}, size_t{81}}) {
    for (size_t v = first; v < (first == 0 ? 81 : d.size()); ++v) {
      EXPECT_NEAR(d[v].norm(), 1, kRounding);
      EXPECT_NEAR(std::abs(d[v].dot(d[first])), 1, kRounding);
    }
  }
}

/// No field of lines on a torus is smoother than the two that run along its circles.
TEST(Directions, SmoothestOnATorusHaveNoSingularity) {
  constexpr double kStraight = 1e-3;
  const Surface s = make_surface(torus(kAround, kAcross, kBig, kSmall));
  const VertexData<Vec3> d = smoothest_directions(s);
  for (uint32_t v = 0; v < d.size(); ++v) EXPECT_NEAR(std::abs(d[v].dot(TorusPoint(v).along)), 1, kStraight);
}

TEST(Directions, AreTangentialUnitVectorsOnAnything) {
  constexpr double kRounding = 1e-9;
  for (const Mesh& mesh : {sphere(3), with_noise(sphere(3), 0.3, 7), cube(), cone(7, 5, 4), bumpy_grid(12)}) {
    const Surface s = make_surface(mesh);
    for (const Vec3& v : smoothest_directions(s)) EXPECT_NEAR(v.norm(), 1, kRounding);
  }
}

TEST(Directions, FollowStrokes) {
  constexpr double kStraight = 0.02;  // 1 - cos: strokes pull, they do not force
  const Surface s = make_surface(flat_grid(20));
  const auto inside = [&](double x, double y) { return s.to_inside(Vec3(x, y, 0)); };
  // A quarter of a circle, and a line at right angles to its end.
  std::vector<Vec3> arc, line{inside(0.55, 0.1), inside(0.9, 0.1)};
  for (int k = 0; k <= 20; ++k) {
    const double a = kPi / 2 * k / 20;
    arc.push_back(inside(0.9 - 0.7 * std::sin(a), 0.2 + 0.7 * std::cos(a)));
  }
  const Stroke strokes[] = {arc, line};
  const VertexData<Vec3> d = extended_directions(s, strokes);
  const auto nearest = [&](double x, double y) {
    uint32_t best = 0;
    for (uint32_t v = 0; v < s.vertex_count(); ++v) {
      if ((s.position(v) - inside(x, y)).norm() < (s.position(best) - inside(x, y)).norm()) best = v;
    }
    return best;
  };
  for (int k = 2; k <= 18; ++k) {
    const double a = kPi / 2 * k / 20;
    const Vec3 tangent(std::cos(a), std::sin(a), 0);
    EXPECT_GT(std::abs(d[nearest(0.9 - 0.7 * std::sin(a), 0.2 + 0.7 * std::cos(a))].dot(tangent)), 1 - 2 * kStraight);
  }
  EXPECT_NEAR(std::abs(d[nearest(0.7, 0.1)].x()), 1, kStraight);
  for (const Vec3& v : d) EXPECT_NEAR(v.norm(), 1, 1e-9);
}

TEST(Directions, StayAwayFromComponentsWithoutStrokes) {
  const Surface s = make_surface(joined(flat_grid(4), flat_grid(4), 3));
  const std::vector<Vec3> line{s.to_inside({0.1, 0.5, 0}), s.to_inside({0.9, 0.6, 0})};
  const Stroke strokes[] = {line};
  const VertexData<Vec3> d = extended_directions(s, strokes);
  for (size_t v = 0; v < 25; ++v) EXPECT_NEAR(d[v].norm(), 1, 1e-9);
  for (size_t v = 25; v < 50; ++v) EXPECT_EQ(d[v].norm(), 0);
}

TEST(LineField, HasNoSignAndNoLength) {
  constexpr double kRounding = 1e-12;
  Rng rng(9);
  const Surface s = make_surface(bumpy_grid(6));
  VertexData<Vec3> one(s.vertex_count(), Vec3::Zero()), other = one;
  for (uint32_t v = 0; v < s.vertex_count(); ++v) {
    one[v] = Vec3(rng.in(-1, 1), rng.in(-1, 1), rng.in(-1, 1));
    other[v] = (v % 2 == 0 ? -1 : 1) * std::pow(10, rng.in(-150, 150)) * one[v];
  }
  const LineField a(s, one, false), b(s, other, false), across(s, one, true);
  for (int k = 0; k < 200; ++k) {
    const SurfacePoint p = random_point(s, rng);
    const Vec2 x = a.at(p), y = b.at(p), z = across.at(p);
    EXPECT_NEAR(std::abs(dot(x, y)), dot(x, x), kRounding);
    EXPECT_LE(norm(x), 1 + kRounding);
    EXPECT_NEAR(dot(x, z), 0, kRounding);
    EXPECT_NEAR(norm(x), norm(z), kRounding);
  }
}

/// A vector that stands up from the surface by an angle is as sure of its line as the cosine of that angle.
TEST(LineField, IsAsSureAsItsVectorsLieInTheSurface) {
  const Surface s = make_surface(flat_grid(2, 0));
  for (const double angle : {0.0, 0.3, 1.0, 1.5}) {
    const Vec3 rising(0.6 * std::cos(angle), 0.8 * std::cos(angle), std::sin(angle));
    for (const bool across : {false, true}) {
      const LineField field(s, VertexData<Vec3>(std::vector<Vec3>(s.vertex_count(), 7 * rising)), across);
      for (uint32_t f = 0; f < s.face_count(); ++f) {
        const Vec2 line = field.at(make_point(f, 1, 2, 1));
        EXPECT_NEAR(dot(line, line), std::cos(angle), 1e-12);
        const Vec3 expected = across ? Vec3(-0.8, 0.6, 0) : Vec3(0.6, 0.8, 0);
        EXPECT_NEAR(std::abs(s.to_space(f, unit(line)).dot(expected)), 1, 1e-12);
      }
    }
  }
}

TEST(LineField, WishesForNothingWhereVectorsAreMissing) {
  const Surface s = make_surface(flat_grid(2, 0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  VertexData<Vec3> d(s.vertex_count(), Vec3(nan, 0, 0));
  d[0] = Vec3::Zero();
  d[1] = Vec3(0, 0, 1);  // normal to the surface
  EXPECT_TRUE(LineField(s, d, false).empty());
  d[8] = Vec3(0, 3, 0);
  const LineField field(s, d, false);
  ASSERT_FALSE(field.empty());
  for (uint32_t f = 0; f < s.face_count(); ++f) {
    double weight = 0;
    for (uint32_t k = 0; k < 3; ++k) weight = std::max(weight, s.face(f)[k] == 8 ? 1.0 : 0.0);
    EXPECT_NEAR(norm(field.at(make_point(f, 1, 1, 1))), weight * std::sqrt(1.0 / 3), 1e-9);
  }
}

TEST(LineField, SquareRootsAreRoots) {
  constexpr double kRounding = 1e-15;
  for (int k = 0; k < 100; ++k) {
    const double a = 2 * kPi * k / 100;
    const Vec2 z{3 * std::cos(a), 3 * std::sin(a)}, root = square_root(z);
    EXPECT_NEAR(norm(root * root - z), 0, 10 * kRounding);
  }
  EXPECT_EQ(norm(square_root({0, 0})), 0);
}

TEST(BoundaryDirections, AreParallelToTheBoundaryAndZeroWhereThereIsNone) {
  const Surface surface = make_surface(joined(flat_grid(8), octahedron(), 4));
  const VertexData<Vec3> directions = boundary_directions(surface);
  size_t seen = 0;
  for (const HalfEdge e : surface.boundary()) {
    const Triangle& t = surface.face(face_of(e));
    const uint32_t a = t[corner_of(e)], b = t[next_corner(corner_of(e))];
    const Vec3 along = (surface.position(b) - surface.position(a)).normalized();
    const bool corner = (directions[a] - directions[b]).norm() > 0.5 && (directions[a] + directions[b]).norm() > 0.5;
    if (corner) continue;  // where two sides meet
    EXPECT_GT(std::abs(directions[a].dot(along)) + std::abs(directions[b].dot(along)), 1.8);
    ++seen;
  }
  EXPECT_GT(seen, 16u);
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    if (surface.component(f) == 0) continue;
    for (const uint32_t v : surface.face(f)) EXPECT_EQ(directions[v].norm(), 0);
  }
}

TEST(RelaxedField, IsAboutAsSmoothAsTheSmoothest) {
  // By how much lines turn across the edges, from the middle of a face to that of the next, all in all.
  const auto turning = [](const Surface& s, const LineField& field) {
    double sum = 0;
    for (HalfEdge e = 0; e < 3 * s.face_count(); ++e) {
      if (s.twin(e) == kNone) continue;
      const Vec2 here = unit(field.at(make_point(face_of(e), 1, 1, 1)));
      const Vec2 there = unit(field.at(make_point(face_of(s.twin(e)), 1, 1, 1)));
      sum += 1 - std::min(std::abs(dot(here, s.transition(s.twin(e)) * there)), 1.0);
    }
    return sum / static_cast<double>(s.face_count());
  };
  ThreadPool pool(2);
  for (const Mesh& mesh : {torus(48, 24), sphere(4), bumpy_grid(24), cube()}) {
    const Surface surface = make_surface(mesh);
    const LineField smoothest(surface, smoothest_directions(surface), false);
    // A torus has a field without singularities, and relaxation leaves some pairs of them.
    EXPECT_LT(turning(surface, relaxed_field(surface, {1, 0}, false, pool)), 4 * turning(surface, smoothest) + 0.01);
  }
}

TEST(RelaxedField, IsParallelToTheXAxisOnAFlatSheet) {
  const Surface surface = make_surface(flat_grid(9));
  ThreadPool pool(1);
  const LineField field = relaxed_field(surface, {1, 0}, false, pool);
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    const Vec3 line = surface.to_space(f, field.at(make_point(f, 1, 1, 1)));
    EXPECT_NEAR(std::abs(line.x()), 1, 1e-9);
  }
}

}  // namespace
}  // namespace meander::test::fields_tests
