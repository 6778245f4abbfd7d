// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/energy.h"

#include <algorithm>
#include <cmath>

#include "base/close_growth.h"
#include "base/elementary.h"
#include "model/constants.h"

namespace meander {
namespace {

double segment_length(const Curve& curve, uint32_t i, double r) {
  return std::max(curve.shapes[i].length, kShortestSegment * r);
}

/// w of a node.
double length_of_node(const Curve& curve, uint32_t i, double r) {
  const uint32_t before = curve.previous(i);
  return 0.5 * ((curve.has_segment(i) ? segment_length(curve, i, r) : 0) +
                (before != kNone ? segment_length(curve, before, r) : 0));
}

/// x^e; for the even whole numbers that presets use without the general function's cost.
double power(double x, double e) {
  if (e == 0) return 1;
  if (e == 2) return x * x;
  if (e == 4) return (x * x) * (x * x);
  if (e == 6) return (x * x) * (x * x) * (x * x);
  if (e == 8) return ((x * x) * (x * x)) * ((x * x) * (x * x));
  return elementary::pow(x, e);
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
  const double a2 = power(a, q - 2), b2 = power(b, q - 2);
  return {r * (a2 * a - b2 * b), (q - 1) * (a2 + b2)};
}

/// Fills the frames of a strand's nodes, carried parallel from (1, 0) on, and the directions of its
/// segments in them; returns the frame that arrives after the last segment.
///
/// Every block begins with (1, 0) too, and is turned by what the blocks before it arrive with.
Vec2 carry_frames(const Curve& curve, const Strand& strand, ThreadPool& pool, Table<Vec2>& frames,
                  Table<Vec2>& directions) {
  std::vector<Vec2> start(ThreadPool::block_count(strand.count, kNodeGrain) + 1, Vec2{1, 0});
  pool.for_blocks(strand.count, kNodeGrain, [&](size_t block, size_t begin, size_t end) {
    Vec2 frame{1, 0};
    for (size_t k = begin; k < end; ++k) {
      frames[k] = frame;
      const auto i = static_cast<uint32_t>(strand.first + k);
      if (!curve.has_segment(i)) break;
      const PathShape& shape = curve.shapes[i];
      directions[k] = shape.leaving * conj(frame);
      frame = unit(shape.arriving * conj(directions[k]));
    }
    start[block + 1] = frame;
  });
  for (size_t block = 2; block < start.size(); ++block) start[block] = unit(start[block] * start[block - 1]);
  pool.for_blocks(strand.count, kNodeGrain, [&](size_t block, size_t begin, size_t end) {
    if (block == 0) return;
    for (size_t k = begin; k < end; ++k) {
      frames[k] = frames[k] * start[block];
      directions[k] = directions[k] * conj(start[block]);
    }
  });
  return start.back();
}

/// The second derivative of eq. 13's medial term as it is, over 2 alpha w: `along` the strand, and how
/// much more across it. Positive for every q above 1.
struct MedialStiffness {
  double along, more_across;
};

MedialStiffness medial_stiffness(const Radii& radii, double r, double q) {
  double sum = 0;
  for (const double radius : radii) sum += power(std::max(radius / r, kLeastMedialRadius), q - 2);
  return {sum, (q - 2) * sum};
}

/// Factors c of the strand's segments, see energy.h; their mean, weighted with the lengths, is 1.
std::vector<double> power_factors(const Curve& curve, const Strand& strand, const LocalMetric& metric,
                                  double p) {
  std::vector<double> factor(strand.segment_count());
  double length = 0, sum = 0;
  for (uint32_t k = 0; k < factor.size(); ++k) {
    const uint32_t i = strand.first + k;
    const double l = segment_length(curve, i, metric.radius[i]);
    factor[k] = power(l / metric.radius[i], p - 2);
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
  return 2 / q * r * r * (power(radii[0] / r, q) + power(radii[1] / r, q));
}

/// Calls term(k) for k from 0 to count - 1. A term adds to its node and to the next two at most: so that no two threads
/// add to one node, the last two terms of every block follow when all threads are done.
template <class Term>
void for_terms(uint32_t count, ThreadPool& pool, const Term& term) {
  pool.for_blocks(count, kNodeGrain, [&](size_t, size_t begin, size_t end) {
    for (size_t k = begin; k + 2 < end; ++k) term(static_cast<uint32_t>(k));
  });
  for (size_t begin = 0; begin < count; begin += kNodeGrain) {
    const size_t end = std::min<size_t>(begin + kNodeGrain, count);
    for (size_t k = end - std::min<size_t>(end - begin, 2); k < end; ++k) term(static_cast<uint32_t>(k));
  }
}

/// The system of one strand while its terms are added up. Node k is counted within the strand; past the join of a
/// closed strand, k is count or more, and its unknown is holonomy * z.
struct Assembly {
  const Curve& curve;
  const Strand& strand;
  const Frames& frames;
  const NodeData<Radii>& radii;
  const LocalMetric& metric;
  const Weights& weights;
  StrandSystem& system;
  Table<Vec2> direction;        // u of segment k in the frame of node k
  std::vector<double> factor;   // c of segment k, see energy.h; empty for a length power of 2

  void begin(ThreadPool& pool);
  void add_length(uint32_t k);
  void add_field(uint32_t k);
  void add_medial(uint32_t k);
  void add_place(uint32_t k);
  void add_bending(uint32_t k);
  void eliminate_fixed();

 private:
  uint32_t wrapped(uint32_t k) const { return k >= strand.count ? k - strand.count : k; }

  /// Adds to the gradient of node k a vector of the frame that continues past the join.
  void add_gradient(uint32_t k, Vec2 g) {
    if (k >= strand.count) g = conj(system.holonomy) * g;
    Vec2& right = system.right[wrapped(k)];
    right = right - g;
  }

  /// Adds stiffness (v . (z_k - z_(k+1)))^2 / 2, v in the frame of node k.
  void stiffen_along(uint32_t k, double stiffness, Vec2 v) {
    system.diagonal_block[k].add(stiffness, v);
    system.first_block[k].add(-stiffness, v);
    system.diagonal_block[wrapped(k + 1)].add(stiffness, k + 1 >= strand.count ? conj(system.holonomy) * v : v);
  }
};

void Assembly::begin(ThreadPool& pool) {
  const uint32_t n = strand.count;
  system.closed = strand.closed;
  system.reset(n, pool);
  resize_closely(direction, n);
  const Vec2 frame = carry_frames(curve, strand, pool, system.frame, direction);
  // After the join the frame has become `frame` where the first node's was (1, 0).
  system.holonomy = strand.closed ? unit(system.frame[0] * conj(frame)) : Vec2{1, 0};
  if (weights.coupled()) {
    system.diagonal_block.assign(n, Sym2{});
    system.first_block.assign(n, Sym2{});
  }
  if (weights.length_power != 2) factor = power_factors(curve, strand, metric, weights.length_power);
}

/// Eq. 5, and eq. 13 for a length power other than 2: the length of segment k.
void Assembly::add_length(uint32_t k) {
  const uint32_t i = strand.first + k, j = strand.first + wrapped(k + 1);
  const double l = segment_length(curve, i, metric.radius[i]);
  const double scale = factor.empty() ? 1 : factor[k];
  const double t = 0.5 * (weights.length[i] + weights.length[j]);
  const double stiffness = 2 * std::max(t, kLeastLengthStiffness) / l * scale;
  system.diagonal[k] += stiffness;
  system.diagonal[wrapped(k + 1)] += stiffness;
  system.first[k] += -stiffness;
  add_gradient(k, -2 * t * scale * direction[k]);
  add_gradient(k + 1, 2 * t * scale * direction[k]);
  if (weights.length_power != 2) stiffen_along(k, (weights.length_power - 2) * stiffness, direction[k]);
}

/// Eq. 11: the length of segment k across the field.
void Assembly::add_field(uint32_t k) {
  const uint32_t i = strand.first + k, j = strand.first + wrapped(k + 1);
  const double l = segment_length(curve, i, metric.radius[i]);
  const double beta = 0.5 * (weights.alignment[i] + weights.alignment[j]);
  const Vec2 there = weights.field[j] * conj(system.frame[wrapped(k + 1)]);
  const Vec2 across = across_field(weights.field[i] * conj(system.frame[k]),
                                   k + 1 >= strand.count ? system.holonomy * there : there);
  const double pull = 2 * beta * dot(direction[k], across);
  stiffen_along(k, 2 * beta / l, across);
  add_gradient(k, -pull * across);
  add_gradient(k + 1, pull * across);
}

/// Eq. 7, and eq. 13 for a medial power other than 2: node k between its two medial centres.
void Assembly::add_medial(uint32_t k) {
  const uint32_t i = strand.first + k;
  const double r = metric.radius[i];
  const double w = length_of_node(curve, i, r);
  const double alpha = weights.medial * kAlphaRadiusSquared / (r * r);
  const Vec2 b = frames.bitangent2[i] * conj(system.frame[k]);
  const double stiffening = weights.medial_stiffening.empty() ? 1 : weights.medial_stiffening[i];
  const double hessian_scale = 2 * alpha * w * stiffening;
  const MedialForce f = medial_force(radii[i], r, weights.medial_power);
  if (weights.medial_blocks) {
    const MedialStiffness m = medial_stiffness(radii[i], r, weights.medial_power);
    system.diagonal[k] += hessian_scale * m.along;
    system.diagonal_block[k].add(hessian_scale * m.more_across, b);
  } else {
    system.diagonal[k] += hessian_scale * f.stiffness;
  }
  add_gradient(k, -2 * alpha * w * f.pull * b);
}

/// Node k across the field from where it is to be.
void Assembly::add_place(uint32_t k) {
  const uint32_t i = strand.first + k;
  const Vec2 line = weights.field[i];
  if (weights.hold[i] == 0 || norm(line) == 0) return;
  const double r = metric.radius[i];
  const double stiffness = 2 * weights.hold[i] * length_of_node(curve, i, r) / (r * r);
  const Vec2 across = unit(Vec2{-line.y, line.x}), there = across * conj(system.frame[k]);
  system.diagonal_block[k].add(stiffness, there);
  add_gradient(k, -stiffness * dot(weights.to_place[i], across) * there);
}

/// Eq. 12: the turn at the node between segments k and k + 1, which nodes k, k + 1 and k + 2 decide.
void Assembly::add_bending(uint32_t k) {
  const uint32_t middle = wrapped(k + 1), i = strand.first + middle;
  const double r = metric.radius[i];
  const double l0 = segment_length(curve, strand.first + k, r), l1 = segment_length(curve, i, r);
  const double stiffness = 2 * weights.bending[i] * r * r / (0.5 * (l0 + l1));
  if (stiffness == 0) return;
  const double c[3] = {1 / l0, -(1 / l0 + 1 / l1), 1 / l1};
  // Past the join the direction is stored in the first node's frame.
  const Vec2 u1 = k + 1 >= strand.count ? system.holonomy * direction[middle] : direction[middle];
  const Vec2 turn = u1 - direction[k];
  for (uint32_t a = 0; a < 3; ++a) {
    add_gradient(k + a, stiffness * c[a] * turn);
    system.diagonal[wrapped(k + a)] += stiffness * c[a] * c[a];
  }
  system.first[k] += stiffness * c[0] * c[1];
  system.first[middle] += stiffness * c[1] * c[2];
  system.second[k] += stiffness * c[0] * c[2];
}

/// z = 0 for fixed nodes.
void Assembly::eliminate_fixed() {
  const uint32_t n = strand.count;
  const bool coupled = weights.coupled();
  for (uint32_t k = 0; k < n; ++k) {
    if (!curve.fixed[strand.first + k]) continue;
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

/// Length, medial axis and bending at a node (eqs. 1, 2, 12, 13 with a length power of 2).
double energy_of_node(const Curve& curve, const Radii& radii, double r, const Weights& weights, uint32_t i) {
  const uint32_t before = curve.previous(i);
  const double l0 = before != kNone ? curve.shapes[before].length : 0;
  const double l1 = curve.has_segment(i) ? curve.shapes[i].length : 0;
  const double w = 0.5 * (l0 + l1);
  const double alpha = weights.medial * kAlphaRadiusSquared / (r * r);
  double sum = weights.length[i] * w + alpha * w * medial_energy(radii, r, weights.medial_power);
  if (l0 > 0 && l1 > 0) {
    const Vec2 turn = curve.shapes[i].leaving - curve.shapes[before].arriving;
    sum += weights.bending[i] * r * r * dot(turn, turn) / w;
  }
  return sum;
}

/// What eq. 13 adds to the length of a segment, whose factor is c, for a length power p other than 2.
double power_energy_of_segment(const Curve& curve, const Weights& weights, double c, uint32_t i) {
  const double t = 0.5 * (weights.length[i] + weights.length[curve.next(i)]);
  return t * (2 / weights.length_power * c - 1) * curve.shapes[i].length;  // in place of t l
}

/// The place of a node.
double place_energy_of_node(const Curve& curve, double r, const Weights& weights, uint32_t i) {
  const Vec2 d = weights.to_place[i];
  return weights.hold[i] * length_of_node(curve, i, r) * dot(d, d) / (r * r);
}

/// Eq. 11 for a segment.
double field_energy_of_segment(const Curve& curve, const Weights& weights, uint32_t i) {
  const uint32_t j = curve.next(i);
  const PathShape& shape = curve.shapes[i];
  const double beta = 0.5 * (weights.alignment[i] + weights.alignment[j]);
  // The line at the end, carried back along the segment.
  const Vec2 there = weights.field[j] * conj(shape.arriving) * shape.leaving;
  const double across = dot(shape.leaving, across_field(weights.field[i], there));
  return beta * shape.length * across * across;
}

}  // namespace

void StrandSystem::reset(size_t n, ThreadPool& pool) {
  for (Table<double>* numbers : {&diagonal, &first, &second}) resize_closely(*numbers, n);
  resize_closely(right, n);
  resize_closely(frame, n);
  pool.for_blocks(n, kNodeGrain, [&](size_t, size_t begin, size_t end) {
    for (Table<double>* numbers : {&diagonal, &first, &second}) {
      std::fill(numbers->data() + begin, numbers->data() + end, 0);
    }
    std::fill(right.data() + begin, right.data() + end, Vec2{});
    std::fill(frame.data() + begin, frame.data() + end, Vec2{1, 0});
  });
  diagonal_block.clear();
  first_block.clear();
  holonomy = {1, 0};
}

void assemble(const Curve& curve, const Strand& strand, const Frames& frames, const NodeData<Radii>& radii,
              const LocalMetric& metric, const Weights& weights, ThreadPool& pool, StrandSystem& system) {
  Assembly assembly{curve, strand, frames, radii, metric, weights, system, {}, {}};
  assembly.begin(pool);
  const uint32_t n = strand.count, segments = strand.segment_count();
  for_terms(segments, pool, [&](uint32_t k) {
    assembly.add_length(k);
    if (!weights.alignment.empty()) assembly.add_field(k);
  });
  for_terms(n, pool, [&](uint32_t k) {
    assembly.add_medial(k);
    if (!weights.hold.empty()) assembly.add_place(k);
  });
  // At the node between segments k and k + 1.
  for_terms(strand.closed || segments == 0 ? segments : segments - 1, pool,
            [&](uint32_t k) { assembly.add_bending(k); });
  assembly.eliminate_fixed();
}

void add_end_term(const FreeEnd& end, uint32_t node, double local_radius, double medial_weight,
                  StrandSystem& system) {
  const double stiffness = 2 * medial_weight * kAlphaRadiusSquared / local_radius;
  const Vec2 pull = (end.radius - local_radius) * end.ahead;
  system.diagonal[node] += stiffness;
  system.right[node] = system.right[node] + stiffness * (pull * conj(system.frame[node]));
}

double energy(const Curve& curve, const NodeData<Radii>& radii, const LocalMetric& metric, const Weights& weights,
              ThreadPool& pool) {
  double sum = pool.sum(curve.size(), [&](size_t i) {
    return energy_of_node(curve, radii[i], metric.radius[i], weights, static_cast<uint32_t>(i));
  });
  for (const Strand& strand : curve.strands) {
    if (weights.length_power == 2) break;
    const std::vector<double> factor = power_factors(curve, strand, metric, weights.length_power);
    for (uint32_t k = 0; k < factor.size(); ++k) {
      sum += power_energy_of_segment(curve, weights, factor[k], strand.first + k);
    }
  }
  for (uint32_t i = 0; i < curve.size() && !weights.alignment.empty(); ++i) {
    if (curve.has_segment(i)) sum += field_energy_of_segment(curve, weights, i);
  }
  for (uint32_t i = 0; i < curve.size() && !weights.hold.empty(); ++i) {
    sum += place_energy_of_node(curve, metric.radius[i], weights, i);
  }
  return sum;
}

}  // namespace meander
