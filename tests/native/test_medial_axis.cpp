// SPDX-License-Identifier: GPL-3.0-or-later
//
// Medial radii against the smallest tangent ball over all points, and the two rules at the
// boundary.
#include <gtest/gtest.h>

#include <span>

#include "medial/medial_axis.h"
#include "curves.h"

namespace meander::test::medial_axis_tests {
namespace {

/// The library calls a ball empty when no point is closer to its centre than (1 - 1e-9) radii. By
/// |q - x|^2 = 2 rho (q - x).B that lets its radius R exceed the smallest, rho, by at most this
/// share of R^2 / ((q - x).B): much for points almost beside the node, 1e-9 for those ahead.
constexpr double kEmpty = 1.1e-9;

struct Smallest {
  double radius;
  double ahead;  // (q - x).B of the point that limits it, infinite if none does
};

Smallest brute_force(std::span<const Vec3> points, const Vec3& x, const Vec3& b, double most) {
  Smallest best{most, std::numeric_limits<double>::infinity()};
  for (const Vec3& q : points) {
    const Vec3 u = q - x;
    const double ahead = u.dot(b);
    if (!(ahead > 0)) continue;
    const double radius = u.squaredNorm() / (2 * ahead);
    if (radius < best.radius) best = {radius, ahead};
  }
  return best;
}

struct Scene {
  explicit Scene(const Mesh& mesh) : surface(make_surface(mesh)), boundary(surface, 0.01) {}

  void compute(BoundaryRule rule, double most, NodeData<Radii>& radii, unsigned threads = 2) {
    ThreadPool pool(threads);
    metric = even_metric(curve, 0.05, most);
    compute_frames(surface, curve, metric, RadiusField(0.05), pool, frames);
    NodeData<Reach> reach;
    compute_reach({surface, curve, frames, boundary, rule, nullptr, metric}, {}, pool, reach);
    CurveBvh tree;
    compute_medial_axis(frames, boundary, rule, reach, pool, tree, radii);
  }

