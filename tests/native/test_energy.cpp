// SPDX-License-Identifier: GPL-3.0-or-later
//
// The figure "energy" against the literal squares of the model, and the model's gradient against
// differences of its energy.
#include <gtest/gtest.h>

#include "strand_model.h"

namespace meander::test {
namespace {

constexpr double kRounding = 1e-11;  // relative, of sums of some hundred terms

struct Scene {
  Scene(const Mesh& mesh, uint64_t seed) : surface(make_surface(mesh)), rng(seed) {
    add_walk(surface, curve, random_point(surface, rng), 0.03, 25, 0.8, rng);
    add_ring(surface, curve, random_point(surface, rng), 0.06, 15, 0.2, rng);
    for (uint32_t i = 0; i < curve.size(); ++i) {
      radius.push_back(rng.in(0.05, 0.1));
      radii.push_back({radius[i] * rng.in(0.2, 3), radius[i] * rng.in(0.2, 3)});
      weights.length.push_back(rng.in(-1, 2));
      weights.bending.push_back(rng());
    }
    weights.medial = 0.7;
    Team team(1);
    compute_frames(surface, curve, radius, std::vector<double>(surface.vertex_count(), radius[0]), team, frames);
  }

  Surface surface;
  Rng rng;
  Curve curve;
  Frames frames;
  std::vector<Radii> radii;
  std::vector<double> radius;
  Weights weights;
};

std::vector<Mesh> meshes() { return {sphere(2), torus(20, 10), with_noise(sphere(2), 0.2, 4)}; }

TEST(Energy, IsTheModelWhereNothingMoves) {
  for (const Mesh& mesh : meshes()) {
    const Scene s(mesh, 51);
    const LiteralModel model(s.surface, s.curve, s.radii, s.frames, s.radius, s.weights);
    const double expected = model.energy(Eigen::VectorXd::Zero(3 * s.curve.size()));
    EXPECT_NEAR(energy(s.curve, s.radii, s.radius, s.weights), expected,
                kRounding * std::abs(expected));
  }
}

TEST(Energy, OfLengthAloneIsTheLength) {
  for (const Mesh& mesh : meshes()) {
    Scene s(mesh, 52);
    s.weights.length.assign(s.curve.size(), 1);
    s.weights.bending.assign(s.curve.size(), 0);
    s.radii.assign(s.curve.size(), Radii{0, 0});
    EXPECT_NEAR(energy(s.curve, s.radii, s.radius, s.weights), s.curve.length(),
                kRounding * s.curve.length());
  }
}

/// The right-hand side of the library's system is minus the derivative of the energy, along any
/// way.
TEST(Energy, DerivativeIsTheSystemsRightHandSide) {
  // The model is quadratic, so central differences are exact but for rounding.
  constexpr double kStep = 1e-3, kDifference = 1e-8;
  for (const Mesh& mesh : meshes()) {
    Scene s(mesh, 53);
    const LiteralModel model(s.surface, s.curve, s.radii, s.frames, s.radius, s.weights);
    for (const Strand& strand : s.curve.strands) {
      StrandSystem system;
      assemble(s.curve, strand, s.frames, s.radii, s.radius, s.weights, system);
      for (uint32_t k = 0; k < strand.count; ++k) {
        const uint32_t i = strand.first + k;
        const Vec2 way = s.rng.direction();
        Eigen::VectorXd d = Eigen::VectorXd::Zero(3 * s.curve.size());
        d.segment<3>(3 * i) =
            kStep * s.surface.to_space(s.curve.nodes[i].face, system.frame[k] * way);
        const double slope = (model.energy(d) - model.energy(-d)) / (2 * kStep);
        EXPECT_NEAR(-dot(system.right[k], way), slope, kDifference * (1 + std::abs(slope)));
      }
    }
  }
}

}  // namespace
}  // namespace meander::test
