// SPDX-License-Identifier: GPL-3.0-or-later
//
// A function with every kind of operator that is mutated, and one test of it, for test_mutate.py. What the test
// does not look at has a comment: its mutants survive.
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

/// How much of [low, high] lies within [0, most], negative where they are apart; 0 for what is no interval.
double overlap(double low, double high, double most) {
  if (!(low < high) || most <= 0.0) return 0;
  return std::min(high, most) - std::max(low, 0.0);
}

/// Of n numbers from 1 on: the sum of those that are no multiples of 3.
int sum(int n) {
  int total = 0, last = 0;
  for (int k = 1; k <= n; ++k) {  // from 0 on it is the same: 0 is left out
    if (k % 3 == 0) continue;
    total += k;
    last = k;  // never read
  }
  static_cast<void>(last);
  return total;
}

double far(double x, bool squared) {
  constexpr double kHalf = 0.5;  // the compiler's, so left alone
  const double d = std::abs(-x * kHalf);
  return squared ? d * d : d / 1.0;  // by 1: no test can tell it from a product
}

}  // namespace

int main() {
  bool good = overlap(-1, 2, 3) == 2 && overlap(1, 5, 3) == 2 && overlap(1, 2, 3) == 1 && overlap(4, 5, 3) == -1;
  good = good && overlap(0.25, 0.75, 0.5) == 0.25 && overlap(2, 1, 3) == 0;
  good = good && overlap(1, 2, 0) == 0 && overlap(-3, 2, -1) == 0;
  good = good && sum(0) == 0 && sum(1) == 1 && sum(7) == 19;
  good = good && far(3, true) == 2.25 && far(3, false) == 1.5 && far(-3, false) == 1.5;
  return good ? 0 : 1;
}
