// SPDX-License-Identifier: GPL-3.0-or-later
//
// The elementary functions against the system's in a longer type, at their limits, and, byte for byte,
// against what they gave on the machine on which they were written.
#include "base/elementary.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace meander::test::elementary_tests {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Uniform numbers from 53 bits of a generator that the standard fixes; its distributions are not.
class Numbers {
 public:
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53;
  }
  /// A power of two between two exponents, times a number in [1, 2).
  double of_size(int low, int high) {
    const int exponent = low + static_cast<int>(between(0, high - low));
    return std::ldexp(between(1, 2), exponent);
  }

 private:
  std::mt19937_64 bits_{20};
};

double unit_in_the_last_place(double v) { return std::nextafter(std::abs(v), kInf) - std::abs(v); }

/// Where a longer type has 11 bits more than a double, its own rounding is a 2000th of a unit.
template <class Ours, class Theirs>
void expect_close(const char* name, double x, double y, const Ours& ours, const Theirs& theirs, double most) {
  const double value = ours(x, y);
  const long double error = (static_cast<long double>(value) - theirs(x, y)) / unit_in_the_last_place(value);
  EXPECT_LE(std::abs(static_cast<double>(error)), most) << name << " of " << x << ", " << y;
}

class Elementary : public ::testing::Test {
 protected:
  void SetUp() override {
    // Where long double is a double, as with Microsoft's compiler and on Apple's processors, its
    // functions are no better than what they would judge.
    if (std::numeric_limits<long double>::digits < 64) GTEST_SKIP() << "long double is not longer";
#ifdef _WIN32
    // Those of mingw-w64 reduce angles by a pi of 64 bits, and err by more than ours.
    GTEST_SKIP() << "the functions of long double are no judges";
#endif
  }
};

constexpr int kCount = 20000;

TEST_F(Elementary, ExponentialAndLogarithmsAreRoundedCorrectly) {
  Numbers n;
  const auto ours = [](double x, double) { return elementary::exp(x); };
  const auto theirs = [](double x, double) { return std::exp(static_cast<long double>(x)); };
  for (int k = 0; k < kCount; ++k) {
    expect_close("exp", n.between(-5, 5), 0, ours, theirs, 0.502);
    expect_close("exp", n.between(-700, 700), 0, ours, theirs, 0.502);
    expect_close("exp", n.of_size(-60, -5), 0, ours, theirs, 0.502);
  }
  const auto log = [](double x, double) { return elementary::log(x); };
  const auto long_log = [](double x, double) { return std::log(static_cast<long double>(x)); };
  const auto log1p = [](double x, double) { return elementary::log1p(x); };
  const auto long_log1p = [](double x, double) { return std::log1p(static_cast<long double>(x)); };
  for (int k = 0; k < kCount; ++k) {
    expect_close("log", n.of_size(-1000, 1000), 0, log, long_log, 0.502);
    expect_close("log", n.between(0.5, 2), 0, log, long_log, 0.502);
    expect_close("log", 1 + n.of_size(-50, -5), 0, log, long_log, 0.502);
    expect_close("log1p", n.between(-0.99, 9), 0, log1p, long_log1p, 0.502);
    expect_close("log1p", n.of_size(-70, 0), 0, log1p, long_log1p, 0.502);
  }
}

TEST_F(Elementary, PowersAreRoundedCorrectly) {
  Numbers n;
  const auto ours = [](double x, double y) { return elementary::pow(x, y); };
  const auto theirs = [](double x, double y) {
    return std::pow(static_cast<long double>(x), static_cast<long double>(y));
  };
  for (int k = 0; k < kCount; ++k) {
    expect_close("pow", n.of_size(-4, 4), n.between(-6, 6), ours, theirs, 0.502);
    expect_close("pow", n.of_size(-90, 90), n.between(-9, 9), ours, theirs, 0.53);
  }
}

