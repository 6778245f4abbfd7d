// SPDX-License-Identifier: GPL-3.0-or-later
//
// Differential geometry at the vertices: areas, tangent planes, and the Laplacians of functions and of
// fields of lines.
#pragma once

#include <complex>
#include <vector>

#include <Eigen/SparseCore>

#include "base/cancel_token.h"
#include "base/eigen.h"
#include "base/elementary.h"
#include "mesh/surface.h"
#include "mesh/vertex_data.h"

namespace meander {

/// A line in the tangent plane of a vertex is held as its square, a complex number: no sign to choose.
using Complex = std::complex<double>;
/// As std::polar, std::arg and std::abs, which differ from system to system.
inline Complex polar(double size, double angle) {
  return {size * elementary::cos(angle), size * elementary::sin(angle)};
}
inline double angle_of(const Complex& z) { return elementary::atan2(z.imag(), z.real()); }
inline double size_of(const Complex& z) { return elementary::hypot(z.real(), z.imag()); }
using Functions = Eigen::VectorXd;   ///< one value a vertex
using Lines = Eigen::VectorXcd;      ///< one squared vector a vertex, in the vertex's own plane

/// The tangent plane of a vertex is what its faces become when they are laid out flat around it: angles
/// between edges are scaled to make a full turn (Polthier and Schmies 1998; Knoppel et al. 2013). At the
/// boundary they are left as they are, so that a flat sheet stays flat. Vertices that no face uses have no
/// area, and everything is zero there.
class VertexGeometry {
 public:
  /// Everything here that goes over the whole surface calls `poll`, or a copy, for what it does with a face, an edge or
  /// a vertex, which takes some nanoseconds, and for less where systems are solved.
  explicit VertexGeometry(const Surface& surface, const CancelToken& poll = {});

  const Surface& surface() const { return surface_; }
  /// The constructor's, for what else is done with it.
  const CancelToken& poll() const { return poll_; }
  /// A third of the area of the faces around each vertex.
  const Functions& area() const { return area_; }
  bool used(uint32_t v) const { return area_[v] > 0; }
  /// Sum of the angles of the faces around each vertex.
  double total_angle(uint32_t v) const { return total_angle_[v]; }
  const Vec3& normal(uint32_t v) const { return normal_[v]; }

  /// Angle of a vector of the plane of face f in the plane of its corner k.
  double angle_at_corner(uint32_t f, uint32_t k, Vec2 v) const;
  /// The unit vector in space at this angle in the plane of vertex v.
  Vec3 to_space(uint32_t v, double angle) const;
  /// The square of the part of a vector in space that is tangential at v, of length 1; or 0.
  Complex line_along(uint32_t v, const Vec3& direction) const;
  /// The unit vectors that lines stand for; zero where a line is not longer than `least`.
  VertexData<Vec3> to_space(const Lines& lines, double least) const;

  /// Solves (area + length^2 L) x = area x0, one implicit step of diffusion (Desbrun et al. 1999):
  /// averages over about 2 `length`.
  Functions smoothed(const Functions& x, double length) const;
  Lines smoothed(const Lines& x, double length) const;

  /// The Laplacian of functions with cotangent weights, and the connection Laplacian of lines: positive
  /// semi-definite, since weights below a small positive one are raised to it. Rows of unused
  /// vertices hold a 1.
  Eigen::SparseMatrix<double> laplacian() const;
  Eigen::SparseMatrix<Complex> line_laplacian() const;

 private:
  struct Edge {
    uint32_t from, to;
    double weight;
    Complex carry;  // lines at `from` to `to`
  };
  void find_angles();
  void find_edges();
  template <class Number, class Carry>
  Eigen::SparseMatrix<Number> laplacian_of(const Carry& carry) const;

  const Surface& surface_;
  CancelToken poll_;
  Functions area_;
  std::vector<Vec3> normal_, axis_;
  std::vector<double> angle_;  // of each half-edge in the plane of its first vertex
  std::vector<double> total_angle_;
  std::vector<double> scale_;  // of angles at each vertex
  std::vector<Edge> edges_;
};

}  // namespace meander
