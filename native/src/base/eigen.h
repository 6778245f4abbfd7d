// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <complex>
#include <cstring>

#include <Eigen/Core>
#include <Eigen/Geometry>

// Eigen with the same vectors on every platform: two doubles.
//
// Eigen adds up in the order of its packets: with two doubles in a packet three numbers are (a0 + a1) + a2, without
// packets a0 + (a1 + a2), and with four in a packet a long sum is yet another. Which packets there are is up to the
// processor and the options of the compiler. So Eigen's own are off (cmake/library.cmake), and it computes with these,
// which GCC and Clang compile for any processor. A product and a sum are rounded one after the other, never fused.
//
// No other file includes Eigen/Core or Eigen/Geometry (tests/core/test_native_rooms.py).

#if !defined(EIGEN_DONT_VECTORIZE) || !defined(EIGEN_VECTORIZE)
#error "define EIGEN_DONT_VECTORIZE and EIGEN_VECTORIZE, or sums depend on the processor"
#endif
#if EIGEN_WORLD_VERSION != 3 || EIGEN_MAJOR_VERSION != 4
#error "these are packets for Eigen 3.4"
#endif

namespace Eigen::internal {

using TwoDoubles = double __attribute__((vector_size(16)));

// An expression is added up by packets where packets can do all of its operations: these as for x86-64.
template <>
struct packet_traits<double> : default_packet_traits {
  using type = TwoDoubles;
  using half = TwoDoubles;
  enum { Vectorizable = 1, AlignedOnScalar = 1, size = 2, HasHalfPacket = 0, HasDiv = 1 };
};

template <>
struct unpacket_traits<TwoDoubles> {
  using type = double;
  using half = TwoDoubles;
  enum { size = 2, alignment = Aligned16, vectorizable = true };
  enum { masked_load_available = false, masked_store_available = false };
};

template <>
EIGEN_STRONG_INLINE TwoDoubles pset1<TwoDoubles>(const double& a) {
  return TwoDoubles{a, a};
}
template <>
EIGEN_STRONG_INLINE TwoDoubles ploadu<TwoDoubles>(const double* from) {
  TwoDoubles a;
  std::memcpy(&a, from, sizeof a);
  return a;
}
template <>
EIGEN_STRONG_INLINE TwoDoubles pload<TwoDoubles>(const double* from) {
  return ploadu<TwoDoubles>(static_cast<const double*>(__builtin_assume_aligned(from, 16)));
}
template <>
EIGEN_STRONG_INLINE void pstoreu<double>(double* to, const TwoDoubles& a) {
  std::memcpy(to, &a, sizeof a);
}
template <>
EIGEN_STRONG_INLINE void pstore<double>(double* to, const TwoDoubles& a) {
  pstoreu(static_cast<double*>(__builtin_assume_aligned(to, 16)), a);
}
template <>
EIGEN_STRONG_INLINE TwoDoubles pmin<TwoDoubles>(const TwoDoubles& a, const TwoDoubles& b) {
  return b < a ? b : a;
}
template <>
EIGEN_STRONG_INLINE TwoDoubles pmax<TwoDoubles>(const TwoDoubles& a, const TwoDoubles& b) {
  return a < b ? b : a;
}
template <>
EIGEN_STRONG_INLINE TwoDoubles pabs<TwoDoubles>(const TwoDoubles& a) {
  return TwoDoubles{std::abs(a[0]), std::abs(a[1])};
}
template <>
EIGEN_STRONG_INLINE double predux<TwoDoubles>(const TwoDoubles& a) {
  return a[0] + a[1];
}

// A complex number is a packet by itself, so that a long sum is that of every other number, and that of the rest.
template <>
struct packet_traits<std::complex<double>> : default_packet_traits {
  using type = std::complex<double>;
  using half = std::complex<double>;
  enum { Vectorizable = 1, AlignedOnScalar = 0, size = 1, HasHalfPacket = 0, HasDiv = 1 };
  enum { HasAbs = 0, HasAbs2 = 0, HasMin = 0, HasMax = 0, HasSetLinear = 0 };
};

// By one formula: run-time libraries of compilers scale quotients in their own ways.
template <>
EIGEN_STRONG_INLINE std::complex<double> pdiv<std::complex<double>>(const std::complex<double>& a,
                                                                    const std::complex<double>& b) {
  return a * std::conj(b) / (b.real() * b.real() + b.imag() * b.imag());
}

}  // namespace Eigen::internal
