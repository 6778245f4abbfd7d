// SPDX-License-Identifier: GPL-3.0-or-later
//
// The figure "energy" against the literal squares of the model, and the model's gradient against
// differences of its energy.
#include <gtest/gtest.h>

#include "strand_model.h"

namespace meander::test::energy_tests {
namespace {

constexpr double kRounding = 1e-11;  // relative, of sums of some hundred terms

struct Scene {
  Scene(const Mesh& mesh, uint64_t seed) : surface(make_surface(mesh)), rng(seed) {
    add_walk(surface, curve, random_point(surface, rng), 0.03, 25, 0.8, rng);
    add_ring(surface, curve, random_point(surface, rng), 0.06, 15, 0.2, rng);
    radii.resize(curve.size());
    for (NodeData<double>* values : {&metric.radius, &weights.length, &weights.bending}) values->resize(curve.size());
    for (uint32_t i = 0; i < curve.size(); ++i) {
      const double r = metric.radius[i] = rng.in(0.05, 0.1);
      radii[i] = {r * rng.in(0.2, 3), r * rng.in(0.2, 3)};
      weights.length[i] = rng.in(-1, 2);
      weights.bending[i] = rng();
    }
    weights.medial = 0.7;
    compute_frames(surface, curve, metric, RadiusField(metric.radius[0]), pool, frames);
  }

  void align() {
    weights.alignment.resize(curve.size());
    weights.field.resize(curve.size());
    for (uint32_t i = 0; i < curve.size(); ++i) {
      weights.alignment[i] = rng.in(0, 2);
      weights.field[i] = rng() * rng.direction();
    }
  }

