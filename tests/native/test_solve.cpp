// SPDX-License-Identifier: GPL-3.0-or-later
//
// The banded solve in parallel frames against the paper's formulation with 3 n unknowns in space.
#include <gtest/gtest.h>

#include "strand_model.h"

namespace meander::test::solve_tests {
namespace {

/// Both sides round in units of 2^-53, magnified by the condition of the system: the stiffest term
/// (bending, up to 1 / l^3) against the softest (the medial one).
constexpr double kAgreement = 1e-9;

struct Range {
  double low, high, bending;
  double alignment = 0, length_power = 2, medial_power = 2;
  bool medial_blocks = false;
};
constexpr Range kRanges[] = {
    {1, 1, 0},
    {0, 0, 1},
    {0.2, 2, 0.5},
    {-1, 3, 0.6},
    {-1, 0.1, 0},
    {-1, 3, 0.6, 0, 2, 4},           // as in the polish
    {0, 1, 0.5, 1},                  // field
    {1, 1, 0, 3},                    //
    {0.2, 2, 0.5, 0, 3},             // powers
    {-1, 3, 0, 0, 1.2},              //
    {1, 1, 0.5, 0, 2, 6, true},      //
    {0, 1, 0, 0, 2, 1.5, true},      //
    {-1, 2, 0.5, 2, 4, 3, true}};    // all at once

struct Scene {
  explicit Scene(const Mesh& mesh) : surface(make_surface(mesh)) {}

  /// Random weights within a range.
  void fill(Rng& rng, const Range& range, double fixed_share) {
    const auto& [low, high, bending, alignment, p, q, blocks] = range;
    const uint32_t n = curve.size();
    weights.length_power = p;
    weights.medial_power = q;
    weights.medial_blocks = blocks;
    weights.alignment.resize(alignment > 0 ? n : 0);
    weights.field.resize(alignment > 0 ? n : 0);
    for (uint32_t i = 0; i < n && alignment > 0; ++i) {
      weights.alignment[i] = alignment * rng.in(0.1, 1);
      weights.field[i] = rng() * rng.direction();
    }
    metric.radius.resize(n);
    radii.resize(n);
    weights.length.resize(n);
    weights.bending.resize(n);
    weights.medial = rng.in(0.3, 2);
    for (uint32_t i = 0; i < n; ++i) {
      const double r = metric.radius[i] = rng.in(0.05, 0.1);
      radii[i] = {r * rng.in(0.2, 3), r * rng.in(0.2, 3)};
      weights.length[i] = rng.in(low, high);
      weights.bending[i] = bending * rng.in(0.1, 1);
      curve.fixed[i] = rng() < fixed_share;
    }
    ThreadPool pool(1);
    compute_frames(surface, curve, metric, RadiusField(metric.radius[0]), pool, frames);
  }

  /// Steps of all nodes in space, by the library.
  Eigen::VectorXd banded_step(unsigned threads = 1, size_t least_chunk = kLeastChunk) const {
    Eigen::VectorXd d(3 * curve.size());
    ThreadPool pool(threads);
    for (const Strand& strand : curve.strands) {
      StrandSystem system;
      assemble(curve, strand, frames, radii, metric, weights, pool, system);
      const Table<Vec2> z = solve(system, pool, least_chunk);
      for (uint32_t k = 0; k < strand.count; ++k) {
        const uint32_t i = strand.first + k;
        d.segment<3>(3 * i) = surface.to_space(curve.nodes[i].face, system.frame[k] * z[k]);
      }
    }
    return d;
  }

  LiteralModel literal() const {
    return LiteralModel(surface, curve, radii, frames, metric, weights);
  }

