// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every function looks up a value near its argument in a table of pairs and adds a short series. What is
// larger than 2^-14 of the result is kept as a pair, so that the rounding of all the rest is below 2^-65 of it.
// The sums and products of pairs are those of T. J. Dekker, "A floating-point technique for extending the
// available precision" (1971). The compiler computes the tables, by series in pairs.
#include "base/elementary.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

#include "base/constants.h"

namespace meander::elementary {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The number high + low, where low is at most half a unit in the last place of high.
struct Pair {
  double high = 0;
  double low = 0;
};

/// a + b, exactly; |a| is at least |b|, or a is 0.
constexpr Pair sum_of_ordered(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

/// a + b, exactly.
constexpr Pair sum(double a, double b) {
  const double s = a + b;
  const double part = s - a;
  return {s, (a - (s - part)) + (b - part)};
}

/// The upper half of the digits of a number below 2^996; the rest is the lower half, exactly.
constexpr double upper(double a) {
  const double c = 134217729.0 * a;  // 2^27 + 1
  return c - (c - a);
}

/// a b, exactly.
constexpr Pair product(double a, double b) {
  const double p = a * b;
  const double au = upper(a), al = a - au;
  const double bu = upper(b), bl = b - bu;
  return {p, ((au * bu - p) + au * bl + al * bu) + al * bl};
}

constexpr Pair operator-(Pair a) { return {-a.high, -a.low}; }

constexpr Pair operator+(Pair a, Pair b) {
  Pair s = sum(a.high, b.high);
  const Pair t = sum(a.low, b.low);
  s = sum_of_ordered(s.high, s.low + t.high);
  return sum_of_ordered(s.high, s.low + t.low);
}

constexpr Pair operator*(Pair a, Pair b) {
  const Pair p = product(a.high, b.high);
  return sum_of_ordered(p.high, p.low + (a.high * b.low + a.low * b.high));
}

constexpr Pair operator/(Pair a, Pair b) {
  const double q1 = a.high / b.high;
  const Pair r1 = a + -(Pair{q1} * b);
  const double q2 = r1.high / b.high;
  const Pair r2 = r1 + -(Pair{q2} * b);
  return Pair{q1} + Pair{q2} + Pair{r2.high / b.high};
}

/// atan(x) for 0 <= x <= 1/64, or with sign 1 its hyperbolic counterpart.
constexpr Pair small_arctangent(Pair x, double sign) {
  const Pair square = x * x * Pair{sign};
  Pair power = x, total = x;
  for (double n = 3; power.high > kLeastOfSeries || power.high < -kLeastOfSeries; n += 2) {
    power = power * square;
    total = total + power / Pair{n};
  }
  return total;
}

/// e^x for small x.
constexpr Pair small_exponential(Pair x) {
  Pair term{1}, total{1};
  for (double n = 1; term.high > kLeastOfSeries; ++n) {
    term = term * x / Pair{n};
    total = total + term;
  }
  return total;
}

// Further digits than a pair holds: the third part of pi / 2 counts where an angle is near a multiple of it.
constexpr Pair kHalfPi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr Pair kHalfPiRest{-0x1.f1976b7ed8fbcp-110};
constexpr Pair kPi{2 * kHalfPi.high, 2 * kHalfPi.low};
constexpr Pair kLog2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

/// atan(j / 64), from the one before by atan a - atan b = atan((a - b) / (1 + a b)).
constexpr auto kArctangents = [] {
  std::array<Pair, kTableSteps + 1> table{};
  for (int j = 0; j < kTableSteps; ++j) {
    const Pair step = Pair{kTableSteps} / Pair{static_cast<double>(kTableSteps * kTableSteps + j * (j + 1))};
    table[static_cast<size_t>(j) + 1] = table[static_cast<size_t>(j)] + small_arctangent(step, -1);
  }
  return table;
}();

struct SineAndCosine {
  Pair sine, cosine;
};

/// The sine and cosine of j / 64, up to pi / 4.
constexpr auto kSines = [] {
  Pair sine{kTableStep}, cosine{1}, term{1};
  sine = {};
  for (double n = 1; term.high > kLeastOfSeries || term.high < -kLeastOfSeries; n += 2) {
    const Pair odd = term * Pair{kTableStep} / Pair{n};
    sine = sine + odd;
    term = -(odd * Pair{kTableStep} / Pair{n + 1});
    cosine = cosine + term;
  }
  std::array<SineAndCosine, 52> table{};
  table[0] = {{0}, {1}};
  for (size_t j = 1; j < table.size(); ++j) {
    const SineAndCosine& before = table[j - 1];
    table[j] = {before.sine * cosine + before.cosine * sine, before.cosine * cosine + -(before.sine * sine)};
  }
  return table;
}();

/// 2^(j / 64).
constexpr auto kPowers = [] {
  const Pair step = small_exponential(kLog2 * Pair{kTableStep});
  std::array<Pair, kTableSteps> table{};
  table[0] = {1};
  for (size_t j = 1; j < table.size(); ++j) table[j] = table[j - 1] * step;
  return table;
}();

/// log(i / 64) for i from kFirstLogarithm.
constexpr auto kLogarithms = [] {
  std::array<Pair, kLastLogarithm - kFirstLogarithm + 1> table{};
  const auto step = [](int i) {  // log((i + 1) / i)
    return Pair{2} * small_arctangent(Pair{1} / Pair{static_cast<double>(2 * i + 1)}, 1);
  };
  for (int i = kTableSteps; i < kLastLogarithm; ++i) {
    const auto at = static_cast<size_t>(i - kFirstLogarithm);
    table[at + 1] = table[at] + step(i);
  }
  for (int i = kTableSteps; i > kFirstLogarithm; --i) {
    const auto at = static_cast<size_t>(i - kFirstLogarithm);
    table[at - 1] = table[at] + -step(i - 1);
  }
  return table;
}();

/// x 2^n, rounded once; n may lead out of the range of numbers.
double scaled(double x, int n) {
  const auto power = [](int e) { return std::bit_cast<double>(static_cast<uint64_t>(e + 1023) << 52); };
  if (n > 1023) return x * power(1023) * power(n - 1023 > 1023 ? 1023 : n - 1023);
  if (n < -1022) return x * power(n + 600 < -1022 ? -1022 : n + 600) * power(-600);
  return x * power(n);
}

/// The exponent e of a positive number m 2^e with m in [1, 2).
int exponent_of(double x) {
  int e = 0;
  std::frexp(x, &e);
  return e - 1;
}

/// The logarithm of a positive number.
Pair log_of(Pair x) {
  int exponent = exponent_of(x.high);
  Pair m{scaled(x.high, -exponent), scaled(x.low, -exponent)};
  if (m.high > std::numbers::sqrt2) {
    m = {m.high / 2, m.low / 2};
    ++exponent;
  }
  const int i = static_cast<int>(m.high * kTableSteps + 0.5);
  const double near = i * kTableStep;
  // u = m / near - 1, below 1 / 90.
  const Pair difference = sum(m.high - near, m.low);
  const double u = difference.high / near;
  const Pair back = product(u, near);
  const double rest = ((difference.high - back.high) - back.low + difference.low) / near;
  const Pair square = product(u, u);
  const double series =
      u * square.high *
      (1.0 / 3 - u * (1.0 / 4 - u * (1.0 / 5 - u * (1.0 / 6 - u * (1.0 / 7 - u * (1.0 / 8 - u / 9))))));
  const Pair small = sum(u, -0.5 * square.high);
  const Pair whole = product(exponent, kLog2.high);
  const Pair known = whole + kLogarithms[static_cast<size_t>(i - kFirstLogarithm)];
  const Pair total = sum(known.high, small.high);
  const double low = total.low + (known.low + exponent * kLog2.low +
                                  (small.low + (series + (rest * (1 - u) - 0.5 * square.low))));
  return sum_of_ordered(total.high, low);
}

/// e to the power of a pair.
double exp_of(Pair x) {
  if (!(x.high < 710)) return x.high >= 710 ? kInfinity : kNaN;
  if (x.high < -746) return 0;
  const double steps = std::floor(x.high * (kTableSteps / std::numbers::ln2) + 0.5);
  const Pair whole = product(steps, kLog2.high * kTableStep);
  const Pair first = sum(x.high - whole.high, -whole.low);
  const Pair r = sum_of_ordered(first.high, first.low + (x.low - steps * (kLog2.low * kTableStep)));
  const int n = static_cast<int>(steps);
  const Pair& power = kPowers[static_cast<size_t>(n & (kTableSteps - 1))];
  const double z = r.high;
  const double series = z * z * (1.0 / 2 + z * (1.0 / 6 + z * (1.0 / 24 + z * (1.0 / 120 + z * (1.0 / 720)))));
  const Pair linear = product(power.high, z);
  const Pair total = sum_of_ordered(power.high, linear.high);
  const double low = total.low + (linear.low + (power.low + power.low * z + power.high * (r.low + series)));
  return scaled(total.high + low, n >> 6);
}

/// An angle less its nearest multiple of pi / 2, and the last two bits of that multiple.
struct Reduced {
  Pair angle;
  int quadrant = 0;
};

Reduced reduced(double x) {
  if (std::abs(x) > 0x1p30) x = std::fmod(x, kPi.high * 2);
  const double k = std::floor(x * (2 / std::numbers::pi) + 0.5);
  if (k == 0) return {{x}, 0};
  const Pair first = product(k, kHalfPi.high), second = product(k, kHalfPi.low);
  const Pair angle = sum(x, -first.high) + sum(-first.low, -second.high);
  return {angle + Pair{-second.low, -k * kHalfPiRest.high}, static_cast<int>(static_cast<int64_t>(k) & 3)};
}

/// The sine (or cosine) of an angle of at most pi / 4.
double sine_of(Pair angle, bool cosine) {
  const double sign = angle.high < 0 ? -1 : 1;
  const double a = sign * angle.high;
  const size_t j = static_cast<size_t>(a * kTableSteps + 0.5);
  const Pair t = sum(a - static_cast<double>(j) * kTableStep, sign * angle.low);
  const double z = t.high * t.high;
  const double sine_rest = t.high * z * (-1.0 / 6 + z * (1.0 / 120 + z * (-1.0 / 5040 + z / 362880)));
  const double cosine_rest = z * (-1.0 / 2 + z * (1.0 / 24 + z * (-1.0 / 720 + z / 40320)));
  const SineAndCosine& near = kSines[j];
  // sin(c + t) = s cos t + c sin t, and cos(c + t) = c cos t - s sin t.
  const Pair main = cosine ? near.cosine : near.sine;
  const Pair slope = cosine ? -near.sine : near.cosine;
  const Pair linear = product(slope.high, t.high);
  const Pair total = sum(main.high, linear.high);
  const double low = total.low + (linear.low + (main.low + (slope.low * t.high + slope.high * t.low +
                                                            (main.high * cosine_rest + slope.high * sine_rest))));
  const double value = total.high + low;
  return cosine ? value : sign * value;
}

/// The arctangent of y / x for 0 < y <= x, both between 2^-70 and 2^70.
Pair arctangent(double y, double x) {
  const double j = std::floor(kTableSteps * (y / x) + 0.5);
  const double near = j * kTableStep;
  // tan(a - b) = (tan a - tan b) / (1 + tan a tan b)
  const Pair down = product(near, x), along = product(near, y);
  const Pair top = sum(y - down.high, -down.low);
  const Pair bottom = Pair{x} + along;
  const double u = top.high / bottom.high;
  const Pair back = product(u, bottom.high);
  const double rest = ((top.high - back.high) - back.low + (top.low - u * bottom.low)) / bottom.high;
  const double z = u * u;
  const double series = u * z * (-1.0 / 3 + z * (1.0 / 5 + z * (-1.0 / 7 + z / 9)));
  const Pair known = kArctangents[static_cast<size_t>(j)];
  const Pair total = sum(known.high, u);
  return sum_of_ordered(total.high, total.low + (known.low + (rest + series)));
}

}  // namespace

double exp(double x) { return exp_of({x}); }

double log(double x) {
  if (!(x > 0)) return x == 0 ? -kInfinity : kNaN;
  if (x == kInfinity) return x;
  const Pair value = log_of({x});
  return value.high + value.low;
}

double log1p(double x) {
  if (!(x > -1)) return x == -1 ? -kInfinity : kNaN;
  if (x == kInfinity || std::abs(x) < 0x1p-60) return x;
  const Pair value = log_of(sum(1, x));
  return value.high + value.low;
}

double pow(double x, double y) {
  if (y == 0 || x == 1) return 1;
  if (!(x >= 0) || std::isnan(y)) return kNaN;
  if (x == 0 || x == kInfinity) return (x == 0) == (y < 0) ? kInfinity : 0;
  const Pair exponent = log_of({x});
  const double about = exponent.high * y;
  if (!(std::abs(about) < 800)) return about > 0 ? kInfinity : 0;
  return exp_of(exponent * Pair{y});
}

double sin(double x) {
  if (!(std::abs(x) < kInfinity)) return kNaN;
  if (std::abs(x) < 0x1p-30) return x;
  const Reduced r = reduced(x);
  const double value = sine_of(r.angle, (r.quadrant & 1) != 0);
  return (r.quadrant & 2) != 0 ? -value : value;
}

double cos(double x) {
  if (!(std::abs(x) < kInfinity)) return kNaN;
  const Reduced r = reduced(x);
  const double value = sine_of(r.angle, (r.quadrant & 1) == 0);
  return r.quadrant == 1 || r.quadrant == 2 ? -value : value;
}

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return kNaN;
  const bool left = std::signbit(x);
  double a = std::abs(y), b = std::abs(x);
  if (a == kInfinity && b == kInfinity) a = b = 1;
  if (a == 0 || b == kInfinity) return std::copysign(left ? kPi.high : 0, y);
  if (b == 0 || a == kInfinity) return std::copysign(kHalfPi.high, y);
  const int apart = exponent_of(a) - exponent_of(b);
  if (apart > 60) return std::copysign(kHalfPi.high, y);
  if (apart < -60) return std::copysign(left ? kPi.high : a / b, y);
  const int exponent = exponent_of(b);
  a = scaled(a, -exponent);
  b = scaled(b, -exponent);
  const bool steep = a > b;
  const Pair angle = steep ? arctangent(b, a) : arctangent(a, b);
  const Pair from = steep ? kHalfPi : left ? kPi : Pair{};
  const Pair turned = from + (steep != left ? -angle : angle);
  return std::copysign(turned.high + turned.low, y);
}

double hypot(double x, double y) {
  const double a = std::abs(x), b = std::abs(y);
  if (a == kInfinity || b == kInfinity) return kInfinity;
  const double larger = a > b ? a : b, smaller = a > b ? b : a;
  if (smaller == 0 || !(larger < kInfinity)) return larger + smaller;
  const int exponent = exponent_of(larger);
  if (exponent - exponent_of(smaller) > 60) return larger;
  const double u = scaled(larger, -exponent), v = scaled(smaller, -exponent);
  const Pair squares = product(u, u) + product(v, v);
  const double root = std::sqrt(squares.high);
  const Pair back = product(root, root);
  const double rest = ((squares.high - back.high) - back.low + squares.low) / (2 * root);
  return scaled(root + rest, exponent);
}

}  // namespace meander::elementary