  Surface surface;
  Rng rng;
  mutable ThreadPool pool{1};
  Curve curve;
  Frames frames;
  NodeData<Radii> radii;
  LocalMetric metric;
  Weights weights;
};

std::vector<Mesh> meshes() { return {sphere(2), torus(20, 10), with_noise(sphere(2), 0.2, 4)}; }

void expect_energy_of_model(const Scene& s) {
  const LiteralModel model(s.surface, s.curve, s.radii, s.frames, s.metric, s.weights);
  const double expected = model.energy(Eigen::VectorXd::Zero(3 * s.curve.size()));
  EXPECT_NEAR(energy(s.curve, s.radii, s.metric, s.weights, s.pool), expected, kRounding * std::abs(expected));
}

TEST(Energy, IsTheModelWhereNothingMoves) {
  for (const Mesh& mesh : meshes()) expect_energy_of_model(Scene(mesh, 51));
}

TEST(Energy, OfTheFieldIsTheModelsWhereNothingMoves) {
  for (const Mesh& mesh : meshes()) {
    Scene s(mesh, 54);
    s.align();
    expect_energy_of_model(s);
  }
}

/// Eq. 13 as written, in units that make it t L for p = 2, with the end of one segment moved.
double length_weight(const Scene& s, uint32_t segment) {
  return 0.5 * (s.weights.length[segment] + s.weights.length[s.curve.next(segment)]);
}

/// The literal energy of all terms that contain node k of a strand, moved by z in its frame.
double literal_energy(const Scene& s, const Strand& strand, const StrandSystem& system, uint32_t k, Vec2 z) {
  const double p = s.weights.length_power, q = s.weights.medial_power;
  const uint32_t i = strand.first + k, before = s.curve.previous(i);
  const double r = s.metric.radius[i];
  double sum = 0, w = 0;
  const auto length = [&](uint32_t segment, Vec2 moved) {
    const double l = s.curve.shapes[segment].length;
    w += 0.5 * l;
    const double c = LiteralModel::stretch(s.curve, segment, s.metric.radius, p);
    sum += length_weight(s, segment) * 2 / p * c * l * std::pow(norm(moved) / l, p);
  };
  const Vec2 flat = system.frame[k] * z;
  if (s.curve.has_segment(i)) length(i, s.curve.shapes[i].length * s.curve.shapes[i].leaving - flat);
  if (before != kNone) length(before, s.curve.shapes[before].length * s.curve.shapes[before].arriving + flat);
  const double alpha = s.weights.medial * 2 * std::sqrt(2.0) / (r * r);
  for (int side = 0; side < 2; ++side) {
    const Vec2 centre = (side == 0 ? 1 : -1) * s.radii[i][side] * s.frames.bitangent2[i];
    sum += alpha * w * r * r * 2 / q * std::pow(norm(flat - centre) / r, q);
  }
  return sum;
}

/// What the nodes of a strand add to the energy where nothing moves.
double energy_at_rest(const Scene& s, const Strand& strand) {
  const double p = s.weights.length_power, q = s.weights.medial_power;
  double sum = 0;
  for (uint32_t k = 0; k < strand.count; ++k) {
    const uint32_t i = strand.first + k, before = s.curve.previous(i);
    const double l = s.curve.has_segment(i) ? s.curve.shapes[i].length : 0;
    const double w = 0.5 * (l + (before != kNone ? s.curve.shapes[before].length : 0));
    if (l > 0)
      sum += length_weight(s, i) * 2 / p * LiteralModel::stretch(s.curve, i, s.metric.radius, p) * l;
    for (const double radius : s.radii[i])
      sum += s.weights.medial * 2 * std::sqrt(2.0) * w * 2 / q * std::pow(radius / s.metric.radius[i], q);
  }
  return sum;
}

/// The system of a strand against differences of the literal energy, in one direction for every node.
void expect_slope_and_curvature(Scene& s, const Strand& strand) {
  // Differences of a smooth function: an error of second order in the step, and rounding over its square.
  constexpr double kStep = 1e-4, kDifference = 1e-4;
  StrandSystem system;
  assemble(s.curve, strand, s.frames, s.radii, s.metric, s.weights, s.pool, system);
  for (uint32_t k = 0; k < strand.count; ++k) {
    const Vec2 direction = s.rng.direction();
    const double step = kStep * s.metric.radius[strand.first + k] * 0.1;
    const double ahead = literal_energy(s, strand, system, k, step * direction);
    const double behind = literal_energy(s, strand, system, k, -step * direction);
    const double here = literal_energy(s, strand, system, k, {});
    const double slope = (ahead - behind) / (2 * step);
    EXPECT_NEAR(-dot(system.right[k], direction), slope, kDifference * (1 + std::abs(slope)));
    const Sym2& m = system.diagonal_block[k];
    const double curvature = system.diagonal[k] + m.xx * direction.x * direction.x +
                             2 * m.xy * direction.x * direction.y + m.yy * direction.y * direction.y;
    EXPECT_NEAR(curvature, (ahead + behind - 2 * here) / (step * step), 3e-3 * std::abs(curvature));
  }
}

/// A place that a node is to have across the field pulls it there, with a Hessian that leads there in one step.
TEST(Energy, OfPlacesIsASquareAcrossTheField) {
  for (const Mesh& mesh : meshes()) {
    Scene s(mesh, 58);
    s.align();
    const double without = energy(s.curve, s.radii, s.metric, s.weights, s.pool);
    const Strand& strand = s.curve.strands[0];
    StrandSystem free, held;
    assemble(s.curve, strand, s.frames, s.radii, s.metric, s.weights, s.pool, free);
    s.weights.hold.resize(s.curve.size());
    s.weights.to_place.resize(s.curve.size());
    double sum = 0;
    for (uint32_t i = 0; i < s.curve.size(); ++i) {
      const Vec2 line = s.weights.field[i];
      const double r = s.metric.radius[i], way = r * s.rng.in(-1, 1);
      s.weights.hold[i] = s.rng.in(0.5, 3);
      s.weights.to_place[i] = way * unit(Vec2{-line.y, line.x});
      const uint32_t before = s.curve.previous(i);
      const double w = 0.5 * ((s.curve.has_segment(i) ? s.curve.shapes[i].length : 0) +
                              (before != kNone ? s.curve.shapes[before].length : 0));
      sum += s.weights.hold[i] * w * way * way / (r * r);
    }
    EXPECT_NEAR(energy(s.curve, s.radii, s.metric, s.weights, s.pool) - without, sum, 1e-9 * sum);
    assemble(s.curve, strand, s.frames, s.radii, s.metric, s.weights, s.pool, held);
    for (uint32_t k = 0; k < strand.count; ++k) {
      const Vec2 d = s.weights.to_place[strand.first + k] * conj(held.frame[k]);
      const Sym2 &with = held.diagonal_block[k], &other = free.diagonal_block[k];
      const double xx = with.xx - other.xx, xy = with.xy - other.xy, yy = with.yy - other.yy;
      const Vec2 pull = held.right[k] - free.right[k];
      const double rounding = 1e-9 * (1 + norm(held.right[k]));
      EXPECT_NEAR(xx * d.x + xy * d.y, pull.x, rounding);
      EXPECT_NEAR(xy * d.x + yy * d.y, pull.y, rounding);
      EXPECT_NEAR(xx * yy, xy * xy, 1e-9 * (xx + yy) * (xx + yy));  // nothing along the field
      EXPECT_GT(dot(pull, d), 0);
    }
  }
}

TEST(Energy, OfPowersHasTheSystemsSlopeAndCurvature) {
  for (const Mesh& mesh : meshes()) {
    for (const double p : {1.0, 1.5, 3.0, 6.0}) {
      for (const double q : {1.5, 2.0, 3.0, 6.0, 8.0}) {
        Scene s(mesh, 55);
        const uint32_t n = s.curve.size();
        s.weights.length.assign(n, 0.7);
        s.weights.bending.assign(n, 0);
        s.weights.length_power = p;
        s.weights.medial_power = q;
        s.weights.medial_blocks = true;
        double at_rest = 0;
        for (const Strand& strand : s.curve.strands) {
          expect_slope_and_curvature(s, strand);
          at_rest += energy_at_rest(s, strand);
        }
        EXPECT_NEAR(energy(s.curve, s.radii, s.metric, s.weights, s.pool), at_rest,
                    kRounding * std::abs(at_rest));
      }
    }
  }
}

/// Three times the medial term's Hessian is what two more medial terms would add to it; the forces stay.
TEST(Energy, StiffensTheMedialTermAlone) {
  for (const bool blocks : {false, true}) {
    Scene s(sphere(2), 57);
    s.weights.medial_power = 8;
    s.weights.medial_blocks = blocks;
    const uint32_t n = s.curve.size();
    const auto systems_of = [&](double medial, double stiffening) {
      s.weights.medial = medial;
      s.weights.medial_stiffening.assign(stiffening == 1 ? 0 : n, stiffening);
      std::vector<StrandSystem> systems(s.curve.strands.size());
      for (size_t k = 0; k < systems.size(); ++k) {
        assemble(s.curve, s.curve.strands[k], s.frames, s.radii, s.metric, s.weights, s.pool, systems[k]);
      }
      return systems;
    };
    const auto once = systems_of(0.7, 1), stiff = systems_of(0.7, 3), thrice = systems_of(2.1, 1);
    for (size_t k = 0; k < once.size(); ++k) {
      for (uint32_t i = 0; i < s.curve.strands[k].count; ++i) {
        EXPECT_EQ(stiff[k].right[i].x, once[k].right[i].x);
        EXPECT_EQ(stiff[k].right[i].y, once[k].right[i].y);
        const double diagonal = thrice[k].diagonal[i];
        EXPECT_NEAR(stiff[k].diagonal[i], diagonal, kRounding * diagonal);
        EXPECT_GT(diagonal, once[k].diagonal[i]);
        if (!blocks) continue;
        const Sym2 &a = stiff[k].diagonal_block[i], &b = thrice[k].diagonal_block[i];
        const double size = kRounding * (b.xx + b.yy);
        EXPECT_NEAR(a.xx, b.xx, size);
        EXPECT_NEAR(a.xy, b.xy, size);
        EXPECT_NEAR(a.yy, b.yy, size);
      }
    }
  }
}

TEST(Energy, OfLengthAloneIsTheLength) {
  for (const Mesh& mesh : meshes()) {
    Scene s(mesh, 52);
    s.weights.length.assign(s.curve.size(), 1);
    s.weights.bending.assign(s.curve.size(), 0);
    s.radii.assign(s.curve.size(), Radii{0, 0});
    EXPECT_NEAR(energy(s.curve, s.radii, s.metric, s.weights, s.pool), s.curve.length(),
                kRounding * s.curve.length());
  }
}

/// The right-hand side of the library's system is minus the derivative of the energy, in any
/// direction.
TEST(Energy, DerivativeIsTheSystemsRightHandSide) {
  // The model is quadratic, so central differences are exact up to rounding.
  constexpr double kStep = 1e-3, kDifference = 1e-8;
  for (const Mesh& mesh : meshes()) {
    Scene s(mesh, 53);
    const LiteralModel model(s.surface, s.curve, s.radii, s.frames, s.metric, s.weights);
    for (const Strand& strand : s.curve.strands) {
      StrandSystem system;
      assemble(s.curve, strand, s.frames, s.radii, s.metric, s.weights, s.pool, system);
      for (uint32_t k = 0; k < strand.count; ++k) {
        const uint32_t i = strand.first + k;
        const Vec2 direction = s.rng.direction();
        Eigen::VectorXd d = Eigen::VectorXd::Zero(3 * s.curve.size());
        d.segment<3>(3 * i) =
            kStep * s.surface.to_space(s.curve.nodes[i].face, system.frame[k] * direction);
        const double slope = (model.energy(d) - model.energy(-d)) / (2 * kStep);
        EXPECT_NEAR(-dot(system.right[k], direction), slope, kDifference * (1 + std::abs(slope)));
      }
    }
  }
}

/// A fixed node is in no coupling and gets no force, wherever it is; all else is as without it.
TEST(Energy, FixedNodesAreLeftOutOfTheSystem) {
  for (const bool aligned : {false, true}) {
    Scene s(sphere(2), 56);
    if (aligned) s.align();
    const auto system_of = [&](const Strand& strand) {
      StrandSystem system;
      assemble(s.curve, strand, s.frames, s.radii, s.metric, s.weights, s.pool, system);
      return system;
    };
    const auto same = [](const Sym2& a, const Sym2& b) { return a.xx == b.xx && a.xy == b.xy && a.yy == b.yy; };
    for (const Strand& strand : s.curve.strands) {
      const StrandSystem all = system_of(strand);
      const uint32_t n = strand.count;
      for (uint32_t fixed = 0; fixed < n; ++fixed) {
        s.curve.fixed[strand.first + fixed] = 1;
        const StrandSystem rest = system_of(strand);
        s.curve.fixed[strand.first + fixed] = 0;
        EXPECT_GT(rest.diagonal[fixed], 0);
        EXPECT_EQ(norm(rest.right[fixed]), 0);
        for (uint32_t k = 0; k < n; ++k) {
          const bool next = k == fixed || (k + 1) % n == fixed, second = k == fixed || (k + 2) % n == fixed;
          EXPECT_EQ(rest.first[k], next ? 0 : all.first[k]) << fixed << " " << k;
          EXPECT_EQ(rest.second[k], second ? 0 : all.second[k]) << fixed << " " << k;
          if (aligned) {
            EXPECT_TRUE(same(rest.first_block[k], next ? Sym2{} : all.first_block[k])) << fixed << " " << k;
            EXPECT_TRUE(same(rest.diagonal_block[k], k == fixed ? Sym2{} : all.diagonal_block[k]));
          }
          if (k == fixed) continue;
          EXPECT_EQ(rest.diagonal[k], all.diagonal[k]);
          EXPECT_EQ(norm(rest.right[k] - all.right[k]), 0);
        }
      }
    }
  }
}

}  // namespace
}  // namespace meander::test::energy_tests
