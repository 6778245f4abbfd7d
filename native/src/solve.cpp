// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "coupled_solve.h"

namespace meander {
namespace {

/// A closed strand below this many nodes has couplings that fall on one another; it is solved densely.
constexpr size_t kLeastBanded = 6;

/// L D L^T of a real symmetric pentadiagonal matrix, of its leading n x n part.
class Pentadiagonal {
 public:
  Pentadiagonal(const StrandSystem& a, size_t n) : n_(n), inverse_(n), first_(n), second_(n) {
    double d1 = 0, d2 = 0;  // D of the previous node and of the one before it
    for (size_t i = 0; i < n; ++i) {
      double d = a.diagonal[i];
      double f = i + 1 < n ? a.first[i] : 0;
      if (i >= 1) {
        d -= d1 * first_[i - 1] * first_[i - 1];
        f -= d1 * first_[i - 1] * second_[i - 1];
      }
      if (i >= 2) d -= d2 * second_[i - 2] * second_[i - 2];
      inverse_[i] = 1 / d;
      first_[i] = f * inverse_[i];
      second_[i] = (i + 2 < n ? a.second[i] : 0) * inverse_[i];
      d2 = d1;
      d1 = d;
    }
  }

  void solve(std::vector<Vec2>& x) const {
    for (size_t i = 0; i < n_; ++i) forward(x, i);
    for (size_t i = n_; i-- > 0;) backward(x, i);
  }

  /// The same for a right-hand side that is zero but in its first two and last two entries. What
  /// those cause dies away within some hundred nodes; beyond that it stays zero. Returns how many
  /// entries at the front and at the back may differ from zero.
  std::pair<size_t, size_t> solve_border(std::vector<Vec2>& x) const {
    const double least = kNegligible * (size(x[0]) + size(x[1]) + size(x[n_ - 2]) + size(x[n_ - 1]));
    // The back: nothing to carry forward but between the last two.
    const Vec2 back[2] = {x[n_ - 2], x[n_ - 1]};
    x[n_ - 2] = x[n_ - 1] = Vec2{};
    size_t front = 0;
    while (front < n_ && (front < 4 || size(x[front - 1]) + size(x[front - 2]) > least)) forward(x, front++);
    for (size_t i = front; i-- > 0;) backward(x, i);
    std::vector<Vec2> y(n_);
    y[n_ - 2] = back[0];
    y[n_ - 1] = back[1];
    forward_last(y);
    size_t first = n_;
    while (first > 0 && (first + 4 > n_ || size(y[first]) + size(y[first + 1]) > least)) backward(y, --first);
    for (size_t i = first; i < n_; ++i) x[i] = x[i] + y[i];
    return {front, first};
  }

 private:
  static constexpr double kNegligible = 1e-40;
  static double size(Vec2 v) { return std::abs(v.x) + std::abs(v.y); }
  void forward(std::vector<Vec2>& x, size_t i) const {
    if (i >= 1) x[i] = x[i] - first_[i - 1] * x[i - 1];
    if (i >= 2) x[i] = x[i] - second_[i - 2] * x[i - 2];
  }
  void forward_last(std::vector<Vec2>& x) const { x[n_ - 1] = x[n_ - 1] - first_[n_ - 2] * x[n_ - 2]; }
  void backward(std::vector<Vec2>& x, size_t i) const {
    x[i] = inverse_[i] * x[i];
    if (i + 1 < n_) x[i] = x[i] - first_[i] * x[i + 1];
    if (i + 2 < n_) x[i] = x[i] - second_[i] * x[i + 2];
  }

