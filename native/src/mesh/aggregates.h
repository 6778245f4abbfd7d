// SPDX-License-Identifier: GPL-3.0-or-later
//
// Symmetric systems over the edges of a graph, and ever coarser ones of rows that are joined in pairs (Notay, "An
// aggregation-based algebraic multigrid method", 2010): the levels of a multigrid whose time is linear.
//
// Weights are real numbers, or complex ones where a value is turned on its way along an edge: a row then carries the
// value of its pair, turned once.
#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <type_traits>
#include <vector>

#include "base/cancel_token.h"
#include "base/plane.h"
#include "mesh/surface.h"

namespace meander {

/// A value that is turned on its way, or mirrored and turned, or a sum of both: z becomes turned z + mirrored conj(z).
struct Mirroring {
  Vec2 turned, mirrored;

  Vec2 of(Vec2 z) const { return turned * z + mirrored * meander::conj(z); }
};
inline Mirroring operator+(const Mirroring& a, const Mirroring& b) {
  return {a.turned + b.turned, a.mirrored + b.mirrored};
}
/// First b, then a.
inline Mirroring operator*(const Mirroring& a, const Mirroring& b) {
  return {a.turned * b.turned + a.mirrored * conj(b.mirrored), a.turned * b.mirrored + a.mirrored * conj(b.turned)};
}
/// What carries values back, where lengths stay.
inline Mirroring conj(const Mirroring& a) { return {conj(a.turned), a.mirrored}; }
/// The larger part, of length 1.
inline Mirroring unit(const Mirroring& a) {
  if (dot(a.turned, a.turned) >= dot(a.mirrored, a.mirrored)) return {unit(a.turned), {}};
  return {{}, unit(a.mirrored)};
}

/// What is off the diagonal, with the opposite sign: symmetric, or Hermitian where it is complex.
template <class Weight>
struct Couplings {
  std::vector<uint32_t> start{0}, neighbour;  ///< those of row i are start[i] .. start[i + 1] - 1
  std::vector<Weight> weight;

  uint32_t size() const { return static_cast<uint32_t>(start.size() - 1); }
  void add(uint32_t to, Weight w) {
    neighbour.push_back(to);
    weight.push_back(w);
  }
  void end_row() { start.push_back(static_cast<uint32_t>(neighbour.size())); }
};

/// Rows in pairs, or alone where no neighbour was left. Where that leaves most of them, as around a hub that is the
/// only neighbour of thousands, those that are alone join the pair of the neighbour that they are tied to most.
template <class Weight>
struct Pairs {
  static constexpr bool kTurns = !std::is_same_v<Weight, double>;
  static constexpr Weight kSame = [] {
    if constexpr (std::is_same_v<Weight, Mirroring>) {
      return Mirroring{{1, 0}, {}};
    } else if constexpr (kTurns) {
      return Vec2{1, 0};
    } else {
      return 1.0;
    }
  }();
  uint32_t count = 0;
  std::vector<uint32_t> of;    ///< per row: its pair
  std::vector<Weight> carry;   ///< per row: a unit number, times which the pair's value is the row's; empty: all are 1

  /// Joins every row to the neighbour that it is tied to most, if that one is free.
  Pairs(const Couplings<Weight>& rows, CancelToken& poll) : of(rows.size(), kNone) {
    if constexpr (kTurns) carry.assign(rows.size(), kSame);
    for (uint32_t i = 0; i < rows.size(); ++i) {
      poll();
      if (of[i] != kNone) continue;
      of[i] = count++;
      uint32_t best = kNone;
      double most = 0;
      for (uint32_t e = rows.start[i]; e < rows.start[i + 1]; ++e) {
        if (of[rows.neighbour[e]] != kNone || !(size_of(rows.weight[e]) > most)) continue;
        best = e;
        most = size_of(rows.weight[e]);
      }
      if (best == kNone) continue;
      of[rows.neighbour[best]] = of[i];
      if constexpr (kTurns) carry[rows.neighbour[best]] = unit(conj(rows.weight[best]));
    }
    if (rows.size() > kSmall && count > kMostLeft * rows.size()) join_alone(rows, poll);
  }

  /// The system of the pairs (Galerkin's).
  Couplings<Weight> joined(const Couplings<Weight>& rows, CancelToken& poll) const {
    std::vector<uint32_t> begin(count + 1, 0), members(rows.size());
    for (const uint32_t pair : of) ++begin[pair + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<uint32_t> next(begin.begin(), begin.end() - 1);
    for (uint32_t i = 0; i < rows.size(); ++i) members[next[of[i]]++] = i;
    Couplings<Weight> coarse;
    std::vector<uint32_t> place(count, kNone);  // of an edge to each pair, in the row that is being made
    for (uint32_t pair = 0; pair < count; ++pair) {
      poll();
      for (uint32_t k = begin[pair]; k < begin[pair + 1]; ++k) {
        const uint32_t i = members[k];
        for (uint32_t e = rows.start[i]; e < rows.start[i + 1]; ++e) {
          const uint32_t other = of[rows.neighbour[e]];
          if (other == pair) continue;
          Weight weight = rows.weight[e];
          if constexpr (kTurns) weight = conj(carry[i]) * weight * carry[rows.neighbour[e]];
          if (place[other] == kNone || place[other] < coarse.start.back()) {
            place[other] = static_cast<uint32_t>(coarse.neighbour.size());
            coarse.add(other, weight);
          } else {
            coarse.weight[place[other]] = coarse.weight[place[other]] + weight;
          }
        }
      }
      coarse.end_row();
    }
    return coarse;
  }

 private:
  /// Pairs that leave a larger share of the rows than this hardly make a level coarser.
  static constexpr double kMostLeft = 0.75;
  /// So few rows cost nothing, however many levels they take, and pairs keep coarse values apart longer.
  static constexpr uint32_t kSmall = 1024;

  void join_alone(const Couplings<Weight>& rows, CancelToken& poll) {
    std::vector<uint32_t> size(count, 0);
    for (const uint32_t pair : of) ++size[pair];
    for (uint32_t i = 0; i < rows.size(); ++i) {
      poll();
      if (size[of[i]] > 1) continue;
      uint32_t best = kNone;
      double most = 0;
      for (uint32_t e = rows.start[i]; e < rows.start[i + 1]; ++e) {
        if (!(size_of(rows.weight[e]) > most)) continue;
        best = e;
        most = size_of(rows.weight[e]);
      }
      if (best == kNone) continue;
      const uint32_t other = rows.neighbour[best];
      --size[of[i]];
      of[i] = of[other];
      ++size[of[i]];
      if constexpr (kTurns) carry[i] = unit(rows.weight[best]) * carry[other];
    }
    std::vector<uint32_t> number(count, 0);
    count = 0;
    for (size_t pair = 0; pair < size.size(); ++pair) {
      if (size[pair] > 0) number[pair] = count++;
    }
    for (uint32_t& pair : of) pair = number[pair];
  }

  static double size_of(double w) { return w; }
  static double size_of(Vec2 w) { return dot(w, w); }
  static double size_of(const Mirroring& w) { return dot(w.turned, w.turned) + dot(w.mirrored, w.mirrored); }
};

}  // namespace meander
