// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/sparse_factors.h"

#include <algorithm>

#include <Eigen/OrderingMethods>

#include "base/eigen.h"

namespace meander {

template <class Number>
SparseFactors<Number>::SparseFactors(const Matrix& matrix, CancelToken poll) {
  order(matrix, poll);
  Matrix upper(matrix.rows(), matrix.cols());
  upper.template selfadjointView<Eigen::Upper>() =
      matrix.template selfadjointView<Eigen::Lower>().twistedBy(permutation_);
  poll.now();
  find_columns(upper, poll);
  factorize(upper, poll);
}

/// A permutation with which L has few numbers.
template <class Number>
void SparseFactors<Number>::order(const Matrix& matrix, CancelToken& poll) {
  Matrix whole;
  whole = matrix.template selfadjointView<Eigen::Lower>();
  poll.now();
  Eigen::AMDOrdering<int>()(whole, inverse_);
  permutation_ = inverse_.inverse();
  poll.now();
}

/// The elimination tree, and how many numbers each column of L has.
template <class Number>
void SparseFactors<Number>::find_columns(const Matrix& upper, CancelToken& poll) {
  const auto size = static_cast<int>(upper.rows());
  parent_.assign(static_cast<size_t>(size), -1);
  start_.assign(static_cast<size_t>(size) + 1, 0);
  std::vector<int> seen_in(static_cast<size_t>(size), -1);
  for (int k = 0; k < size; ++k) {
    seen_in[k] = k;
    for (typename Matrix::InnerIterator entry(upper, k); entry; ++entry) {
      // Every row on the way to the root has a number in row k of L.
      for (int i = static_cast<int>(entry.index()); i < k && seen_in[i] != k; i = parent_[i]) {
        if (parent_[i] == -1) parent_[i] = k;
        ++start_[static_cast<size_t>(i) + 1];
        seen_in[i] = k;
        poll();
      }
    }
  }
  for (size_t k = 0; k + 1 < start_.size(); ++k) start_[k + 1] += start_[k];
  row_.resize(start_.back());
  number_.resize(start_.back());
}

/// One row of L after the other: each is the solution of a triangular system with the rows before it.
template <class Number>
void SparseFactors<Number>::factorize(const Matrix& upper, CancelToken& poll) {
  const auto size = static_cast<int>(upper.rows());
  std::vector<Index> end(start_.begin(), start_.end() - 1);  // of what each column has so far
  std::vector<Number> y(static_cast<size_t>(size));          // of the present row, all zero between two rows
  std::vector<int> pattern(static_cast<size_t>(size)), seen_in(static_cast<size_t>(size), -1);
  diagonal_.resize(size);
  for (int k = 0; k < size; ++k) {
    // Where the row has numbers, in an order in which no one needs a later one.
    int top = size;
    seen_in[k] = k;
    for (typename Matrix::InnerIterator entry(upper, k); entry; ++entry) {
      int i = static_cast<int>(entry.index());
      if (i > k) continue;
      y[i] += Eigen::numext::conj(entry.value());
      int length = 0;
      for (; seen_in[i] != k; i = parent_[i]) {
        pattern[length++] = i;
        seen_in[i] = k;
      }
      while (length > 0) pattern[--top] = pattern[--length];
    }
    double d = Eigen::numext::real(y[k]);
    y[k] = Number(0);
    for (; top < size; ++top) {
      const int i = pattern[top];
      const Number yi = y[i], l = yi / Eigen::numext::real(diagonal_[i]);
      y[i] = Number(0);
      for (Index p = start_[i]; p < end[i]; ++p) y[row_[p]] -= Eigen::numext::conj(number_[p]) * yi;
      d -= Eigen::numext::real(l * Eigen::numext::conj(yi));
      poll(static_cast<size_t>(end[i] - start_[i]) + 1);
      row_[end[i]] = k;
      number_[end[i]++] = l;
    }
    diagonal_[k] = d;
    if (d == 0) {
      exist_ = false;
      return;
    }
  }
}

template <class Number>
typename SparseFactors<Number>::Vector SparseFactors<Number>::solve(const Vector& b, CancelToken poll) const {
  Vector x = permutation_ * b;
  for (Index i = 0; i < x.size(); ++i) {
    const Number xi = x[i];
    if (xi == Number(0)) continue;
    for (Index p = start_[i]; p < start_[i + 1]; ++p) x[row_[p]] -= xi * number_[p];
    poll(static_cast<size_t>(start_[i + 1] - start_[i]) + 1);
  }
  x = diagonal_.asDiagonal().inverse() * x;
  for (Index i = x.size(); i-- > 0;) {
    Number xi = x[i];
    for (Index p = start_[i]; p < start_[i + 1]; ++p) xi -= Eigen::numext::conj(number_[p]) * x[row_[p]];
    x[i] = xi;
    poll(static_cast<size_t>(start_[i + 1] - start_[i]) + 1);
  }
  return inverse_ * x;
}

template class SparseFactors<double>;
template class SparseFactors<std::complex<double>>;

}  // namespace meander
