// SPDX-License-Identifier: GPL-3.0-or-later
//
// Direct solution of large sparse systems, which can be cancelled.
#pragma once

#include <complex>
#include <vector>

#include <Eigen/SparseCore>

#include "base/cancel_token.h"
#include "base/eigen.h"

namespace meander {

/// The factors P A P^T = L D L^H of a Hermitian matrix A, of which the lower triangle is read: Timothy A. Davis,
/// "Algorithm 849: a concise sparse Cholesky factorization package", ACM Trans. Math. Softw. 31, 4 (2005). Eigen's
/// SimplicialLDLT, which is the same algorithm, does not come back before it has ended (docs/decisions.md, "Factors
/// that can be cancelled"). This one does the same operations in the same order and gives the same bytes, but asks in
/// between. Eigen finds the permutation P (AMD), in one call that nothing ends: for
/// 655,362 rows and 4.6 million numbers it takes half a second.
///
/// `Number` is double or std::complex<double>.
template <class Number>
class SparseFactors {
 public:
  using Matrix = Eigen::SparseMatrix<Number>;
  using Vector = Eigen::Matrix<Number, Eigen::Dynamic, 1>;

  /// `poll` counts what is added to the sums, about a nanosecond each. Throws Failure(FailureKind::kCancelled).
  SparseFactors(const Matrix& matrix, CancelToken poll);

  /// Whether there are factors. Without them, where a diagonal number was exactly 0, nothing can be solved.
  bool exist() const { return exist_; }

  /// x of A x = b. Throws as the constructor does.
  Vector solve(const Vector& b, CancelToken poll) const;

 private:
  using Index = Eigen::Index;
  void order(const Matrix& matrix, CancelToken& poll);
  void find_columns(const Matrix& upper, CancelToken& poll);
  void factorize(const Matrix& upper, CancelToken& poll);

  Eigen::PermutationMatrix<Eigen::Dynamic> permutation_, inverse_;
  std::vector<int> parent_;      // of each row in the elimination tree, -1 for roots
  std::vector<Index> start_;     // of each column of L among the numbers below, and their end; the diagonal is 1
  // Not vectors of the standard library, which would write zeros to all of it first.
  Eigen::VectorXi row_;          // of each number
  Vector number_, diagonal_;     // L and D
  bool exist_ = true;
};

extern template class SparseFactors<double>;
extern template class SparseFactors<std::complex<double>>;

}  // namespace meander