  Surface surface;
  Curve curve;
  Frames frames;
  NodeData<Radii> radii;
  LocalMetric metric;
  Weights weights;
};

std::vector<Mesh> curved_meshes() {
  return {sphere(3),       torus(20, 10),          bumpy_grid(14),
          cone(9, 4, 1.5), cone(12, 4, 0.7, true), flat_grid(6)};
}

void compare(Scene& scene, Rng& rng) {
  for (const Range& range : kRanges) {
    for (const double fixed_share : {0.0, 0.2}) {
      scene.fill(rng, range, fixed_share);
      const Eigen::VectorXd expected = scene.literal().dense_step(scene.curve.fixed);
      const Eigen::VectorXd step = scene.banded_step();
      ASSERT_TRUE(step.allFinite());
      EXPECT_LE((step - expected).norm(), kAgreement * expected.norm())
          << "n = " << scene.curve.size() << ", length weight from " << range.low << " to "
          << range.high << ", bending " << range.bending << ", alignment " << range.alignment
          << ", powers " << range.length_power << " " << range.medial_power << ", fixed "
          << fixed_share;
      for (uint32_t i = 0; i < scene.curve.size(); ++i) {
        if (scene.curve.fixed[i]) {
          EXPECT_EQ(step.segment<3>(3 * i).norm(), 0);
        }
        // The omitted steps along the normals are zero in the full system too.
        const Vec3 normal = scene.surface.face_normal(scene.curve.nodes[i].face);
        EXPECT_LE(std::abs(normal.dot(expected.segment<3>(3 * i))), kAgreement * expected.norm());
      }
    }
  }
}

TEST(Step, OfOpenStrandsEqualsTheLiteralModel) {
  Rng rng(41);
  for (const Mesh& mesh : curved_meshes()) {
    for (const uint32_t n : {2u, 3u, 4u, 5u, 6u, 7u, 50u}) {
      Scene scene(mesh);
      add_walk(scene.surface, scene.curve, random_point(scene.surface, rng), 0.03, n, 0.8, rng);
      compare(scene, rng);
    }
  }
}

TEST(Step, OfClosedStrandsEqualsTheLiteralModel) {
  Rng rng(42);
  for (const Mesh& mesh : curved_meshes()) {
    for (const uint32_t n : {3u, 4u, 5u, 6u, 7u, 8u, 50u}) {
      Scene scene(mesh);
      while (!add_ring(scene.surface, scene.curve, random_point(scene.surface, rng), 0.08, n, 0.2,
                       rng)) {
      }
      compare(scene, rng);
    }
  }
}

/// Once around the apex of a cone, a frame comes back rotated by the apex's angle defect.
TEST(Step, OfALoopRoundAConeHasItsHolonomy) {
  Rng rng(43);
  for (const double slope : {0.5, 1.5, 4.0}) {
    for (const uint32_t n : {3u, 4u, 5u, 6u, 7u, 20u}) {
      Scene scene(cone(9, 3, slope));
      const uint32_t around = 9;
      // Nodes around it, in the faces at the apex, joined across its edges.
      for (uint32_t k = 0; k < n; ++k) {
        const double at = around * (k + 0.5) / n;
        const uint32_t sector = static_cast<uint32_t>(at);
        for (uint32_t f = 0; f < scene.surface.face_count(); ++f) {
          const Triangle& t = scene.surface.face(f);
          if (t[0] != 0 || t[1] != 1 + sector) continue;
          const double share = 0.1 + 0.8 * (at - sector);
          add_node(scene.curve, make_point(f, 0.4, 0.6 * (1 - share), 0.6 * share));
        }
      }
      ASSERT_EQ(scene.curve.size(), n);
      scene.curve.strands.push_back({0, n, true});
      scene.curve.link();
      PathShortener shortener(scene.surface);
      for (uint32_t k = 0; k < n; ++k) {
        const SurfacePoint &from = scene.curve.nodes[k], &to = scene.curve.nodes[(k + 1) % n];
        Path& path = scene.curve.paths[k];
        for (uint32_t f = from.face; f != to.face;) {
          const HalfEdge e = 3 * f + 2;  // towards the apex: counter-clockwise around it
          path.push_back(crossing_of(scene.surface, e, 0.5));
          f = face_of(scene.surface.twin(e));
        }
        scene.curve.shapes[k] = shortener.shorten(from, to, path);
      }
      ASSERT_TRUE(whole(scene.surface, scene.curve));
      scene.fill(rng, {0.2, 1, 0.5}, 0);
      StrandSystem system;
      ThreadPool pool(1);
      assemble(scene.curve, scene.curve.strands[0], scene.frames, scene.radii, scene.metric,
               scene.weights, pool, system);
      const double angle = std::atan2(system.holonomy.y, system.holonomy.x);
      const double missing = 2 * kPi - scene.surface.total_angle(0);
      constexpr double kRounding = 1e-6;  // the cone's own faces are flat to 2^-30 only
      EXPECT_NEAR(
          std::remainder(std::abs(angle) - std::abs(std::remainder(missing, 2 * kPi)), 2 * kPi), 0,
          kRounding);
      compare(scene, rng);
    }
  }
}

/// Chunks of every length, down to the shortest, whose ends are coupled.
TEST(Step, OfStrandsInChunksEqualsTheLiteralModel) {
  Rng rng(46);
  for (const Mesh& mesh : curved_meshes()) {
    Scene scene(mesh);
    add_walk(scene.surface, scene.curve, random_point(scene.surface, rng), 0.03, 41, 0.8, rng);
    while (!add_ring(scene.surface, scene.curve, random_point(scene.surface, rng), 0.08, 37, 0.2, rng)) {
    }
    for (const Range& range : kRanges) {
      scene.fill(rng, range, 0.1);
      const Eigen::VectorXd expected = scene.literal().dense_step(scene.curve.fixed);
      for (const size_t chunk : {0, 4, 5, 6, 7, 9, 12, 18, 20}) {
        const Eigen::VectorXd step = scene.banded_step(1, chunk);
        EXPECT_LE((step - expected).norm(), kAgreement * expected.norm()) << "chunks of " << chunk;
        EXPECT_EQ(step, scene.banded_step(2, chunk)) << "chunks of " << chunk;
      }
    }
  }
}

/// Dense algebra would take too long: H d + g must vanish.
TEST(Step, OfLongStrandsLeavesNoResidual) {
  Rng rng(44);
  for (const Mesh& mesh : {sphere(3), torus(20, 10)}) {
    Scene scene(mesh);
    const uint32_t nodes = mesh.vertex_count() > 300 ? 2 * kLeastChunk + 500 : 500;
    add_walk(scene.surface, scene.curve, random_point(scene.surface, rng), 0.02, nodes, 0.8, rng);
    add_ring(scene.surface, scene.curve, random_point(scene.surface, rng), 0.2, 400, 0.02, rng);
    add_ring(scene.surface, scene.curve, random_point(scene.surface, rng), 0.3, 250, 0.02, rng);
    for (const Range& range : kRanges) {
      scene.fill(rng, range, 0.01);
      const Eigen::VectorXd step = scene.banded_step();
      EXPECT_EQ(step, scene.banded_step(2));
      Eigen::VectorXd magnitude;
      const Eigen::VectorXd residual = scene.literal().gradient(step, &magnitude);
      for (uint32_t i = 0; i < scene.curve.size(); ++i) {
        if (scene.curve.fixed[i]) continue;
        EXPECT_NEAR(residual.segment<3>(3 * i).norm(), 0,
                    kAgreement * magnitude.segment<3>(3 * i).norm());
      }
    }
  }
}

TEST(Step, GoesDownhillWhereNoWeightIsNegative) {
  Rng rng(45);
  for (const Mesh& mesh : curved_meshes()) {
    Scene scene(mesh);
    add_walk(scene.surface, scene.curve, random_point(scene.surface, rng), 0.03, 30, 0.8, rng);
    scene.fill(rng, {0.1, 2, 1}, 0);
    const LiteralModel model = scene.literal();
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(3 * 30), step = scene.banded_step();
    EXPECT_LT(model.energy(step), model.energy(zero));
    // It is the minimum.
    for (int k = 0; k < 20; ++k) {
      Eigen::VectorXd other = step;
      for (double& x : other) x += 1e-3 * rng.in(-1, 1);
      EXPECT_LE(model.energy(step), model.energy(other) * (1 + kAgreement));
    }
  }
}

}  // namespace
}  // namespace meander::test::solve_tests
