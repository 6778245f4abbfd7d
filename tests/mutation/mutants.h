// SPDX-License-Identifier: GPL-3.0-or-later
//
// What tests/mutation/mutate.py writes into the sources that it mutates: every operator becomes a call of one of these
// functions, with the numbers of its mutants. The variable MEANDER_MUTANT chooses one of them for the whole process.
//
//   unset  none: the program is as it was written
//   N      number N
//   -1     none, and MEANDER_REACHED names a file that receives, for every test, the mutants that it comes by
//
// Operands are evaluated once and in their order, except the second one of && and ||, which stays lazy.
#pragma once

#include <cmath>
#include <cstdlib>
#include <type_traits>

namespace mutants {

inline constexpr int kMost = 1 << 16;

inline const int active = [] {
  const char* number = std::getenv("MEANDER_MUTANT");
  return number ? std::atoi(number) : 0;
}();

/// Which mutants have been come by. Threads may write the same byte at once: they all write 1.
inline unsigned char reached[kMost];

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

// Arithmetic. Where the other operation does not exist (scalar / vector), the operand stays as it is: such a mutant is
// dropped by the script, which knows the types, or is a left operand alone.

template <class A, class B>
auto add(int id, const A& a, const B& b) {
  return is(id) ? value(a - b) : value(a + b);
}
template <class A, class B>
auto sub(int id, const A& a, const B& b) {
  return is(id) ? value(a + b) : value(a - b);
}
template <class A, class B>
auto mul(int id, const A& a, const B& b) {
  using Product = decltype(value(a * b));
  if constexpr (std::is_arithmetic_v<A> && std::is_arithmetic_v<B>) {
    if constexpr (std::is_integral_v<A> && std::is_integral_v<B>) {
      return is(id) ? value(a + b) : value(a * b);  // dividing by 0 would end the process, whatever the test
    } else {
      return is(id) ? value(a / b) : value(a * b);
    }
  } else if constexpr (std::is_same_v<Product, A>) {
    return is(id) ? value(a) : value(a * b);
  } else if constexpr (std::is_same_v<Product, B>) {
    return is(id) ? value(b) : value(a * b);
  } else {
    return is(id) ? value(-(a * b)) : value(a * b);
  }
}
template <class A, class B>
auto div(int id, const A& a, const B& b) {
  return is(id) ? value(a * b) : value(a / b);
}
template <class A, class B>
auto mod(int id, const A& a, const B& b) {
  return is(id) ? value(decltype(a % b)(a)) : value(a % b);
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
T literal(int id, T written, T other) {
  return is(id) ? other : written;
}
template <class T>
T least(int id, const T& a, const T& b) {
  return (b < a) != is(id) ? b : a;
}
template <class T>
T most(int id, const T& a, const T& b) {
  return (a < b) != is(id) ? b : a;
}

template <class A, class B>
A& add_to(int id, A& a, const B& b) {
  if (is(id)) {
    a -= b;
  } else {
    a += b;
  }
  return a;
}
template <class A, class B>
A& take_from(int id, A& a, const B& b) {
  if (is(id)) {
    a += b;
  } else {
    a -= b;
  }
  return a;
}
template <class A, class B>
A& scale_by(int id, A& a, const B& b) {
  if (is(id)) {
    a /= b;
  } else {
    a *= b;
  }
  return a;
}
template <class A, class B>
A& divide_by(int id, A& a, const B& b) {
  if (is(id)) {
    a *= b;
  } else {
    a /= b;
  }
  return a;
}

// Comparisons: the first mutant moves the bound, the second is the negation.

template <class A, class B>
bool less(int id, const A& a, const B& b) {
  return is(id) ? a <= b : (a < b) != is(id + 1);
}
template <class A, class B>
bool less_equal(int id, const A& a, const B& b) {
  return is(id) ? a < b : (a <= b) != is(id + 1);
}
template <class A, class B>
bool greater(int id, const A& a, const B& b) {
  return is(id) ? a >= b : (a > b) != is(id + 1);
}
template <class A, class B>
bool greater_equal(int id, const A& a, const B& b) {
  return is(id) ? a > b : (a >= b) != is(id + 1);
}
template <class A, class B>
bool equal(int id, const A& a, const B& b) {
  return static_cast<bool>(a == b) != is(id);
}
template <class A, class B>
bool unequal(int id, const A& a, const B& b) {
  return static_cast<bool>(a != b) != is(id);
}

/// A condition or an operand of !, negated by the mutant.
inline bool condition(int id, bool holds) { return holds != is(id); }

// a && b is written both(id, left(id, a) && right(id, b)), and || likewise. Three mutants: the other operator, the
// right operand alone, the left one alone.

/// Of &&: for a || b it works with !a && !b.
inline bool and_left(int id, bool a) { return is(id) ? !a : a || is(id + 1); }
inline bool and_right(int id, bool b) { return is(id) ? !b : b || is(id + 2); }
inline bool and_both(int id, bool all) { return all != is(id); }
/// Of ||: for a && b it works with !a || !b.
inline bool or_left(int id, bool a) { return is(id) ? !a : a && !is(id + 1); }
inline bool or_right(int id, bool b) { return is(id) ? !b : b && !is(id + 2); }
inline bool or_both(int id, bool any) { return any != is(id); }

/// Whether a statement is carried out.
inline bool keeps(int id) { return !is(id); }

}  // namespace mutants
