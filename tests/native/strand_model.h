// SPDX-License-Identifier: GPL-3.0-or-later
//
// The quadratic model of one step as the paper writes it: positions in space, three unknowns a
// node, rigid motions that unroll each segment; every term is a list of squares. It shares no code
// with the library's banded form in parallel frames.
#pragma once

#include <span>

#include <Eigen/Dense>

#include "model/constants.h"
#include "model/energy.h"
#include "model/solve.h"
#include "curves.h"

namespace meander::test {

using Mat3 = Eigen::Matrix3d;

/// x -> turn x + shift
struct Rigid {
  Mat3 turn;
  Vec3 shift;
  Vec3 operator()(const Vec3& x) const { return turn * x + shift; }
};

/// weight |sum of matrices times displacements + constant|^2
struct Square {
  std::vector<std::pair<uint32_t, Mat3>> terms;
  Vec3 constant;
  double weight;     ///< in the gradient
  double stiffness;  ///< in the Hessian
};

/// The rigid motion that maps the node to `origin`, the direction `along` of its face to the x-axis
/// rotated by `angle` in the plane, and the face's normal to the z-axis.
inline Rigid lay_flat(const Surface& s, const SurfacePoint& node, Vec2 along, const Vec3& origin,
                      double angle) {
  const Vec3 x = s.to_space(node.face, along), z = s.face_normal(node.face), y = z.cross(x);
  Mat3 axes;
  axes << x.transpose(), y.transpose(), z.transpose();
  Mat3 in_plane;
  in_plane << std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1;
  Rigid r;
  r.turn = in_plane * axes;
  r.shift = origin - r.turn * position(s, node);
  return r;
}

class LiteralModel {
 public:
  LiteralModel(const Surface& s, const Curve& c, const NodeData<Radii>& radii,
               const Frames& frames, const LocalMetric& metric, const Weights& weights)
      : n_(c.size()) {
    const NodeData<double>& r = metric.radius;
    for (uint32_t i = 0; i < n_; ++i) {
      const uint32_t before = c.previous(i), after = c.next(i);
      const Vec3 x = position(s, c.nodes[i]);
      const double l1 = after != kNone ? c.shapes[i].length : 0;
      const double l0 = before != kNone ? c.shapes[before].length : 0;
      // Eqs. 3 to 5. In the plane of the unrolled segment it runs along the x-axis.
      if (after != kNone) {
        const Rigid first = lay_flat(s, c.nodes[i], c.shapes[i].leaving, Vec3::Zero(), 0);
        const Rigid second = lay_flat(s, c.nodes[after], c.shapes[i].arriving, Vec3(l1, 0, 0), 0);
        // Eq. 13, expanded to second order about the present curve: stiffer along the segment.
        const double p = weights.length_power;
        const double f = stretch(c, i, r, p) / l1;
        const double t = 0.5 * (weights.length[i] + weights.length[after]);
        const double stiffness = std::max(t, kLeastLengthStiffness) * f;
        add({{i, first, 1}, {after, second, -1}}, s, c, t * f, stiffness);
        const Mat3 along = Vec3(1, 0, 0).asDiagonal();
        add({{i, first, 1}, {after, second, -1}}, s, c, 0, (p - 2) * stiffness, along);
        // Eq. 11, with the field's vectors mapped to the same plane.
        if (!weights.alignment.empty()) {
          const Vec3 here = first.turn * s.to_space(c.nodes[i].face, weights.field[i]);
          const Vec3 there = second.turn * s.to_space(c.nodes[after].face, weights.field[after]);
          const Vec3 sum = here.dot(there) < 0 ? Vec3(here - there) : Vec3(here + there);
          Mat3 cross_with;
          cross_with << 0, sum.z(), -sum.y(), -sum.z(), 0, sum.x(), sum.y(), -sum.x(), 0;
          const double beta = 0.5 * (weights.alignment[i] + weights.alignment[after]);
          add({{i, first, 1}, {after, second, -1}}, s, c, beta / l1, beta / l1, cross_with);
        }
      }
      // Eqs. 6 and 7: distances from the two medial centres, which are fixed.
      const double alpha = weights.medial * 2 * std::sqrt(2.0) / (r[i] * r[i]);
      for (int side = 0; side < 2; ++side) {
        const Vec3 b = s.to_space(c.nodes[i].face, frames.bitangent2[i]);
        const Vec3 centre = x + (side == 0 ? 1 : -1) * radii[i][side] * b;
        // Eq. 13 to second order; the library may take the larger second derivative for both.
        const double q = weights.medial_power;
        const double w = alpha * 0.5 * (l0 + l1) * std::pow(radii[i][side] / r[i], q - 2);
        const bool larger = !weights.medial_blocks;
        squares_.push_back({{{i, Mat3::Identity()}}, x - centre, w, larger ? (q - 1) * w : w});
        if (!larger) squares_.push_back({{{i, b * b.transpose()}}, Vec3::Zero(), 0, (q - 2) * w});
      }
      // Eq. 12 with the weight b r^2 / w: the previous node is mapped to the plane of this one's
      // next segment, at the angle by which the strand bends here.
      if (after != kNone && before != kNone) {
        const Vec2 out = c.shapes[i].leaving, in = c.shapes[before].arriving;
        const double bend =
            std::atan2(cross(out, in), dot(out, in));  // of the direction in, seen from the direction out
        const Vec3 start = -l0 * Vec3(std::cos(bend), std::sin(bend), 0);
        const Rigid p = lay_flat(s, c.nodes[before], c.shapes[before].leaving, start, bend);
        const Rigid q = lay_flat(s, c.nodes[i], out, Vec3::Zero(), 0);
        const Rigid f = lay_flat(s, c.nodes[after], c.shapes[i].arriving, Vec3(l1, 0, 0), 0);
        const double w = weights.bending[i] * r[i] * r[i] / (0.5 * (l0 + l1));
        add({{before, p, 1 / l0}, {i, q, -1 / l0 - 1 / l1}, {after, f, 1 / l1}}, s, c, w, w);
      }
    }
  }

