// SPDX-License-Identifier: GPL-3.0-or-later
//
// The nearest points of meshes, against a look at all faces by another formula and in more digits.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "api_flows.h"
#include "mesh/closest_point.h"
#include "mesh/triangle_tree.h"
#include "meshes.h"

namespace meander::test::closest_point_tests {
namespace {

using Long = Eigen::Matrix<long double, 3, 1>;

struct Found {
  std::vector<uint32_t> faces;
  std::vector<double> weights, distances;
  bool operator==(const Found&) const = default;
};

Found closest(const Mesh& mesh, const std::vector<double>& points, uint32_t threads = 1) {
  const size_t count = points.size() / 3;
  Found found{std::vector<uint32_t>(count), std::vector<double>(3 * count), std::vector<double>(count)};
  auto error = prepared<meander_error>();
  EXPECT_EQ(meander_mesh_find_closest(mesh.vertices.data(), mesh.vertex_count(), mesh.faces.data(), mesh.face_count(),
                                      points.data(), count, threads, found.faces.data(), found.weights.data(),
                                      found.distances.data(), nullptr, &error),
            MEANDER_STATUS_OK)
      << error.text;
  return found;
}

Long at(const Mesh& mesh, uint32_t v) { return mesh.at(v).cast<long double>(); }

long double to_side(const Long& a, const Long& b, const Long& q) {
  const Long side = b - a;
  const long double length = side.squaredNorm();
  const long double t = length > 0 ? std::clamp((q - a).dot(side) / length, 0.0L, 1.0L) : 0;
  return ((a - q) + t * side).norm();
}

/// What is left of q - a without its parts along a side and upright on that: too much, if anything, where the side is
/// not the longest one of a needle.
long double to_plane(const Long& a, const Long& b, const Long& c, const Long& q) {
  const Long u = (b - a).normalized();
  Long v = c - a;
  for (int k = 0; k < 3; ++k) v = (v - v.dot(u) * u).normalized();
  Long rest = q - a;
  for (int k = 0; k < 3; ++k) rest = rest - rest.dot(u) * u - rest.dot(v) * v;
  return rest.norm();
}

/// How far a point is from a face: from its plane where its foot is inside, as the three signed areas tell, or else
/// from a side.
long double to_face(const Mesh& mesh, uint32_t f, const Long& q) {
  const Long a = at(mesh, mesh.faces[3 * f]), b = at(mesh, mesh.faces[3 * f + 1]), c = at(mesh, mesh.faces[3 * f + 2]);
  long double least = std::min({to_side(a, b, q), to_side(b, c, q), to_side(c, a, q)});
  const Long n = (b - a).cross(c - a);
  if (!(n.squaredNorm() > 0)) return least;
  const bool inside = n.dot((b - a).cross(q - a)) >= 0 && n.dot((c - b).cross(q - b)) >= 0 &&
                      n.dot((a - c).cross(q - c)) >= 0;
  if (inside) least = std::min({least, to_plane(a, b, c, q), to_plane(b, c, a, q), to_plane(c, a, b, q)});
  return least;
}

double extent(const Mesh& mesh) {
  Vec3 low = mesh.at(mesh.faces[0]), high = low;
  for (const uint32_t v : mesh.faces) {
    low = low.cwiseMin(mesh.at(v));
    high = high.cwiseMax(mesh.at(v));
  }
  return (high - low).norm();
}

/// Rounding, in units of the mesh's size and of the distance.
constexpr double kRounding = 0x1p-46;

void expect_nearest(const Mesh& mesh, const std::vector<double>& points) {
  const Found found = closest(mesh, points);
  const double size = extent(mesh);
  for (size_t i = 0; i < points.size() / 3; ++i) {
    const Long q(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    long double least = std::numeric_limits<long double>::infinity();
    for (uint32_t f = 0; f < mesh.face_count(); ++f) least = std::min(least, to_face(mesh, f, q));
    const double rounding = kRounding * (size + static_cast<double>(least));
    ASSERT_NEAR(found.distances[i], static_cast<double>(least), rounding) << "point " << i;
    // What is returned is a point of the face, at that distance.
    const double* w = &found.weights[3 * i];
    ASSERT_TRUE(w[0] >= 0 && w[1] >= 0 && w[2] >= 0);
    ASSERT_NEAR(w[0] + w[1] + w[2], 1, 1e-15);
    Long p = Long::Zero();
    for (uint32_t k = 0; k < 3; ++k) {
      p += static_cast<long double>(w[k]) * (at(mesh, mesh.faces[3 * found.faces[i] + k]) - q);
    }
    ASSERT_NEAR(static_cast<double>(p.norm()), static_cast<double>(least), rounding) << "point " << i;
  }
}

std::vector<double> places_around(const Mesh& mesh, size_t count, uint64_t seed) {
  Rng rng(seed);
  std::vector<double> points;
  const double size = extent(mesh);
  for (size_t i = 0; i < count; ++i) {
    const uint32_t f = rng.below(mesh.face_count());
    const double u = rng(), v = rng() * (1 - u);
    Vec3 p = (1 - u - v) * mesh.at(mesh.faces[3 * f]) + u * mesh.at(mesh.faces[3 * f + 1]) +
             v * mesh.at(mesh.faces[3 * f + 2]);
    // On a vertex, on the face, near it, anywhere around, far away.
    if (i % 5 == 0) p = mesh.at(mesh.faces[3 * f]);
    const double away = std::array{0.0, 0.0, 1e-6, 1.0, 1e6}[i % 5] * size;
    for (double& x : p) x += rng.in(-away, away);
    points.insert(points.end(), p.begin(), p.end());
  }
  return points;
}

Mesh moved(Mesh mesh, double factor, const Vec3& offset) {
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    mesh.vertices[i] = factor * mesh.vertices[i] + offset[static_cast<Eigen::Index>(i % 3)];
  }
  return mesh;
}

/// Triangles anywhere, of all sizes, half of them slivers, some without area, some points, some twice.
Mesh soup(uint32_t count, uint64_t seed) {
  Rng rng(seed);
  Mesh mesh;
  const auto away = [&](double by) { return Vec3(rng.in(-by, by), rng.in(-by, by), rng.in(-by, by)); };
  for (uint32_t f = 0; f < count; ++f) {
    const double size = std::pow(10.0, rng.in(-9, 0));
    const Vec3 a = away(1), b = a + away(size);
    Vec3 c = a + away(size);
    if (f % 2 == 0) c = a + rng() * (b - a) + away(size * std::pow(10.0, rng.in(-17, -2)));
    if (f % 7 == 0) c = a + rng.in(-1, 2) * (b - a);
    if (f % 11 == 0) c = a;
    const Vec3 d = f % 13 == 0 ? a : b;
    mesh.face(mesh.add(a.x(), a.y(), a.z()), mesh.add(d.x(), d.y(), d.z()), mesh.add(c.x(), c.y(), c.z()));
    if (f % 17 == 0) mesh.face(3 * f % mesh.vertex_count(), 0, mesh.vertex_count() - 1);
    if (f % 19 == 0) mesh.faces.insert(mesh.faces.end(), mesh.faces.end() - 3, mesh.faces.end());
  }
  return mesh;
}

TEST(ClosestPoint, IsTheNearestOfAllFaces) {
  const auto waves = [](double x, double y) { return Vec3(x, y, 0.2 * std::sin(9 * x) * y); };
  const Mesh meshes[] = {octahedron(), with_noise(sphere(2), 0.2, 4), torus(24, 9), grid(9, 0.4, waves, no_hole),
                         joined(sphere(1), scaled(sphere(2), 1e-3), 3)};
  uint64_t seed = 1;
  for (const Mesh& mesh : meshes) {
    SCOPED_TRACE(seed);
    expect_nearest(mesh, places_around(mesh, 400, seed++));
  }
}

TEST(ClosestPoint, OfSoupsIsTheNearestOfAllFaces) {
  for (const uint32_t count : {1u, 2u, 5u, 9u, 60u, 400u}) {
    SCOPED_TRACE(count);
    const Mesh mesh = soup(count, count);
    expect_nearest(mesh, places_around(mesh, 400, 90 + count));
  }
}

/// Needles of all widths, as long as the mesh: what is nearest on one is told along its length as well.
TEST(ClosestPoint, OfNeedlesIsTheNearestOfAllFaces) {
  for (int digits = 1; digits < 20; ++digits) {
    SCOPED_TRACE(digits);
    Mesh mesh;
    const double width = std::pow(10.0, -digits);
    for (uint32_t k = 0; k < 5; ++k) {
      const double y = 0.1 * k;
      mesh.face(mesh.add(0, y, 0.3), mesh.add(1, 2 * y, 0), mesh.add(0.3, 1.3 * y + width, 0.21));
    }
    expect_nearest(mesh, places_around(mesh, 300, 40));
  }
}

/// A millimetre ten kilometres from the origin, and other sizes and places: the same places, scaled and moved.
TEST(ClosestPoint, IsTheSameAnywhereAndInAnyUnit) {
  const Mesh mesh = with_noise(sphere(2), 0.2, 4);
  const std::vector<double> points = places_around(mesh, 300, 8);
  const Found found = closest(mesh, points);
  for (const double factor : {0x1p-10, 0x1p-200, 0x1p200, 0x1p-900, 0x1p1000}) {
    SCOPED_TRACE(factor);
    std::vector<double> scaled_points = points;
    for (double& x : scaled_points) x *= factor;
    Found there = closest(moved(mesh, factor, Vec3::Zero()), scaled_points);
    for (double& d : there.distances) d /= factor;
    EXPECT_TRUE(there == found);
  }
  const Mesh far = moved(mesh, 1e-3, Vec3(1e4, 1e4, 0));
  expect_nearest(far, places_around(far, 300, 9));
  const Mesh edge = moved(mesh, 0x1p1023, Vec3::Zero());  // the boxes of which are wider than doubles
  expect_nearest(moved(edge, 0x1p-900, Vec3::Zero()), places_around(moved(edge, 0x1p-900, Vec3::Zero()), 50, 3));
}

TEST(ClosestPoint, OfManyEquallyNearIsTheFirst) {
  Mesh mesh;
  for (uint32_t k = 0; k < 40; ++k) {  // all faces around one vertex, each twice
    const double a = 2 * kPi * (k * 7 % 40) / 40, b = a + 2 * kPi / 40;
    const uint32_t v = mesh.add(0, 0, 1);
    mesh.face(v, mesh.add(std::cos(a), std::sin(a), 0), mesh.add(std::cos(b), std::sin(b), 0));
    mesh.faces.insert(mesh.faces.end(), mesh.faces.end() - 3, mesh.faces.end());
  }
  const Found found = closest(mesh, {0, 0, 1, 0, 0, 2, 0, 0, 1e9});
  EXPECT_EQ(found.faces, (std::vector<uint32_t>{0, 0, 0}));
  EXPECT_EQ(found.distances, (std::vector<double>{0, 1, 1e9 - 1}));
}

/// So far away that squares of lengths are no doubles, and then the distance itself.
TEST(ClosestPoint, IsFoundFromAnyDistance) {
  const Mesh mesh = sphere(2);
  for (const double far : {1e9, 1e30, 1e200, 1.7e308}) {
    const Found found = closest(mesh, {far, 0, 0, 0, -far, 0, 0, 0, far});
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_DOUBLE_EQ(found.distances[i], far - 1);
      Vec3 p = Vec3::Zero();
      for (uint32_t k = 0; k < 3; ++k) p += found.weights[3 * i + k] * mesh.at(mesh.faces[3 * found.faces[i] + k]);
      const Vec3 towards = Vec3::Unit(static_cast<Eigen::Index>(i)) * (i == 1 ? -1 : 1);
      EXPECT_GT(p.dot(towards), 1 - 1e-6);
    }
  }
  const Found corner = closest(mesh, {1.7e308, 1.7e308, -1.7e308});
  EXPECT_EQ(corner.distances[0], std::numeric_limits<double>::infinity());
}

TEST(ClosestPoint, IsTheSameForAnyNumberOfThreads) {
  const Mesh mesh = soup(3000, 5);
  const std::vector<double> points = places_around(mesh, 3000, 6);
  const Found one = closest(mesh, points, 1);
  for (const uint32_t threads : {2u, 3u, 8u, 0u}) EXPECT_TRUE(closest(mesh, points, threads) == one);
}

TEST(ClosestPoint, LeavesOutFacesThatLieNowhere) {
  const Mesh whole = sphere(2);
  Mesh mesh = whole, rest = whole;
  mesh.vertices[3 * 5] = std::numeric_limits<double>::quiet_NaN();
  mesh.vertices[3 * 40 + 1] = std::numeric_limits<double>::infinity();
  rest.faces.clear();
  for (uint32_t f = 0; f < mesh.face_count(); ++f) {
    const uint32_t* face = &mesh.faces[3 * f];
    if (std::none_of(face, face + 3, [](uint32_t v) { return v == 5 || v == 40; })) {
      rest.face(face[0], face[1], face[2]);
    }
  }
  ASSERT_LT(rest.face_count(), mesh.face_count());
  std::vector<double> points = places_around(whole, 200, 2);
  const Vec3 above = 1.5 * whole.at(5);
  points.insert(points.end(), above.begin(), above.end());
  const Found found = closest(mesh, points), of_rest = closest(rest, points);
  EXPECT_EQ(found.distances, of_rest.distances);
  EXPECT_EQ(found.weights, of_rest.weights);
  EXPECT_GT(found.distances.back(), closest(whole, points).distances.back());
}

/// The same as a look at the mesh, where a surface is the mesh as it is, some of its faces turned; and where a part of
/// it is masked, only what is left counts.
TEST(ClosestPoint, OnASurfaceSpeaksOfTheCallersFaces) {
  Mesh mesh = with_noise(sphere(2), 0.1, 4);
  for (uint32_t f = 1; f < mesh.face_count(); f += 3) std::swap(mesh.faces[3 * f], mesh.faces[3 * f + 2]);
  const std::vector<double> points = places_around(mesh, 300, 12);
  const size_t count = points.size() / 3;
  std::vector<uint8_t> mask(mesh.face_count(), 1);
  for (uint32_t f = 0; f < mesh.face_count(); ++f) mask[f] = mesh.at(mesh.faces[3 * f]).x() > 0.2;
  for (const bool masked : {false, true}) {
    auto options = prepared<meander_surface_options>();
    options.face_mask = masked ? mask.data() : nullptr;
    options.face_mask_count = masked ? mask.size() : 0;
    options.split_bow_ties = 1;
    meander_surface* made = nullptr;
    ASSERT_EQ(meander_surface_create(mesh.vertices.data(), mesh.vertex_count(), mesh.faces.data(), mesh.face_count(),
                                     &options, &made, nullptr, nullptr),
              MEANDER_STATUS_OK);
    const SurfaceHandle surface(made);
    Found found{std::vector<uint32_t>(count), std::vector<double>(3 * count), std::vector<double>(count)};
    ASSERT_EQ(meander_surface_find_closest(surface.get(), points.data(), count, 2, found.faces.data(),
                                           found.weights.data(), found.distances.data(), nullptr, nullptr),
              MEANDER_STATUS_OK);
    Mesh left = mesh;
    std::vector<uint32_t> number;
    left.faces.clear();
    for (uint32_t f = 0; f < mesh.face_count(); ++f) {
      if (masked && !mask[f]) continue;
      number.push_back(f);
      left.face(mesh.faces[3 * f], mesh.faces[3 * f + 1], mesh.faces[3 * f + 2]);
    }
    const Found expected = closest(left, points);
    for (size_t i = 0; i < count; ++i) {
      EXPECT_NEAR(found.distances[i], expected.distances[i], kRounding * (2 + expected.distances[i]));
      Vec3 p = Vec3::Zero(), q = Vec3::Zero();
      for (uint32_t k = 0; k < 3; ++k) {
        p += found.weights[3 * i + k] * mesh.at(mesh.faces[3 * found.faces[i] + k]);
        q += expected.weights[3 * i + k] * mesh.at(mesh.faces[3 * number[expected.faces[i]] + k]);
      }
      EXPECT_LT((p - q).norm(), 1e-9) << "point " << i;  // where it is unique, as it is almost everywhere
    }
  }
}

TEST(ClosestPoint, RefusesWhatIsNoPointOrNoMesh) {
  const Mesh mesh = octahedron();
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  auto error = prepared<meander_error>();
  uint32_t face = 77;
  const auto ask = [&](const Mesh& of, std::vector<double> points, uint32_t threads = 1) {
    return meander_mesh_find_closest(of.vertices.data(), of.vertex_count(), of.faces.data(), of.face_count(),
                                     points.data(), points.size() / 3, threads, &face, nullptr, nullptr, nullptr,
                                     &error);
  };
  for (const double bad : {nan, inf, -inf}) {
    EXPECT_EQ(ask(mesh, {0, 0, 0, 1, bad, 0}), MEANDER_STATUS_INVALID_ARGUMENT);
    EXPECT_STREQ(error.text, "Point 1 has a coordinate that is not a finite number; leave it out.");
  }
  EXPECT_EQ(ask(mesh, {0, 0, 0}, 257), MEANDER_STATUS_INVALID_ARGUMENT);
  Mesh nothing = mesh, beyond = mesh, nowhere = mesh;
  nothing.faces.clear();
  beyond.faces[4] = 6;
  std::ranges::fill(nowhere.vertices, nan);
  for (const Mesh& bad : {nothing, beyond, nowhere}) EXPECT_EQ(ask(bad, {0, 0, 0}), MEANDER_STATUS_INVALID_MESH);
  EXPECT_EQ(meander_mesh_find_closest(nullptr, 1, nullptr, 1, nullptr, 0, 1, nullptr, nullptr, nullptr, nullptr,
                                      &error),
            MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(meander_surface_find_closest(nullptr, nullptr, 0, 1, nullptr, nullptr, nullptr, nullptr, &error),
            MEANDER_STATUS_INVALID_ARGUMENT);
  EXPECT_EQ(face, 77u);
  EXPECT_EQ(ask(mesh, {}), MEANDER_STATUS_OK);
}

}  // namespace
}  // namespace meander::test::closest_point_tests
