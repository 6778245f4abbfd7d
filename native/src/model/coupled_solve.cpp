// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/coupled_solve.h"

#include <cmath>

#include <Eigen/Cholesky>

#include "base/eigen.h"
#include "model/constants.h"

namespace meander {
namespace {

using Block = Eigen::Matrix2d;

Block block_of(double number, const Sym2& m) {
  Block b;
  b << number + m.xx, m.xy, m.xy, number + m.yy;
  return b;
}

Block rotation(Vec2 by) {
  Block b;
  b << by.x, -by.y, by.y, by.x;
  return b;
}

Block diagonal(const StrandSystem& a, size_t i) { return block_of(a.diagonal[i], a.diagonal_block[i]); }
/// Couplings with the next node and with the one after it, in the frame that continues past a join.
Block first(const StrandSystem& a, size_t i) { return block_of(a.first[i], a.first_block[i]); }
Block second(const StrandSystem& a, size_t i) { return block_of(a.second[i], Sym2{}); }

/// The inverse of the lower Cholesky factor of a symmetric positive definite block.
Block inverse_factor(const Block& d) {
  const double a = 1 / std::sqrt(d(0, 0)), low = d(1, 0) * a;
  const double c = 1 / std::sqrt(d(1, 1) - low * low);
  Block inverse;
  inverse << a, 0, -low * a * c, c;
  return inverse;
}

/// L L^T of the leading n x n blocks, for right-hand sides of `kColumns` columns. (L D L^T with blocks
/// loses the symmetry of D to rounding, which then grows.)
template <int kColumns>
class BlockPentadiagonal {
 public:
  using Rows = Eigen::Matrix<double, 2, kColumns>;
  using Right = std::vector<Rows>;

  BlockPentadiagonal(const StrandSystem& a, size_t n) : inverse_(n), first_(n), second_(n) {
    for (size_t i = 0; i < n; ++i) {
      Block d = diagonal(a, i), f = i + 1 < n ? first(a, i) : Block::Zero();
      if (i >= 1) {
        d -= first_[i - 1].transpose() * first_[i - 1];
        f -= first_[i - 1].transpose() * second_[i - 1];
      }
      if (i >= 2) d -= second_[i - 2].transpose() * second_[i - 2];
      inverse_[i] = inverse_factor(d);
      first_[i] = inverse_[i] * f;
      second_[i] = i + 2 < n ? Block(inverse_[i] * second(a, i)) : Block(Block::Zero());
    }
  }

  void solve(Right& x) const {
    for (size_t i = 0; i < x.size(); ++i) {
      if (i >= 1) x[i] -= first_[i - 1].transpose() * x[i - 1];
      if (i >= 2) x[i] -= second_[i - 2].transpose() * x[i - 2];
      x[i] = inverse_[i] * x[i];
    }
    for (size_t i = x.size(); i-- > 0;) {
      if (i + 1 < x.size()) x[i] -= first_[i] * x[i + 1];
      if (i + 2 < x.size()) x[i] -= second_[i] * x[i + 2];
      x[i] = inverse_[i].transpose() * x[i];
    }
  }

 private:
  // Of the factor: inverses of its diagonal blocks, and its blocks right of them.
  std::vector<Block> inverse_, first_, second_;
};

Table<Vec2> solve_coupled_open(const StrandSystem& a) {
  const size_t n = a.diagonal.size();
  BlockPentadiagonal<1>::Right x(n);
  for (size_t i = 0; i < n; ++i) x[i] << a.right[i].x, a.right[i].y;
  BlockPentadiagonal<1>(a, n).solve(x);
  Table<Vec2> z(n, Vec2{});
  for (size_t i = 0; i < n; ++i) z[i] = {x[i](0), x[i](1)};
  return z;
}

Table<Vec2> solve_coupled_dense(const StrandSystem& a) {
  const auto at = [](size_t i) { return static_cast<Eigen::Index>(2 * i); };
  const size_t n = a.diagonal.size();
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(at(n), at(n));
  Eigen::VectorXd right(at(n));
  const Block turn = rotation(a.holonomy);
  for (size_t i = 0; i < n; ++i) {
    h.block<2, 2>(at(i), at(i)) += diagonal(a, i);
    right.segment<2>(at(i)) << a.right[i].x, a.right[i].y;
    for (size_t step = 1; step <= 2; ++step) {
      Block value = step == 1 ? first(a, i) : second(a, i);
      size_t j = i + step;
      for (; j >= n; j -= n) value = value * turn;
      h.block<2, 2>(at(i), at(j)) += value;
      h.block<2, 2>(at(j), at(i)) += value.transpose();
    }
  }
  const Eigen::VectorXd x = h.ldlt().solve(right);
  Table<Vec2> z(n, Vec2{});
  for (size_t i = 0; i < n; ++i) z[i] = {x(at(i)), x(at(i) + 1)};
  return z;
}

Table<Vec2> solve_coupled_closed(const StrandSystem& a) {
  // Unknowns 0 .. m - 1 are banded; p = m and q = m + 1 border them. Column 0 is the right-hand side,
  // columns 1 and 2 are the couplings with p, 3 and 4 those with q.
  const size_t n = a.diagonal.size(), m = n - 2, p = m, q = m + 1;
  const Block back = rotation(a.holonomy).transpose();
  using Solver = BlockPentadiagonal<5>;
  Solver::Right x(m, Solver::Rows::Zero());
  for (size_t i = 0; i < m; ++i) x[i].col(0) << a.right[i].x, a.right[i].y;
  const auto to_p = [](auto& rows) { return rows.template middleCols<2>(1); };
  const auto to_q = [](auto& rows) { return rows.template middleCols<2>(3); };
  to_p(x[m - 2]) += second(a, m - 2);
  to_p(x[m - 1]) += first(a, m - 1);
  to_q(x[m - 1]) += second(a, m - 1);
  to_p(x[0]) += back * second(a, p);
  to_q(x[0]) += back * first(a, q).transpose();
  to_q(x[1]) += back * second(a, q);
  const size_t touched[4] = {0, 1, m - 2, m - 1};  // different ones, as n >= kLeastBanded
  Eigen::Matrix<double, 2, 4> coupling[4];
  for (int t = 0; t < 4; ++t) coupling[t] = x[touched[t]].rightCols<4>();
  Solver(a, m).solve(x);

  Eigen::Matrix4d schur;
  schur << diagonal(a, p), first(a, p), first(a, p).transpose(), diagonal(a, q);
  Eigen::Vector4d right(a.right[p].x, a.right[p].y, a.right[q].x, a.right[q].y);
  for (int t = 0; t < 4; ++t) {
    schur -= coupling[t].transpose() * x[touched[t]].rightCols<4>();
    right -= coupling[t].transpose() * x[touched[t]].col(0);
  }
  const Eigen::Vector4d border = schur.ldlt().solve(right);
  Table<Vec2> z(n, Vec2{});
  for (size_t i = 0; i < m; ++i) {
    const Eigen::Vector2d v = x[i].col(0) - x[i].rightCols<4>() * border;
    z[i] = {v(0), v(1)};
  }
  z[p] = {border(0), border(1)};
  z[q] = {border(2), border(3)};
  return z;
}

}  // namespace

Table<Vec2> solve_coupled(const StrandSystem& system) {
  if (!system.closed) return solve_coupled_open(system);
  return system.diagonal.size() < kLeastBanded ? solve_coupled_dense(system) : solve_coupled_closed(system);
}

}  // namespace meander
