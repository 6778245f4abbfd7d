// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/fields.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/eigen.h"
#include "base/elementary.h"
#include "base/failure.h"
#include "mesh/closest_point.h"
#include "mesh/constants.h"
#include "mesh/sparse_factors.h"
#include "mesh/vertex_geometry.h"

namespace meander {
namespace {

/// What is done between two asks: a few hundred microseconds, and for whole fields at once some milliseconds.
constexpr uint32_t kPiecesPerPoll = 8192;

/// The curvature tensor at the vertices: its mean, and half the difference of its two eigenvalues as a
/// line along the direction in which the surface bends least (signed).
struct CurvatureTensor {
  Functions mean;
  Lines difference;
};

CurvatureTensor curvature_tensor(const VertexGeometry& g) {
  const Surface& s = g.surface();
  const auto n = static_cast<Eigen::Index>(s.vertex_count());
  CurvatureTensor t{Functions::Zero(n), Lines::Zero(n)};
  CancelToken poll = g.poll();
  for (HalfEdge e = 0; e < 3 * s.face_count(); ++e) {
    poll();
    const HalfEdge other = s.twin(e);
    if (other == kNone || other < e) continue;
    const uint32_t f = face_of(e), k = corner_of(e), l = next_corner(k);
    const uint32_t ends[2] = {s.face(f)[k], s.face(f)[l]};
    const Vec3 edge = s.position(ends[1]) - s.position(ends[0]);
    const Vec3 &n0 = s.face_normal(f), &n1 = s.face_normal(face_of(other));
    // Positive where the surface bulges to the side of its normals. Along an edge it does not bend.
    const double length = edge.norm();
    const double angle = elementary::atan2(n0.cross(n1).dot(edge) / length, n0.dot(n1));
    for (const uint32_t v : ends) {
      const auto i = static_cast<Eigen::Index>(v);
      const double share = 0.25 * angle * length / g.area()[i];
      t.mean[i] += share;
      t.difference[i] += share * g.line_along(v, edge);
    }
  }
  return t;
}

/// The direction of least bending in absolute value: the difference of the squared curvatures.
Lines least_bending(const VertexGeometry& g, double radius) {
  const CurvatureTensor t = curvature_tensor(g);
  const double length = kDiffusedLength * radius;
  return g.smoothed(Lines(g.smoothed(t.difference, length).cwiseProduct(g.smoothed(t.mean, length))), 0.5 * length);
}

double mean_size(const Lines& x) { return x.size() ? x.unaryExpr(&size_of).mean() : 0; }

/// Component of every vertex; kNone for unused ones.
std::vector<uint32_t> components(const Surface& s) {
  std::vector<uint32_t> component(s.vertex_count(), kNone);
  for (uint32_t f = 0; f < s.face_count(); ++f) {
    for (const uint32_t v : s.face(f)) component[v] = s.component(f);
  }
  return component;
}

/// Area of every vertex, as a share of that of its component.
Functions relative_area(const VertexGeometry& g, const std::vector<uint32_t>& component) {
  std::vector<double> total(g.surface().component_count(), 0);
  for (uint32_t v = 0; v < component.size(); ++v) {
    if (component[v] != kNone) total[component[v]] += g.area()[v];
  }
  Functions share = g.area();
  for (uint32_t v = 0; v < component.size(); ++v) {
    if (component[v] != kNone) share[v] /= total[component[v]];
  }
  return share;
}

/// Makes the square mean of every component 1.
void normalise(Lines& x, const Functions& area, const std::vector<uint32_t>& component, size_t count) {
  std::vector<double> square(count, 0);
  for (uint32_t v = 0; v < component.size(); ++v) {
    if (component[v] != kNone) square[component[v]] += area[v] * std::norm(x[v]);
  }
  for (uint32_t v = 0; v < component.size(); ++v) {
    const double sum = component[v] != kNone ? square[component[v]] : 0;
    x[v] = sum > 0 ? x[v] / std::sqrt(sum) : Complex(0);
  }
}

Eigen::SparseMatrix<Complex> shifted(Eigen::SparseMatrix<Complex> matrix, const Functions& area) {
  for (Eigen::Index v = 0; v < area.size(); ++v) matrix.coeffRef(v, v) += kFieldShift * area[v];
  return matrix;
}

void require_factors(const SparseFactors<Complex>& factors) {
  if (factors.exist()) return;
  throw Failure(FailureKind::kInternal, "The direction field could not be computed; please report this mesh.");
}

}  // namespace

VertexData<double> curvature(const Surface& surface, CurvatureKind kind, double radius,
                             const CancelToken& cancel) {
  const VertexGeometry g(surface, cancel.every(kPiecesPerPoll));
  Functions x = Functions::Zero(static_cast<Eigen::Index>(surface.vertex_count()));
  if (kind == CurvatureKind::kGaussian || kind == CurvatureKind::kAbsoluteGaussian) {
    CancelToken poll = g.poll();
    for (uint32_t v = 0; v < surface.vertex_count(); ++v) {
      poll();
      if (!g.used(v) || surface.on_boundary(v)) continue;
      x[v] = (2 * std::numbers::pi - g.total_angle(v)) / g.area()[v];
    }
  } else {
    const CurvatureTensor t = curvature_tensor(g);
    x = t.mean;
    if (kind == CurvatureKind::kCurvedness) x = (t.mean.array().square() + t.difference.array().abs2()).sqrt();
  }
  if (kind == CurvatureKind::kAbsoluteGaussian || kind == CurvatureKind::kAbsoluteMean) x = x.cwiseAbs();
  x = g.smoothed(x, kDiffusedLength * radius);
  return VertexData<double>(std::vector<double>(x.begin(), x.end()));
}

VertexData<Vec3> principal_directions(const Surface& surface, bool most, double radius,
                                      const CancelToken& cancel) {
  const VertexGeometry g(surface, cancel.every(kPiecesPerPoll));
  const Lines least = least_bending(g, radius);
  return g.to_space(most ? Lines(-least) : least, std::max(kUnbentOfMean * mean_size(least), kUnbent));
}

VertexData<Vec3> smoothest_directions(const Surface& surface, const CancelToken& cancel) {
  const VertexGeometry g(surface, cancel.every(kPiecesPerPoll));
  const std::vector<uint32_t> component = components(surface);
  const Functions area = relative_area(g, component);
  const size_t count = surface.component_count();
  const SparseFactors<Complex> factors(shifted(g.line_laplacian(), area), g.poll());
  require_factors(factors);

  // Of several smoothest fields the iteration finds the one nearest to where it starts: at the directions of
  // least bending, with some of the x-axis, and a little noise, so that no start is orthogonal to the smoothest.
  Lines x = least_bending(g, 0);
  normalise(x, area, component, count);
  uint64_t random = 1;
  CancelToken poll = g.poll();
  for (uint32_t v = 0; v < component.size(); ++v) {
    poll();
    if (component[v] == kNone) continue;
    random = random * 6364136223846793005u + 1442695040888963407u;
    x[v] += kFieldAxis * g.line_along(v, Vec3::UnitX()) +
            polar(kFieldNoise, 2 * std::numbers::pi * static_cast<double>(random >> 11) * 0x1p-53);
  }
  normalise(x, area, component, count);
  for (int k = 0; k < kMostFieldIterations; ++k) {
    Lines y = factors.solve(area.cast<Complex>().cwiseProduct(x), g.poll());
    normalise(y, area, component, count);
    const double change = area.dot((y - x).cwiseAbs2()) / static_cast<double>(count);
    x = std::move(y);
    if (change < kSettledField * kSettledField) break;
  }
  return g.to_space(x, 1e-9);
}

VertexData<Vec3> extended_directions(const Surface& surface, std::span<const Stroke> strokes,
                                     const CancelToken& cancel) {
  constexpr size_t kPiecesPerSearch = 256;  // pieces of work that a search for the nearest point counts for
  const VertexGeometry g(surface, cancel.every(kPiecesPerPoll));
  const std::vector<uint32_t> component = components(surface);
  const ClosestPoint closest(surface, g.poll());
  const double pitch = 0.5 * surface.mean_edge_length();
  Lines wish = Lines::Zero(static_cast<Eigen::Index>(surface.vertex_count()));
  Functions weight = Functions::Zero(wish.size());
  std::vector<uint8_t> stroked(surface.component_count(), 0);
  CancelToken poll = g.poll();
  poll.now();
  for (const Stroke& stroke : strokes) {
    for (size_t k = 0; k + 1 < stroke.size(); ++k) {
      const Vec3 along = stroke[k + 1] - stroke[k];
      const double length = along.norm();
      if (!(length > 0)) continue;
      const auto samples = static_cast<size_t>(std::ceil(length / pitch));
      for (size_t q = 0; q < samples; ++q) {
        poll(kPiecesPerSearch);
        const double at = (static_cast<double>(q) + 0.5) / static_cast<double>(samples);
        const SurfacePoint p = closest(stroke[k] + at * along).point;
        const Vec2 flat{along.dot(surface.to_space(p.face, {1, 0})), along.dot(surface.to_space(p.face, {0, 1}))};
        if (!(norm(flat) > 1e-3 * length)) continue;
        for (uint32_t c = 0; c < 3; ++c) {
          const auto v = static_cast<Eigen::Index>(surface.face(p.face)[c]);
          const double w = kStrokeStiffness * p.weight(c) * length / static_cast<double>(samples) / (2 * pitch);
          weight[v] += w;
          wish[v] += polar(w, 2 * g.angle_at_corner(p.face, c, flat));
        }
        stroked[surface.component(p.face)] = 1;
      }
    }
  }
  Eigen::SparseMatrix<Complex> matrix = shifted(g.line_laplacian(), relative_area(g, component));
  poll.now();
  for (Eigen::Index v = 0; v < weight.size(); ++v) matrix.coeffRef(v, v) += weight[v];
  const SparseFactors<Complex> factors(matrix, g.poll());
  require_factors(factors);
  Lines x = factors.solve(wish, g.poll());
  for (uint32_t v = 0; v < component.size(); ++v) {
    if (component[v] == kNone || !stroked[component[v]]) x[v] = 0;
  }
  // Far from its strokes the field is faint, but it still points somewhere.
  return g.to_space(x, 1e-12);
}

VertexData<Vec3> boundary_directions(const Surface& surface, const CancelToken& cancel) {
  std::vector<Vec3> ends;
  for (const HalfEdge e : surface.boundary()) {
    const Triangle& corners = surface.face(face_of(e));
    ends.push_back(surface.position(corners[corner_of(e)]));
    ends.push_back(surface.position(corners[next_corner(corner_of(e))]));
  }
  std::vector<Stroke> strokes;
  for (size_t k = 0; k < ends.size(); k += 2) strokes.push_back(std::span(ends).subspan(k, 2));
  return extended_directions(surface, strokes, cancel);
}

VertexData<Vec3> turned_directions(const Surface& surface, const VertexData<Vec3>& lines,
                                   const VertexData<double>& angles, const CancelToken& cancel) {
  const VertexGeometry g(surface, cancel.every(kPiecesPerPoll));
  Lines turned(static_cast<Eigen::Index>(surface.vertex_count()));
  // A line is kept as the square of its vector, so it turns twice as far.
  for (uint32_t v = 0; v < surface.vertex_count(); ++v) {
    turned[v] = g.used(v) ? g.line_along(v, lines[v]) * polar(1, 2 * angles[v]) : Complex(0);
  }
  return g.to_space(turned, 0.5);
}

}  // namespace meander