  /// The factor of a segment in eq. 13: (l / r)^(p - 2), divided by its mean along the strand.
  static double stretch(const Curve& c, uint32_t i, const NodeData<double>& r, double p) {
    double length = 0, sum = 0;
    for (const Strand& strand : c.strands) {
      if (i < strand.first || i >= strand.end()) continue;
      for (uint32_t k = strand.first; k < strand.first + strand.segment_count(); ++k) {
        length += c.shapes[k].length;
        sum += c.shapes[k].length * std::pow(c.shapes[k].length / r[k], p - 2);
      }
    }
    return std::pow(c.shapes[i].length / r[i], p - 2) * length / sum;
  }

  /// Energy of the model at displacements d (3 n).
  double energy(const Eigen::VectorXd& d) const {
    double sum = 0;
    for (const Square& q : squares_) sum += q.weight * residual(q, d).squaredNorm();
    return sum;
  }

  /// H d + g, and the sum of the absolute values of its terms, as a scale for comparisons.
  Eigen::VectorXd gradient(const Eigen::VectorXd& d, Eigen::VectorXd* magnitude = nullptr) const {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(3 * n_);
    if (magnitude) *magnitude = out;
    for (const Square& q : squares_) {
      const Vec3 change = residual(q, d) - q.constant;
      for (const auto& [node, m] : q.terms) {
        const Vec3 g = 2 * m.transpose() * (q.weight * q.constant + q.stiffness * change);
        out.segment<3>(3 * node) += g;
        if (magnitude) magnitude->segment<3>(3 * node).array() += g.norm();
      }
    }
    return out;
  }

  /// -H^-1 g with the fixed nodes held, by dense algebra.
  Eigen::VectorXd dense_step(std::span<const uint8_t> fixed) const {
    Eigen::MatrixXd h = Eigen::MatrixXd::Zero(3 * n_, 3 * n_);
    for (const Square& q : squares_) {
      for (const auto& [a, ma] : q.terms) {
        for (const auto& [b, mb] : q.terms) {
          h.block<3, 3>(3 * a, 3 * b) += 2 * q.stiffness * ma.transpose() * mb;
        }
      }
    }
    Eigen::VectorXd g = gradient(Eigen::VectorXd::Zero(3 * n_));
    for (uint32_t i = 0; i < n_; ++i) {
      if (!fixed[i]) continue;
      h.middleRows(3 * i, 3).setZero();
      h.middleCols(3 * i, 3).setZero();
      h.block<3, 3>(3 * i, 3 * i).setIdentity();
      g.segment<3>(3 * i).setZero();
    }
    return -h.ldlt().solve(g);
  }

 private:
  struct Part {
    uint32_t node;
    Rigid motion;
    double factor;
  };
  void add(const std::vector<Part>& parts, const Surface& s, const Curve& c, double weight,
           double stiffness, const Mat3& of = Mat3::Identity()) {
    Square q{{}, Vec3::Zero(), weight, stiffness};
    for (const Part& p : parts) {
      q.terms.emplace_back(p.node, p.factor * of * p.motion.turn);
      q.constant += p.factor * of * p.motion(position(s, c.nodes[p.node]));
    }
    squares_.push_back(std::move(q));
  }
  static Vec3 residual(const Square& q, const Eigen::VectorXd& d) {
    Vec3 sum = q.constant;
    for (const auto& [node, m] : q.terms) sum += m * d.segment<3>(3 * node);
    return sum;
  }

  uint32_t n_;
  std::vector<Square> squares_;
};

}  // namespace meander::test