TEST_F(Elementary, AnglesAreRoundedCorrectly) {
  Numbers n;
  const auto sin = [](double x, double) { return elementary::sin(x); };
  const auto cos = [](double x, double) { return elementary::cos(x); };
  const auto long_sin = [](double x, double) { return std::sin(static_cast<long double>(x)); };
  const auto long_cos = [](double x, double) { return std::cos(static_cast<long double>(x)); };
  for (int k = 0; k < kCount; ++k) {
    const double far = n.between(-1e8, 1e8), x = n.between(-7, 7), small = n.of_size(-60, -3);
    for (const double v : {far, x, small}) {
      expect_close("sin", v, 0, sin, long_sin, 0.502);
      expect_close("cos", v, 0, cos, long_cos, 0.502);
    }
  }
  const auto ours = [](double x, double y) { return elementary::atan2(y, x); };
  const auto theirs = [](double x, double y) {
    return std::atan2(static_cast<long double>(y), static_cast<long double>(x));
  };
  for (int k = 0; k < kCount; ++k) {
    expect_close("atan2", n.between(-1, 1), n.between(-1, 1), ours, theirs, 0.502);
    expect_close("atan2", n.of_size(-200, 200), n.of_size(-200, 200), ours, theirs, 0.502);
    expect_close("atan2", -n.of_size(-40, 40), -n.of_size(-40, 40), ours, theirs, 0.502);
  }
  const auto hypot = [](double x, double y) { return elementary::hypot(x, y); };
  const auto long_hypot = [](double x, double y) {
    return std::hypot(static_cast<long double>(x), static_cast<long double>(y));
  };
  for (int k = 0; k < kCount; ++k) {
    expect_close("hypot", n.between(-1, 1), n.between(-1, 1), hypot, long_hypot, 0.502);
    expect_close("hypot", n.of_size(-900, 900), n.of_size(-900, 900), hypot, long_hypot, 0.502);
  }
}

void expect_same(double a, double b) {
  if (std::isnan(b)) {
    EXPECT_TRUE(std::isnan(a)) << a;
  } else {
    EXPECT_DOUBLE_EQ(a, b);  // 4 units: the system's log1p errs more than ours
    EXPECT_EQ(std::signbit(a), std::signbit(b)) << a;
  }
}

TEST(ElementaryLimits, AreThoseOfTheCLibrary) {
  for (const double x : {0.0, 1.0, -1.0, 709.0, 710.0, -745.0, -750.0, 5e4, -5e4, kInf, -kInf, kNan}) {
    expect_same(elementary::exp(x), std::exp(x));
  }
  for (const double x : {0.0, 1.0, 2.0, -1.0, -0.5, kInf, kNan, 5e-324, 1e308}) {
    expect_same(elementary::log(x), std::log(x));
    if (x > -1) expect_same(elementary::log1p(x), std::log1p(x));
  }
  for (const double x : {0.0, -0.0, 1.0, kInf, 0.25, 4.0}) {
    for (const double y : {0.0, 1.0, -1.0, 0.5, 2.0, -2.0, 3.5, kInf, -kInf, 1e300, -1e300}) {
      expect_same(elementary::pow(std::abs(x), y), std::pow(std::abs(x), y));
    }
  }
  for (const double y : {0.0, -0.0, 1.0, -1.0, kInf, -kInf, 5e-324, 1e308, kNan}) {
    for (const double x : {0.0, -0.0, 1.0, -1.0, kInf, -kInf, 5e-324, 1e308, kNan}) {
      expect_same(elementary::atan2(y, x), std::atan2(y, x));
      if (!std::isnan(x) && !std::isnan(y)) expect_same(elementary::hypot(y, x), std::hypot(y, x));
    }
  }
  for (const double x : {0.0, -0.0, 5e-324, kInf, -kInf, kNan}) {
    expect_same(elementary::sin(x), std::sin(x));
    expect_same(elementary::cos(x), std::cos(x));
  }
  EXPECT_NEAR(elementary::sin(1e12), std::sin(1e12), 1e-3);  // a rounded multiple of 2 pi
}

/// What every platform has to print. If the functions are changed on purpose, so is this number.
TEST(ElementaryBytes, AreTheSameOnEveryPlatform) {
  Numbers n;
  uint64_t digest = 14695981039346656037u;
  const auto add = [&](double v) {
    unsigned char bytes[sizeof v];
    std::memcpy(bytes, &v, sizeof v);
    for (const unsigned char b : bytes) digest = (digest ^ b) * 1099511628211u;
  };
  for (int k = 0; k < 20000; ++k) {
    const double a = n.between(-9, 9), b = n.between(-9, 9);
    add(elementary::exp(a));
    add(elementary::log(std::abs(a)));
    add(elementary::log1p(std::abs(b)));
    add(elementary::pow(std::abs(a), b));
    add(elementary::sin(a));
    add(elementary::cos(b));
    add(elementary::atan2(a, b));
    add(elementary::hypot(a, b));
    add(std::fma(a, b, -(a * b)));
    add(std::remainder(a, b));
  }
  EXPECT_EQ(digest, 3961972523460078995u);
}

}  // namespace
}  // namespace meander::test::elementary_tests
