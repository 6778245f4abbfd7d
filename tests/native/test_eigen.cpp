// SPDX-License-Identifier: GPL-3.0-or-later
//
// In which order Eigen adds up, against plain loops: bit for bit, since curves have the same bytes on every platform.
#include "base/eigen.h"

#include <bit>
#include <cmath>
#include <complex>
#include <cstdint>
#include <random>
#include <vector>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

namespace meander::test::eigen_tests {
namespace {

using Complex = std::complex<double>;

static_assert(Eigen::internal::packet_traits<double>::size == 2, "packets are not ours");

constexpr int kDraws = 200;

/// Numbers of many sizes, so that another order of a sum nearly always rounds to another number.
class Draws {
 public:
  template <typename Matrix>
  Matrix matrix(Eigen::Index rows, Eigen::Index columns = 1) {
    Matrix drawn(rows, columns);
    for (auto& value : drawn.reshaped()) value = next(value);
    return drawn;
  }
  Eigen::Vector3d three() { return matrix<Eigen::Vector3d>(3); }

 private:
  double next(double) {
    const double number = static_cast<double>(static_cast<int64_t>(bits_())) * 0x1p-63;
    return std::ldexp(number, static_cast<int>(bits_() % 8));
  }
  Complex next(Complex) {
    const double real = next(0.0);
    return {real, next(0.0)};
  }
  std::mt19937_64 bits_{57};
};

double sum_of_three(double a, double b, double c) { return (a + b) + c; }
double dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return sum_of_three(a[0] * b[0], a[1] * b[1], a[2] * b[2]);
}

/// Of `width` sums side by side, as many numbers further each; the second half is added to the first.
template <typename Number>
Number sum_in_order(const std::vector<Number>& v, size_t width) {
  const size_t half = width / 2;
  const auto add = [&](std::vector<Number>& sums, size_t at) {
    for (size_t k = 0; k < half; ++k) sums[k] += v[at + k];
  };
  if (v.size() < half) return v[0];
  std::vector<Number> first(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(half)), second(half);
  size_t at = half;
  if (v.size() >= width) {
    for (size_t k = 0; k < half; ++k) second[k] = v[at + k];
    for (at = width; at + width <= v.size(); at += width) {
      add(first, at);
      add(second, at + half);
    }
    for (size_t k = 0; k < half; ++k) first[k] += second[k];
    if (at + half <= v.size()) {
      add(first, at);
      at += half;
    }
  }
  Number sum = first[0];
  for (size_t k = 1; k < half; ++k) sum += first[k];
  for (; at < v.size(); ++at) sum += v[at];
  return sum;
}

TEST(Eigen, AddsTheFirstTwoOfThree) {
  Draws draws;
  int other = 0;
  for (int k = 0; k < kDraws; ++k) {
    const Eigen::Vector3d a = draws.three(), b = draws.three(), c = draws.three(), d = a - b;
    EXPECT_EQ(a.dot(b), dot(a, b));
    EXPECT_EQ((a - b).dot(c), dot(d, c));
    EXPECT_EQ(a.squaredNorm(), dot(a, a));
    EXPECT_EQ((a - b).squaredNorm(), dot(d, d));
    EXPECT_EQ(a.norm(), std::sqrt(dot(a, a)));
    EXPECT_EQ(a.sum(), sum_of_three(a[0], a[1], a[2]));
    EXPECT_EQ(a.normalized(), Eigen::Vector3d(a / std::sqrt(dot(a, a))));
    EXPECT_EQ(a.cross(b).squaredNorm(), dot(a.cross(b).eval(), a.cross(b).eval()));
    const Eigen::Vector3d outside = a.cwiseMax(b).cwiseMax(0);
    EXPECT_EQ(a.cwiseMax(b).cwiseMax(0).squaredNorm(), dot(outside, outside));
    other += a.dot(b) != a[0] * b[0] + (a[1] * b[1] + a[2] * b[2]);
  }
  EXPECT_GT(other, kDraws / 10);  // the draws tell orders apart
}

TEST(Eigen, AddsLongSumsFourAtATime) {
  Draws draws;
  for (Eigen::Index n = 1; n < 40; ++n) {
    const auto v = draws.matrix<Eigen::VectorXd>(n), w = draws.matrix<Eigen::VectorXd>(n);
    std::vector<double> products;
    for (Eigen::Index i = 0; i < n; ++i) products.push_back(v[i] * w[i]);
    EXPECT_EQ(v.dot(w), sum_in_order(products, 4)) << n;
    const auto z = draws.matrix<Eigen::VectorXcd>(n);
    EXPECT_EQ(z.sum(), sum_in_order(std::vector<Complex>(z.begin(), z.end()), 2)) << n;
  }
}

TEST(Eigen, MultipliesMatricesColumnByColumn) {
  Draws draws;
  for (int k = 0; k < kDraws; ++k) {
    const auto a = draws.matrix<Eigen::Matrix<double, 2, 4>>(2, 4);
    const auto b = draws.matrix<Eigen::Vector4d>(4);
    const Eigen::Vector2d product = a * b;
    for (Eigen::Index i = 0; i < 2; ++i) {
      EXPECT_EQ(product[i], ((a(i, 0) * b[0] + a(i, 1) * b[1]) + a(i, 2) * b[2]) + a(i, 3) * b[3]);
    }
  }
}

TEST(Eigen, DividesComplexNumbersByOneFormula) {
  Draws draws;
  for (int k = 0; k < kDraws; ++k) {
    const auto a = draws.matrix<Eigen::VectorXcd>(1), b = draws.matrix<Eigen::VectorXcd>(1);
    const Complex numerator = a[0] * std::conj(b[0]);
    const double size = b[0].real() * b[0].real() + b[0].imag() * b[0].imag();
    const Eigen::VectorXcd quotient = a.cwiseQuotient(b);
    EXPECT_EQ(quotient[0], Complex(numerator.real() / size, numerator.imag() / size));
  }
}

/// What the small systems of a strand are solved by, byte for byte against what it gave with the packets of x86-64.
TEST(Eigen, SolvesAsOnTheMachineOnWhichItWasWritten) {
  Draws draws;
  uint64_t hash = 14695981039346656037u;
  const auto add = [&](double value) { hash = (hash ^ std::bit_cast<uint64_t>(value)) * 1099511628211u; };
  for (Eigen::Index n = 1; n < 20; ++n) {
    auto real = draws.matrix<Eigen::MatrixXd>(n, n);
    real.diagonal().array() += 1000;
    for (const double x : real.ldlt().solve(draws.matrix<Eigen::VectorXd>(n)).eval()) add(x);
    auto turned = draws.matrix<Eigen::MatrixXcd>(n, n);
    turned.diagonal().array() += 1000;
    for (const Complex z : turned.ldlt().solve(draws.matrix<Eigen::VectorXcd>(n)).eval()) {
      add(z.real());
      add(z.imag());
    }
  }
  EXPECT_EQ(hash, 2107158166867127530u);
}

}  // namespace
}  // namespace meander::test::eigen_tests
