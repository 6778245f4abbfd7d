// SPDX-License-Identifier: GPL-3.0-or-later
#include "energy.h"

#include <algorithm>
#include <cmath>

namespace meander {
namespace {

/// Segments this short (in r) would make 1 / l meaningless; refinement removes them right after.
constexpr double kShortest = 1e-6;

double segment_length(const Curve& curve, uint32_t i, double r) {
  return std::max(curve.shapes[i].length, kShortest * r);
}

struct MedialForce {
  double pull;       // towards +B, over 2 alpha w
  double stiffness;  // second derivative, over 2 alpha w, of both sides together
};

/// Derivatives of eq. 13's medial term. Across the strand the second derivative is q - 1 times that
/// along it; the larger one serves for both, so that the Hessian stays a multiple of the identity.
MedialForce medial_force(const Radii& radii, double r, double q) {
  if (q == 2) return {radii[0] - radii[1], 2};
  const double a = radii[0] / r, b = radii[1] / r;
  const double a2 = std::pow(a, q - 2), b2 = std::pow(b, q - 2);
  return {r * (a2 * a - b2 * b), (q - 1) * (a2 + b2)};
}

/// A medial radius this small (in r) would make powers below 2 infinitely stiff.
constexpr double kLeastRatio = 1e-3;

/// The second derivative of eq. 13's medial term as it is, over 2 alpha w: `along` the strand, and how
/// much more across it. Positive for every q above 1.
struct MedialStiffness {
  double along, more_across;
};

MedialStiffness medial_stiffness(const Radii& radii, double r, double q) {
  double sum = 0;
  for (const double radius : radii) sum += std::pow(std::max(radius / r, kLeastRatio), q - 2);
  return {sum, (q - 2) * sum};
}

/// Factors c of the strand's segments, see energy.h; their mean, weighted with the lengths, is 1.
std::vector<double> power_factors(const Curve& curve, const Strand& strand, const std::vector<double>& local_radius,
                                  double p) {
  std::vector<double> factor(strand.segment_count());
  double length = 0, sum = 0;
  for (uint32_t k = 0; k < factor.size(); ++k) {
    const uint32_t i = strand.first + k;
    const double l = segment_length(curve, i, local_radius[i]);
    factor[k] = std::pow(l / local_radius[i], p - 2);
    length += l;
    sum += l * factor[k];
  }
  for (double& c : factor) c *= length / sum;
  return factor;
}

/// N of a segment: |v x (X + X')|^2 = (v . N)^2, with X' of the sign that makes it the nearer to X.
Vec2 across_field(Vec2 from, Vec2 to) {
  const Vec2 line = dot(from, to) < 0 ? from - to : from + to;
  return {line.y, -line.x};
}

/// Eq. 13's medial term over alpha w; |r+|^2 + |r-|^2 for q = 2.
double medial_energy(const Radii& radii, double r, double q) {
  if (q == 2) return radii[0] * radii[0] + radii[1] * radii[1];
  return 2 / q * r * r * (std::pow(radii[0] / r, q) + std::pow(radii[1] / r, q));
}

}  // namespace

double power_balance(double q) {
  // Measured on a square of 17 x 17 spacings with both presets: with alpha left as it is, the spacing
  // falls by 11 to 16 % for q from 3 to 8.
  constexpr double kLimit = 0.53, kRate = 1.1;
  return q == 2 ? 1 : kLimit + (1 - kLimit) * std::exp(-kRate * (q - 2));
}

double polish_balance(double q) {
  // Measured likewise: growth with q above 2 leaves the curve 7 to 16 % too dense.
  return q == 2 ? 0 : 0.5 + 0.05 * q;
}

void StrandSystem::resize(size_t n) {
  diagonal.assign(n, 0);
  first.assign(n, 0);
  second.assign(n, 0);
  right.assign(n, Vec2{});
  frame.assign(n, Vec2{1, 0});
  diagonal_block.clear();
  first_block.clear();
}

void assemble(const Curve& curve, const Strand& strand, const Frames& frames, const std::vector<Radii>& radii,
              const std::vector<double>& local_radius, const Weights& weights, StrandSystem& system) {
  const uint32_t n = strand.count, s = strand.first;
  system.closed = strand.closed;
  system.resize(n);

  // The frame of node k, and the direction u of segment k in it.
  std::vector<Vec2> direction(n);
  Vec2 frame{1, 0};
  for (uint32_t k = 0; k < n; ++k) {
    system.frame[k] = frame;
    if (!curve.has_segment(s + k)) break;
    const PathShape& shape = curve.shapes[s + k];
    direction[k] = shape.leaving * conj(frame);
    frame = unit(shape.arriving * conj(direction[k]));
  }
  // After the join the frame has become `frame` where the first node's was (1, 0).
  system.holonomy = strand.closed ? unit(system.frame[0] * conj(frame)) : Vec2{1, 0};

  // Terms of neighbours a and b = a + step; past the join b's unknown is holonomy * z.
  const auto couple = [&](uint32_t k, uint32_t steps, double value) {
    (steps == 1 ? system.first : system.second)[k] += value;
  };
  const auto wrapped = [&](uint32_t k) { return k >= n ? k - n : k; };
  // Adds to the gradient of node k (unwrapped) a vector of the frame that continues past the join.
  const auto add_gradient = [&](uint32_t k, Vec2 g) {
    if (k >= n) g = conj(system.holonomy) * g;
    Vec2& right = system.right[wrapped(k)];
    right = right - g;
  };

  const bool coupled = weights.coupled();
  if (coupled) {
    system.diagonal_block.assign(n, Sym2{});
    system.first_block.assign(n, Sym2{});
  }
  // Adds stiffness (v . (z_k - z_(k+1)))^2 / 2, v in the frame of node k.
  const auto stiffen_along = [&](uint32_t k, double stiffness, Vec2 v) {
    system.diagonal_block[k].add(stiffness, v);
    system.first_block[k].add(-stiffness, v);
    system.diagonal_block[wrapped(k + 1)].add(stiffness, k + 1 >= n ? conj(system.holonomy) * v : v);
  };

  const uint32_t segments = strand.segment_count();
  const double p = weights.length_power;
  const std::vector<double> factor = p != 2 ? power_factors(curve, strand, local_radius, p) : std::vector<double>{};
  for (uint32_t k = 0; k < segments; ++k) {
    const uint32_t i = s + k, j = s + wrapped(k + 1);
    const double l = segment_length(curve, i, local_radius[i]);
    const double scale = p != 2 ? factor[k] : 1;
    const double t = 0.5 * (weights.length[i] + weights.length[j]);
    const double stiffness = 2 * std::max(t, kLeastLengthStiffness) / l * scale;
    system.diagonal[k] += stiffness;
    system.diagonal[wrapped(k + 1)] += stiffness;
    couple(k, 1, -stiffness);
    add_gradient(k, -2 * t * scale * direction[k]);
    add_gradient(k + 1, 2 * t * scale * direction[k]);
    if (p != 2) stiffen_along(k, (p - 2) * stiffness, direction[k]);
    if (weights.alignment.empty()) continue;
    const double beta = 0.5 * (weights.alignment[i] + weights.alignment[j]);
    const Vec2 there = weights.field[j] * conj(system.frame[wrapped(k + 1)]);
    const Vec2 across = across_field(weights.field[i] * conj(system.frame[k]),
                                     k + 1 >= n ? system.holonomy * there : there);
    const double pull = 2 * beta * dot(direction[k], across);
    stiffen_along(k, 2 * beta / l, across);
    add_gradient(k, -pull * across);
    add_gradient(k + 1, pull * across);
  }

  for (uint32_t k = 0; k < n; ++k) {
    const uint32_t i = s + k, before = curve.previous(i);
    const double r = local_radius[i];
    const double w = 0.5 * ((curve.has_segment(i) ? segment_length(curve, i, r) : 0) +
                            (before != kNone ? segment_length(curve, before, r) : 0));
    const double alpha = weights.medial * kAlphaRadiusSquared / (r * r);
    const Vec2 b = frames.bitangent2[i] * conj(system.frame[k]);
    const MedialForce f = medial_force(radii[i], r, weights.medial_power);
    if (weights.medial_blocks) {
      const MedialStiffness m = medial_stiffness(radii[i], r, weights.medial_power);
      system.diagonal[k] += 2 * alpha * w * m.along;
      system.diagonal_block[k].add(2 * alpha * w * m.more_across, b);
    } else {
      system.diagonal[k] += 2 * alpha * w * f.stiffness;
    }
    add_gradient(k, -2 * alpha * w * f.pull * b);
  }

  // Bending at the node between segments k and k + 1, nodes k, k + 1, k + 2.
  for (uint32_t k = 0; k + (strand.closed ? 0 : 1) < segments; ++k) {
    const uint32_t middle = wrapped(k + 1);
    const uint32_t i = s + middle;
    const double r = local_radius[i];
    const double l0 = segment_length(curve, s + k, r), l1 = segment_length(curve, i, r);
    const double stiffness = 2 * weights.bending[i] * r * r / (0.5 * (l0 + l1));
    if (stiffness == 0) continue;
    const double c[3] = {1 / l0, -(1 / l0 + 1 / l1), 1 / l1};
    const uint32_t node[3] = {k, k + 1, k + 2};
    // Past the join the direction is stored in the first node's frame.
    const Vec2 u1 = k + 1 >= n ? system.holonomy * direction[middle] : direction[middle];
    const Vec2 turn = u1 - direction[k];
    for (int a = 0; a < 3; ++a) {
      add_gradient(node[a], stiffness * c[a] * turn);
      system.diagonal[wrapped(node[a])] += stiffness * c[a] * c[a];
    }
    couple(wrapped(k), 1, stiffness * c[0] * c[1]);
    couple(middle, 1, stiffness * c[1] * c[2]);
    couple(wrapped(k), 2, stiffness * c[0] * c[2]);
  }

  for (uint32_t k = 0; k < n; ++k) {
    if (!curve.fixed[s + k]) continue;
    system.diagonal[k] = 1;
    system.right[k] = Vec2{};
    system.first[k] = system.second[k] = 0;
    if (strand.closed || k >= 1) system.first[(k + n - 1) % n] = 0;
    if (strand.closed || k >= 2) system.second[(k + 2 * n - 2) % n] = 0;
    if (!coupled) continue;
    system.diagonal_block[k] = system.first_block[k] = Sym2{};
    if (strand.closed || k >= 1) system.first_block[(k + n - 1) % n] = Sym2{};
  }
}

double energy(const Curve& curve, const std::vector<Radii>& radii, const std::vector<double>& local_radius,
              const Weights& weights) {
  double sum = 0;
  for (uint32_t i = 0; i < curve.size(); ++i) {
    const uint32_t before = curve.previous(i);
    const double r = local_radius[i];
    const double l0 = before != kNone ? curve.shapes[before].length : 0;
    const double l1 = curve.has_segment(i) ? curve.shapes[i].length : 0;
    const double w = 0.5 * (l0 + l1);
    const double alpha = weights.medial * kAlphaRadiusSquared / (r * r);
    sum += weights.length[i] * w + alpha * w * medial_energy(radii[i], r, weights.medial_power);
    if (l0 > 0 && l1 > 0) {
      const Vec2 turn = curve.shapes[i].leaving - curve.shapes[before].arriving;
      sum += weights.bending[i] * r * r * dot(turn, turn) / w;
    }
  }
  if (weights.length_power != 2) {
    const double p = weights.length_power;
    for (const Strand& strand : curve.strands) {
      const std::vector<double> factor = power_factors(curve, strand, local_radius, p);
      for (uint32_t k = 0; k < factor.size(); ++k) {
        const uint32_t i = strand.first + k;
        const double t = 0.5 * (weights.length[i] + weights.length[curve.next(i)]);
        sum += t * (2 / p * factor[k] - 1) * curve.shapes[i].length;  // in place of t l
      }
    }
  }
  for (uint32_t i = 0; i < curve.size() && !weights.alignment.empty(); ++i) {
    if (!curve.has_segment(i)) continue;
    const uint32_t j = curve.next(i);
    const PathShape& shape = curve.shapes[i];
    const double beta = 0.5 * (weights.alignment[i] + weights.alignment[j]);
    // The line at the end, carried back along the segment.
    const Vec2 there = weights.field[j] * conj(shape.arriving) * shape.leaving;
    const double across = dot(shape.leaving, across_field(weights.field[i], there));
    sum += beta * shape.length * across * across;
  }
  return sum;
}

}  // namespace meander