  Surface surface;
  BoundaryObstacle boundary;
  Curve curve;
  Frames frames;
  LocalMetric metric;
};

TEST(MedialAxis, EqualsBruteForceFromAnyStart) {
  for (const Mesh& mesh : {sphere(3), torus(20, 10), cube(), with_noise(sphere(2), 0.3, 5),
                           joined(sphere(1), cube(), 3)}) {
    Scene scene(mesh);
    Rng rng(31);
    for (int k = 0; k < 6; ++k) {
      add_walk(scene.surface, scene.curve, random_point(scene.surface, rng), 0.02, 40, 0.5, rng);
      add_ring(scene.surface, scene.curve, random_point(scene.surface, rng), 0.08, 20, 0.2, rng);
    }
    const uint32_t n = scene.curve.size();
    for (const double most : {0.03, 0.15, 2.0}) {
      NodeData<Radii> cold;
      scene.compute(BoundaryRule::kCentre, most, cold);
      std::vector<NodeData<Radii>> warm(4, cold);
      for (Radii& r : warm[0]) r = {rng.in(0, 2 * most), rng.in(0, 2 * most)};
      for (Radii& r : warm[1]) r = {1e-6 * most, 1e-3 * most};
      for (Radii& r : warm[2]) r = {0.999 * r[0], 1.001 * r[1]};
      for (Radii& r : warm[3]) r = {10 * most, most};
      for (NodeData<Radii>& r : warm) scene.compute(BoundaryRule::kCentre, most, r);
      NodeData<Radii> one;
      scene.compute(BoundaryRule::kCentre, most, one, 1);
      EXPECT_EQ(one, cold);
      for (uint32_t i = 0; i < n; ++i) {
        for (int side = 0; side < 2; ++side) {
          const Vec3& b = scene.frames.outward[i][side];
          const Smallest best =
              brute_force(scene.frames.position.values(), scene.frames.position[i], b, most);
          const auto check = [&](const Radii& r) {
            EXPECT_LE(r[side], most);
            EXPECT_GE(r[side], best.radius * (1 - kEmpty));
            EXPECT_LE(r[side], best.radius * (1 + kEmpty) + kEmpty * r[side] * r[side] / best.ahead)
                << "node " << i << " most " << most;
          };
          check(cold[i]);
          for (const NodeData<Radii>& r : warm) check(r[i]);
        }
      }
    }
  }
}

/// Where nothing is left of a ball, as of one that would begin beyond the boundary, it is a point.
TEST(MedialAxis, ABallWithoutReachIsAPoint) {
  Scene scene(sphere(2));
  Rng rng(33);
  add_ring(scene.surface, scene.curve, random_point(scene.surface, rng), 0.1, 30, 0.2, rng);
  NodeData<Radii> all, radii;
  scene.compute(BoundaryRule::kCentre, 0.15, all);
  ThreadPool pool(1);
  CurveBvh tree;
  NodeData<Reach> reach;
  compute_reach(
      {scene.surface, scene.curve, scene.frames, scene.boundary, BoundaryRule::kCentre, nullptr, scene.metric}, {},
      pool, reach);
  for (uint32_t i = 0; i < scene.curve.size(); i += 3) reach[i][i % 2].radius = i % 4 < 2 ? 0 : -0.01;
  for (int pass = 0; pass < 2; ++pass) {  // from nothing, and from what the last one found
    compute_medial_axis(scene.frames, scene.boundary, BoundaryRule::kCentre, reach, pool, tree, radii);
    for (uint32_t i = 0; i < scene.curve.size(); ++i) {
      for (uint32_t side = 0; side < 2; ++side) {
        EXPECT_EQ(radii[i][side], i % 3 == 0 && side == i % 2 ? 0 : all[i][side]) << "node " << i;
      }
    }
  }
}

TEST(MedialAxis, FramesAreOrthogonalAndBisect) {
  constexpr double kRounding = 1e-12;
  Scene scene(with_noise(sphere(3), 0.3, 9));
  Rng rng(32);
  add_ring(scene.surface, scene.curve, random_point(scene.surface, rng), 0.1, 30, 0.2, rng);
  add_walk(scene.surface, scene.curve, random_point(scene.surface, rng), 0.02, 40, 0.5, rng);
  NodeData<Radii> radii;
  scene.compute(BoundaryRule::kCentre, 0.15, radii);
  const Frames& f = scene.frames;
  for (uint32_t i = 0; i < scene.curve.size(); ++i) {
    const uint32_t before = scene.curve.previous(i);
    EXPECT_NEAR(norm(f.tangent[i]), 1, kRounding);
    EXPECT_NEAR(norm(f.bitangent2[i] - Vec2{0, -1} * f.tangent[i]), 0, kRounding);
    for (int side = 0; side < 2; ++side) {
      EXPECT_NEAR(f.outward[i][side].norm(), 1, kRounding);
      EXPECT_LT(f.to_boundary[i][side], 0) << "there is no boundary";
      if (before == kNone || !scene.curve.has_segment(i)) continue;
      // Normal to the curve in space, whose tangent is the mean of the chords' directions.
      const Vec3 x = f.position[i], last = f.position[before],
                 next = f.position[scene.curve.next(i)];
      const Vec3 tangent = (x - last).normalized() + (next - x).normalized();
      EXPECT_NEAR(f.outward[i][side].dot(tangent), 0, kRounding);
    }
    EXPECT_EQ((f.position[i] - position(scene.surface, scene.curve.nodes[i])).norm(), 0);
    if (before == kNone || !scene.curve.has_segment(i)) continue;
    const Vec2 in = scene.curve.shapes[before].arriving, out = scene.curve.shapes[i].leaving;
    EXPECT_NEAR(cross(in, f.tangent[i]), cross(f.tangent[i], out), kRounding);
  }
}

/// A short straight strand along x through the middle of the unit square, `below` above its lower
/// side.
void lay_strand(Scene& scene, double below) {
  const Surface& s = scene.surface;
  // Weights of the corners of face f at a point of the square's plane.
  const auto weights = [&](uint32_t f, double x, double y) {
    const Triangle& t = s.face(f);
    const Vec3 a = s.caller_position(t[0]), b = s.caller_position(t[1]),
               c = s.caller_position(t[2]);
    const Vec2 u{b.x() - a.x(), b.y() - a.y()}, v{c.x() - a.x(), c.y() - a.y()},
        p{x - a.x(), y - a.y()};
    return Vec2{cross(p, v) / cross(u, v), cross(u, p) / cross(u, v)};
  };
  uint32_t f = 0;
  Vec2 w = weights(f, 0.5, below);
  while (!(w.x >= 0 && w.y >= 0 && w.x + w.y <= 1)) {
    ASSERT_LT(++f, s.face_count()) << "the point is outside of the square";
    w = weights(f, 0.5, below);
  }
  const SurfacePoint from = make_point(f, 1 - w.x - w.y, w.x, w.y);
  const Vec2 step = weights(f, 0.6, below) - w;
  const Vec2 along = unit(step.x * s.corner(f, 1) + step.y * s.corner(f, 2));
  Path path;
  const Trace trace = trace_geodesic(s, from, 0.02 * along, path);
  add_node(scene.curve, from);
  add_node(scene.curve, trace.end);
  scene.curve.strands.push_back({0, 2, false});
  scene.curve.link();
  scene.curve.paths[0] = path;
  scene.curve.shapes[0] = measure_path(s, from, trace.end, path);
}

TEST(Boundary, ABallsCentreStopsThere) {
  // The vertices are rounded to 2^-30 of the square.
  constexpr double kGridRounding = 64 * 0x1p-30;
  for (const uint32_t cells : {1u, 2u, 9u}) {
    for (const double below : {0.05, 0.21, 0.4}) {
      Scene scene(flat_grid(cells, 0));
      lay_strand(scene, below);
      NodeData<Radii> radii;
      const double most = 0.5;
      scene.compute(BoundaryRule::kCentre, most, radii);
      for (uint32_t i = 0; i < 2; ++i) {
        // The bitangent is on the right: below a strand that runs along x.
        EXPECT_NEAR(radii[i][0], below / scene.surface.scale(), kGridRounding);
        EXPECT_NEAR(radii[i][1], std::min(most, (1 - below) / scene.surface.scale()),
                    kGridRounding);
      }
    }
  }
}

TEST(Boundary, ABallTouchesItAsAnObstacleAndDoesNotLeakThroughLongEdges) {
  constexpr double kGridRounding = 64 * 0x1p-30;
  for (const uint32_t cells : {1u, 2u, 9u}) {
    for (const double below : {0.05, 0.21, 0.4}) {
      Scene scene(flat_grid(cells, 0));
      lay_strand(scene, below);
      NodeData<Radii> radii;
      scene.compute(BoundaryRule::kObstacle, 0.5, radii);
      constexpr double kStep = 0.01;  // of the samples, as Scene asks for
      for (uint32_t i = 0; i < 2; ++i) {
        const double d = below / scene.surface.scale();
        EXPECT_GE(radii[i][0], d / 2 - kGridRounding);
        // The sample nearest to the touching point is at most half a step from it.
        EXPECT_LE(radii[i][0], d / 2 + kStep * kStep / (8 * d) + kGridRounding);
      }
    }
  }
}

TEST(Boundary, SamplesAreAlongEveryEdge) {
  const Surface s = make_surface(grid_with_hole(6));
  constexpr double kStep = 0.013;
  const BoundaryObstacle boundary(s, kStep);
  Rng rng(33);
  for (const HalfEdge e : s.boundary()) {
    for (int k = 0; k < 20; ++k) {
      const Vec3 p = position(s, crossing_of(s, e, rng()));
      const auto near = boundary.tree().nearest(p);
      ASSERT_TRUE(near.has_value());
      EXPECT_LE(std::sqrt(near->squared_distance), kStep / 2 * (1 + 1e-9));
    }
  }
  EXPECT_TRUE(BoundaryObstacle(make_surface(sphere(1)), kStep).empty());
}

}  // namespace
}  // namespace meander::test::medial_axis_tests
