// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/vertex_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include "base/failure.h"

namespace meander {
namespace {

/// Weights of edges between obtuse faces may be negative, and would make the Laplacian indefinite.
constexpr double kLeastWeight = 1e-3;

Eigen::Index index(uint32_t v) { return static_cast<Eigen::Index>(v); }

template <class Number>
void add_edge(std::vector<Eigen::Triplet<Number>>& entries, uint32_t from, uint32_t to, double weight, Number carry) {
  const auto i = static_cast<int>(from), j = static_cast<int>(to);
  entries.emplace_back(i, i, weight);
  entries.emplace_back(j, j, weight);
  entries.emplace_back(j, i, -weight * carry);
  if constexpr (std::is_same_v<Number, Complex>) {
    entries.emplace_back(i, j, -weight * std::conj(carry));
  } else {
    entries.emplace_back(i, j, -weight * carry);
  }
}

template <class Number, class Vector>
Vector diffused(Eigen::SparseMatrix<Number> matrix, const Functions& area, const Vector& x, double length) {
  matrix *= length * length;
  for (Eigen::Index v = 0; v < area.size(); ++v) {
    Number& diagonal = matrix.coeffRef(v, v);
    // The row of an unused vertex holds nothing else, and the square of a short length may underflow.
    diagonal = area[v] > 0 ? diagonal + area[v] : Number(1);
  }
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<Number>> solver(matrix);
  if (solver.info() != Eigen::Success) {
    throw Failure(FailureKind::kInternal, "A field could not be smoothed; please report this mesh.");
  }
  return solver.solve(area.cast<Number>().cwiseProduct(x));
}

}  // namespace

VertexGeometry::VertexGeometry(const Surface& surface) : surface_(surface) {
  const size_t n = surface.vertex_count();
  area_ = Functions::Zero(static_cast<Eigen::Index>(n));
  normal_.assign(n, Vec3::Zero());
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t v = surface.face(f)[k];
      area_[index(v)] += surface.face_area(f) / 3;
      normal_[v] += surface.corner_angle(f, k) * surface.face_normal(f);
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
  for (HalfEdge e = 0; e < 3 * surface_.face_count(); ++e) {
    HalfEdge& s = start[surface_.face(face_of(e))[corner_of(e)]];
    if (s == kNone || surface_.twin(e) == kNone) s = e;
  }
  for (uint32_t v = 0; v < n; ++v) {
    if (start[v] == kNone) continue;
    if (!surface_.on_boundary(v)) scale_[v] = 2 * std::numbers::pi / surface_.total_angle(v);
    double angle = 0;
    HalfEdge e = start[v];
    do {
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
  for (HalfEdge e = 0; e < 3 * surface_.face_count(); ++e) {
    const HalfEdge other = surface_.twin(e);
    if (other != kNone && other < e) continue;
    const uint32_t f = face_of(e), k = corner_of(e), l = next_corner(k);
    const uint32_t from = surface_.face(f)[k], to = surface_.face(f)[l];
    // The same edge seen from its other end, the last one of the corner there.
    const double back = angle_[3 * f + l] + scale_[to] * surface_.corner_angle(f, l);
    const double weight = 0.5 * (cotangent(e) + (other != kNone ? cotangent(other) : 0));
    // A line is its own opposite, so the half turn between the two views of the edge drops out.
    edges_.push_back({from, to, std::max(weight, kLeastWeight), polar(1.0, 2 * (back - angle_[e]))});
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
  for (uint32_t v = 0; v < out.size(); ++v) {
    const Complex line = lines[index(v)];
    if (used(v) && size_of(line) > least) out[v] = to_space(v, 0.5 * angle_of(line));
  }
  return out;
}

Functions VertexGeometry::smoothed(const Functions& x, double length) const {
  return length > 0 ? diffused(laplacian(), area_, x, length) : x;
}

Lines VertexGeometry::smoothed(const Lines& x, double length) const {
  return length > 0 ? diffused(line_laplacian(), area_, x, length) : x;
}

Eigen::SparseMatrix<double> VertexGeometry::laplacian() const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(4 * edges_.size());
  for (const Edge& e : edges_) add_edge<double>(entries, e.from, e.to, e.weight, 1);
  for (Eigen::Index v = 0; v < area_.size(); ++v) {
    if (!(area_[v] > 0)) entries.emplace_back(static_cast<int>(v), static_cast<int>(v), 1);
  }
  Eigen::SparseMatrix<double> matrix(area_.size(), area_.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::SparseMatrix<Complex> VertexGeometry::line_laplacian() const {
  std::vector<Eigen::Triplet<Complex>> entries;
  entries.reserve(4 * edges_.size());
  for (const Edge& e : edges_) add_edge<Complex>(entries, e.from, e.to, e.weight, e.carry);
  for (Eigen::Index v = 0; v < area_.size(); ++v) {
    if (!(area_[v] > 0)) entries.emplace_back(static_cast<int>(v), static_cast<int>(v), 1);
  }
  Eigen::SparseMatrix<Complex> matrix(area_.size(), area_.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace meander