  size_t n_;
  std::vector<double> inverse_, first_, second_;
};

std::vector<Vec2> solve_dense(const StrandSystem& a) {
  using Complex = std::complex<double>;
  const size_t n = a.diagonal.size();
  const auto index = [](size_t i) { return static_cast<Eigen::Index>(i); };
  Eigen::MatrixXcd h = Eigen::MatrixXcd::Zero(index(n), index(n));
  Eigen::VectorXcd right(index(n));
  const Complex rho(a.holonomy.x, a.holonomy.y);
  for (size_t i = 0; i < n; ++i) {
    h(index(i), index(i)) += a.diagonal[i];
    right(index(i)) = Complex(a.right[i].x, a.right[i].y);
    for (size_t step = 1; step <= 2; ++step) {
      const double value = step == 1 ? a.first[i] : a.second[i];
      if (value == 0) continue;
      Complex phase = 1;
      size_t j = i + step;
      for (; j >= n; j -= n) phase *= rho;
      h(index(i), index(j)) += value * phase;
      h(index(j), index(i)) += value * std::conj(phase);
    }
  }
  const Eigen::VectorXcd z = h.ldlt().solve(right);
  std::vector<Vec2> out(n);
  for (size_t i = 0; i < n; ++i) out[i] = {z(index(i)).real(), z(index(i)).imag()};
  return out;
}

std::vector<Vec2> solve_closed(const StrandSystem& a) {
  // Unknowns 0 .. m - 1 are banded; p = m and q = m + 1 border them.
  const size_t n = a.diagonal.size(), m = n - 2, p = m, q = m + 1;
  const Vec2 rho = a.holonomy;
  const Pentadiagonal band(a, m);
  std::vector<Vec2> x(a.right.begin(), a.right.begin() + static_cast<std::ptrdiff_t>(m));
  std::vector<Vec2> yp(m), yq(m);  // first columns of H, then what the band makes of them
  yp[m - 2] = {a.second[m - 2], 0};
  yp[m - 1] = {a.first[m - 1], 0};
  yp[0] = yp[0] + a.second[p] * conj(rho);
  yq[m - 1] = {a.second[m - 1], 0};
  yq[0] = yq[0] + a.first[q] * conj(rho);
  yq[1] = yq[1] + a.second[q] * conj(rho);

  band.solve(x);
  const auto [front_p, back_p] = band.solve_border(yp);
  const auto [front_q, back_q] = band.solve_border(yq);

  // Rows of H at p and q, applied to a vector of the banded part.
  const auto row_p = [&](const std::vector<Vec2>& v) {
    return a.second[m - 2] * v[m - 2] + a.first[m - 1] * v[m - 1] + a.second[p] * (rho * v[0]);
  };
  const auto row_q = [&](const std::vector<Vec2>& v) {
    return a.second[m - 1] * v[m - 1] + a.first[q] * (rho * v[0]) + a.second[q] * (rho * v[1]);
  };
  // The 2 x 2 Schur complement, Hermitian and positive definite.
  const double spp = a.diagonal[p] - row_p(yp).x;
  const double sqq = a.diagonal[q] - row_q(yq).x;
  const Vec2 spq = Vec2{a.first[p], 0} - row_p(yq);
  const Vec2 rp = a.right[p] - row_p(x), rq = a.right[q] - row_q(x);
  const double determinant = spp * sqq - dot(spq, spq);
  const Vec2 zp = (1 / determinant) * (sqq * rp - spq * rq);
  const Vec2 zq = (1 / determinant) * (spp * rq - conj(spq) * rp);
  const size_t front = std::max(front_p, front_q), back = std::max(front, std::min(back_p, back_q));
  for (size_t i = 0; i < front; ++i) x[i] = x[i] - yp[i] * zp - yq[i] * zq;
  for (size_t i = back; i < m; ++i) x[i] = x[i] - yp[i] * zp - yq[i] * zq;
  x.push_back(zp);
  x.push_back(zq);
  return x;
}

}  // namespace

std::vector<Vec2> solve(const StrandSystem& system) {
  if (!system.diagonal_block.empty()) return solve_coupled(system);
  if (system.closed) {
    return system.diagonal.size() < kLeastBanded ? solve_dense(system) : solve_closed(system);
  }
  std::vector<Vec2> x = system.right;
  Pentadiagonal(system, x.size()).solve(x);
  return x;
}

}  // namespace meander
