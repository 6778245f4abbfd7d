// SPDX-License-Identifier: GPL-3.0-or-later
//
// The factors of sparse systems: those of Eigen, to the last byte.
#include <gtest/gtest.h>

#include <climits>
#include <complex>
#include <cstring>
#include <random>
#include <vector>

#include <Eigen/SparseCholesky>

#include "mesh/sparse_factors.h"

namespace meander::test::sparse_factors_tests {
namespace {

template <class Number>
Number random_number(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  if constexpr (std::is_same_v<Number, double>) {
    return uniform(random);
  } else {
    const double real = uniform(random);
    return {real, uniform(random)};
  }
}

/// Hermitian, with the pattern of a grid and some entries anywhere; the larger the diagonal, the more surely definite.
template <class Number>
Eigen::SparseMatrix<Number> random_matrix(int side, double diagonal, std::mt19937& random) {
  const int size = side * side;
  std::vector<Eigen::Triplet<Number>> entries;
  const auto join = [&](int i, int j) {
    if (i == j) return;
    const Number number = random_number<Number>(random);
    entries.emplace_back(i, j, number);
    entries.emplace_back(j, i, Eigen::numext::conj(number));
  };
  std::uniform_int_distribution<int> any(0, size - 1);
  for (int i = 0; i < size; ++i) {
    entries.emplace_back(i, i, diagonal * (1 + 0.1 * any(random) / size));
    if (i % side > 0) join(i, i - 1);
    if (i >= side) join(i, i - side);
    if (i % 10 == 0) join(i, any(random));
  }
  Eigen::SparseMatrix<Number> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <class Number>
class SparseFactorsOf : public testing::Test {};
using Numbers = testing::Types<double, std::complex<double>>;
TYPED_TEST_SUITE(SparseFactorsOf, Numbers);

TYPED_TEST(SparseFactorsOf, SolveAsEigenDoes) {
  using Factors = SparseFactors<TypeParam>;
  std::mt19937 random(7);
  for (const int side : {1, 2, 5, 17, 40}) {
    for (const double diagonal : {12.0, 2.0}) {  // definite, and not
      const typename Factors::Matrix matrix = random_matrix<TypeParam>(side, diagonal, random);
      typename Factors::Vector b(matrix.rows());
      for (TypeParam& x : b) x = random_number<TypeParam>(random);
      const Factors factors(matrix, {});
      const Eigen::SimplicialLDLT<typename Factors::Matrix> eigen(matrix);
      ASSERT_TRUE(factors.exist());
      ASSERT_EQ(eigen.info(), Eigen::Success);
      const typename Factors::Vector x = factors.solve(b, {}), expected = eigen.solve(b);
      ASSERT_EQ(x.size(), expected.size());
      EXPECT_EQ(std::memcmp(x.data(), expected.data(), static_cast<size_t>(x.size()) * sizeof(TypeParam)), 0) << side;
      constexpr double kRounding = 1e-10;
      if (diagonal > 10) {
        EXPECT_LT((matrix * x - b).norm(), kRounding * b.norm());
      }
    }
  }
}

TYPED_TEST(SparseFactorsOf, DoNotExistWithoutADiagonal) {
  typename SparseFactors<TypeParam>::Matrix matrix(3, 3);
  for (const int k : {0, 2}) matrix.insert(k, k) = TypeParam(1);
  EXPECT_FALSE(SparseFactors<TypeParam>(matrix, {}).exist());
}

TYPED_TEST(SparseFactorsOf, AskAllTheWhile) {
  constexpr uint32_t kPieces = 50;
  std::mt19937 random(8);
  const auto matrix = random_matrix<TypeParam>(20, 12, random);
  typename SparseFactors<TypeParam>::Vector b(matrix.rows());
  b.setOnes();
  int asked = 0, last = INT_MAX;
  const auto question = [&] { return asked++ == last; };
  const CancelToken cancel = CancelToken(question).every(kPieces);
  const SparseFactors<TypeParam> factors(matrix, cancel);
  const int in_factors = asked;
  EXPECT_GT(in_factors, 100);
  factors.solve(b, cancel);
  const int in_solution = asked - in_factors;
  EXPECT_GT(in_solution, 5);
  for (last = 0; last < in_factors; ++last) {
    asked = 0;
    EXPECT_THROW(SparseFactors<TypeParam>(matrix, cancel), Failure);
  }
  for (last = 0; last < in_solution; ++last) {
    asked = 0;
    EXPECT_THROW(factors.solve(b, cancel), Failure);
  }
}

}  // namespace
}  // namespace meander::test::sparse_factors_tests
