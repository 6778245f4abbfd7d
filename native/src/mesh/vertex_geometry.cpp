// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/vertex_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/eigen.h"
#include "base/failure.h"
#include "mesh/constants.h"
#include "mesh/sparse_factors.h"

namespace meander {
namespace {

Eigen::Index index(uint32_t v) { return static_cast<Eigen::Index>(v); }

template <class Number, class Vector>
Vector diffused(Eigen::SparseMatrix<Number> matrix, const Functions& area, const Vector& x, double length,
                const CancelToken& poll) {
  matrix *= length * length;
  for (Eigen::Index v = 0; v < area.size(); ++v) {
    Number& diagonal = matrix.coeffRef(v, v);
    // The row of an unused vertex holds nothing else, and the square of a short length may underflow.
    diagonal = area[v] > 0 ? diagonal + area[v] : Number(1);
  }
  const SparseFactors<Number> factors(matrix, poll);
  if (!factors.exist()) {
    throw Failure(FailureKind::kInternal, "A field could not be smoothed; please report this mesh.");
  }
  return factors.solve(area.cast<Number>().cwiseProduct(x), poll);
}

}  // namespace

VertexGeometry::VertexGeometry(const Surface& surface, const CancelToken& poll) : surface_(surface), poll_(poll) {
  const size_t n = surface.vertex_count();
  area_ = Functions::Zero(static_cast<Eigen::Index>(n));
  normal_.assign(n, Vec3::Zero());
  total_angle_.assign(n, 0);
  CancelToken ask = poll_;
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    ask();
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t v = surface.face(f)[k];
      area_[index(v)] += surface.face_area(f) / 3;
      const double angle = surface.corner_angle(f, k);
      normal_[v] += angle * surface.face_normal(f);
      total_angle_[v] += angle;
    }
  }
  find_angles();
  find_edges();
}

void VertexGeometry::find_angles() {
  const size_t n = surface_.vertex_count();
  axis_.assign(n, Vec3::Zero());
  scale_.assign(n, 1);
  angle_.assign(3 * surface_.face_count(), 0);
  // The first half-edge around each vertex: at the boundary the one that has no face on its right.
  std::vector<HalfEdge> start(n, kNone);
  CancelToken ask = poll_;
  for (HalfEdge e = 0; e < 3 * surface_.face_count(); ++e) {
    ask();
    HalfEdge& s = start[surface_.face(face_of(e))[corner_of(e)]];
    if (s == kNone || surface_.twin(e) == kNone) s = e;
  }
  for (uint32_t v = 0; v < n; ++v) {
    if (start[v] == kNone) continue;
    if (!surface_.on_boundary(v)) scale_[v] = 2 * std::numbers::pi / total_angle_[v];
    double angle = 0;
    HalfEdge e = start[v];
    do {
      ask();
      angle_[e] = angle;
      angle += scale_[v] * surface_.corner_angle(face_of(e), corner_of(e));
      e = surface_.twin(3 * face_of(e) + prev_corner(corner_of(e)));
    } while (e != kNone && e != start[v]);
    // Where the faces around a vertex cancel out, any of their normals will do.
    const uint32_t f = face_of(start[v]);
    const double length = normal_[v].norm();
    normal_[v] = length > 1e-6 ? Vec3(normal_[v] / length) : surface_.face_normal(f);
    const uint32_t to = surface_.face(f)[next_corner(corner_of(start[v]))];
    const Vec3 edge = (surface_.position(to) - surface_.position(v)).normalized();
    Vec3 axis = edge - edge.dot(normal_[v]) * normal_[v];
    if (!(axis.norm() > 1e-6)) axis = normal_[v].unitOrthogonal();
    axis_[v] = axis.normalized();
  }
}

