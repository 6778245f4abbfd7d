// SPDX-License-Identifier: GPL-3.0-or-later
//
// What tests/mutation/mutate.py writes into the sources that it mutates asks here which mutant is alive. The variable
// MEANDER_MUTANT chooses one for the whole process.
//
//   unset  none: the program is as it was written
//   N      number N
//   -1     none, and the file that MEANDER_REACHED names receives the numbers of the mutants that were come by
//
// Operands are evaluated once and in their order.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <type_traits>

namespace mutants {

inline constexpr int kMost = 1 << 16;

inline const int active = [] {
  const char* number = std::getenv("MEANDER_MUTANT");
  return number ? std::atoi(number) : 0;
}();

/// Which mutants have been come by. Threads may write the same byte at once: they all write 1.
inline unsigned char reached[kMost];

inline const struct Report {
  ~Report() {
    const char* path = active < 0 ? std::getenv("MEANDER_REACHED") : nullptr;
    std::FILE* file = path ? std::fopen(path, "w") : nullptr;
    if (!file) return;
    for (int id = 0; id < kMost; ++id) {
      if (reached[id]) std::fprintf(file, "%d\n", id);
    }
    std::fclose(file);
  }
} report;

inline bool is(int id) {
  if (__builtin_expect(active < 0, 0)) __atomic_store_n(&reached[id], 1, __ATOMIC_RELAXED);
  return active == id;
}

/// An expression template of Eigen would refer to operands that are gone; its value does not.
template <class T>
auto value(T&& v) {
  if constexpr (requires { v.eval(); }) {
    return v.eval();
  } else {
    return std::decay_t<T>(static_cast<T&&>(v));
  }
}

/// Instead of a product: the quotient of numbers, and the negated product of vectors and matrices, which have none.
struct NoProduct {
  template <class A, class B>
  auto operator()(const A& a, const B& b) const {
    if constexpr (std::is_integral_v<A> && std::is_integral_v<B>) {
      return a + b;  // dividing by 0 would end the process, whatever the test
    } else if constexpr (std::is_arithmetic_v<A> && std::is_arithmetic_v<B>) {
      return a / b;
    } else {
      return -(a * b);
    }
  }
};

struct Left {
  template <class A, class B>
  A operator()(const A& a, const B&) const {
    return a;
  }
};

template <class Written, class Other, class A, class B>
auto either(int id, const A& a, const B& b) {
  return is(id) ? value(Other{}(a, b)) : value(Written{}(a, b));
}

template <class Written, class Other, class A, class B>
decltype(auto) assigned(int id, A&& a, const B& b) {
  return a = either<Written, Other>(id, a, b);
}

/// The first mutant moves the bound, the second is the negation.
template <class Written, class Other, class A, class B>
bool compared(int id, const A& a, const B& b) {
  return is(id) ? Other{}(a, b) : Written{}(a, b) != is(id + 1);
}

template <class A>
auto minus(int id, const A& a) {
  return is(id) ? value(decltype(value(-a))(a)) : value(-a);
}

template <class A>
auto magnitude(int id, const A& a) {
  return is(id) ? A(a) : A(std::abs(a));
}

template <class T>
T least(int id, const T& a, const T& b) {
  return (b < a) != is(id) ? b : a;
}

template <class T>
T most(int id, const T& a, const T& b) {
  return (a < b) != is(id) ? b : a;
}

}  // namespace mutants