void VertexGeometry::find_edges() {
  const auto cotangent = [&](HalfEdge e) {
    const uint32_t f = face_of(e), opposite = prev_corner(corner_of(e));
    const Vec2 p = surface_.corner(f, opposite);
    const Vec2 u = surface_.corner(f, corner_of(e)) - p, w = surface_.corner(f, next_corner(corner_of(e))) - p;
    return dot(u, w) / cross(u, w);
  };
  CancelToken ask = poll_;
  edges_.reserve((3 * surface_.face_count() + surface_.boundary().size()) / 2);
  for (HalfEdge e = 0; e < 3 * surface_.face_count(); ++e) {
    ask();
    const HalfEdge other = surface_.twin(e);
    if (other != kNone && other < e) continue;
    const uint32_t f = face_of(e), k = corner_of(e), l = next_corner(k);
    const uint32_t from = surface_.face(f)[k], to = surface_.face(f)[l];
    // The same edge seen from its other end, the last one of the corner there.
    const double back = angle_[3 * f + l] + scale_[to] * surface_.corner_angle(f, l);
    const double weight = 0.5 * (cotangent(e) + (other != kNone ? cotangent(other) : 0));
    // A line is its own opposite, so the half turn between the two views of the edge drops out.
    edges_.push_back({from, to, std::max(weight, kLeastEdgeWeight), polar(1.0, 2 * (back - angle_[e]))});
  }
}

double VertexGeometry::angle_at_corner(uint32_t f, uint32_t k, Vec2 v) const {
  const Vec2 edge = surface_.corner(f, next_corner(k)) - surface_.corner(f, k);
  const double to_edge = elementary::atan2(cross(edge, v), dot(edge, v));
  // Both planes agree on the bisector of the corner.
  const double half = 0.5 * surface_.corner_angle(f, k);
  return angle_[3 * f + k] + scale_[surface_.face(f)[k]] * half + (to_edge - half);
}

Vec3 VertexGeometry::to_space(uint32_t v, double angle) const {
  return elementary::cos(angle) * axis_[v] + elementary::sin(angle) * normal_[v].cross(axis_[v]);
}

Complex VertexGeometry::line_along(uint32_t v, const Vec3& direction) const {
  const Complex z(direction.dot(axis_[v]), direction.dot(normal_[v].cross(axis_[v])));
  const double size = std::norm(z);
  return size > 1e-12 * direction.squaredNorm() && used(v) ? z * z / size : Complex(0);
}

VertexData<Vec3> VertexGeometry::to_space(const Lines& lines, double least) const {
  VertexData<Vec3> out(surface_.vertex_count(), Vec3::Zero());
  CancelToken ask = poll_;
  for (uint32_t v = 0; v < out.size(); ++v) {
    ask();
    const Complex line = lines[index(v)];
    if (used(v) && size_of(line) > least) out[v] = to_space(v, 0.5 * angle_of(line));
  }
  return out;
}

Functions VertexGeometry::smoothed(const Functions& x, double length) const {
  return length > 0 ? diffused(laplacian(), area_, x, length, poll_) : x;
}

Lines VertexGeometry::smoothed(const Lines& x, double length) const {
  return length > 0 ? diffused(line_laplacian(), area_, x, length, poll_) : x;
}

Eigen::SparseMatrix<double> VertexGeometry::laplacian() const {
  return laplacian_of<double>([](const Edge&) { return 1.0; });
}

Eigen::SparseMatrix<Complex> VertexGeometry::line_laplacian() const {
  return laplacian_of<Complex>([](const Edge& e) { return e.carry; });
}

/// Not from a list of triplets, which would be larger than the matrix and is sorted in one call that nothing ends.
template <class Number, class Carry>
Eigen::SparseMatrix<Number> VertexGeometry::laplacian_of(const Carry& carry) const {
  CancelToken ask = poll_;
  Eigen::VectorXi counts = Eigen::VectorXi::Ones(area_.size());
  for (const Edge& e : edges_) {
    ask();
    ++counts[index(e.from)];
    ++counts[index(e.to)];
  }
  Eigen::SparseMatrix<Number> matrix(area_.size(), area_.size());
  matrix.reserve(counts);
  for (const Edge& e : edges_) {
    ask(4);
    const Eigen::Index i = index(e.from), j = index(e.to);
    matrix.coeffRef(i, i) += e.weight;
    matrix.coeffRef(j, j) += e.weight;
    // No two edges join the same vertices.
    const Number number = -e.weight * carry(e);
    matrix.insert(j, i) = number;
    matrix.insert(i, j) = Eigen::numext::conj(number);
  }
  for (Eigen::Index v = 0; v < area_.size(); ++v) {
    ask();
    if (!(area_[v] > 0)) matrix.coeffRef(v, v) += 1;
  }
  matrix.makeCompressed();
  poll_.now();
  return matrix;
}

}  // namespace meander
