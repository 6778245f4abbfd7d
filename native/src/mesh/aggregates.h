// SPDX-License-Identifier: GPL-3.0-or-later
//
// Symmetric systems over the edges of a graph, and ever coarser ones of rows that are joined in pairs (Notay, "An
// aggregation-based algebraic multigrid method", 2010): the levels of a multigrid whose time is linear.
//
// Weights are real numbers, or complex ones where a value is turned on its way along an edge: a row then carries the
// value of its pair, turned once.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/cancel_token.h"
#include "base/large_pages.h"
#include "base/plane.h"
#include "base/spare_memory.h"
#include "base/thread_pool.h"
#include "mesh/constants.h"
#include "mesh/surface.h"

namespace meander {

/// A value that is turned on its way, or mirrored and turned, or a sum of both: z becomes turned z + mirrored conj(z).
struct Mirroring {
  Vec2 turned, mirrored;
};
inline Vec2 operator*(const Mirroring& m, Vec2 z) { return m.turned * z + m.mirrored * conj(z); }
inline double norm(const Mirroring& m) { return std::sqrt(dot(m.turned, m.turned) + dot(m.mirrored, m.mirrored)); }
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
  Table<uint32_t> start{0}, neighbour;  ///< those of row i are start[i] .. start[i + 1] - 1
  Table<Weight> weight;

  uint32_t size() const { return static_cast<uint32_t>(start.size() - 1); }
  void add(uint32_t to, Weight w) {
    neighbour.push_back(to);
    weight.push_back(w);
  }
  void end_row() { start.push_back(static_cast<uint32_t>(neighbour.size())); }

  /// `count` rows, made in blocks: fill(begin, end, rows) appends those from begin on to others. Some blocks at a time,
  /// so that little stands twice.
  template <class Fill>
  static Couplings in_blocks(size_t count, ThreadPool& pool, const Fill& fill) {
    constexpr size_t kAtATime = 16 * kMeshGrain;
    Couplings all;
    for (size_t first = 0; first < count; first += kAtATime) {
      const size_t rows = std::min(kAtATime, count - first);
      std::vector<Couplings> blocks(ThreadPool::block_count(rows, kMeshGrain));
      pool.for_blocks(rows, kMeshGrain, [&](size_t block, size_t begin, size_t end) {
        fill(static_cast<uint32_t>(first + begin), static_cast<uint32_t>(first + end), blocks[block]);
      });
      if (first == 0 && rows == count && blocks.size() == 1) return std::move(blocks[0]);
      if (first == 0) all.reserve_as(blocks, rows, count);
      all.append(blocks, rows, pool);
    }
    return all;
  }

 private:
  /// Room for `count` rows with about as many entries each as the first ones have, `rows` in these blocks.
  void reserve_as(const std::vector<Couplings>& blocks, size_t rows, size_t count) {
    double entries = 0;
    for (const Couplings& block : blocks) entries += block.start.back();
    if (rows < count) entries *= kMoreOfRows * static_cast<double>(count) / static_cast<double>(rows);
    start.reserve(count + 1);
    neighbour.reserve(static_cast<size_t>(entries));
    weight.reserve(static_cast<size_t>(entries));
  }

  /// `rows` rows in blocks, which are left empty.
  void append(std::vector<Couplings>& blocks, size_t rows, ThreadPool& pool) {
    const size_t before = size();
    std::vector<uint32_t> first;  // of the entries of each block
    uint32_t entries = start.back();
    for (const Couplings& block : blocks) {
      first.push_back(entries);
      entries += block.start.back();
    }
    start.resize(before + rows + 1);
    neighbour.resize(entries);
    weight.resize(entries);
    pool.for_blocks(rows, kMeshGrain, [&](size_t k, size_t begin, size_t) {
      Couplings& block = blocks[k];
      for (size_t i = 1; i < block.start.size(); ++i) start[before + begin + i] = first[k] + block.start[i];
      std::copy(block.neighbour.begin(), block.neighbour.end(), neighbour.begin() + first[k]);
      std::copy(block.weight.begin(), block.weight.end(), weight.begin() + first[k]);
      block = {};
    });
  }
};

/// Per row one over its weights and that of what holds it; 0 where it has none. `held` is what holds rows, times the
/// weight of that.
template <class Weight>
std::vector<double> shares_of_rows(const Couplings<Weight>& rows, const std::vector<Vec2>& held) {
  std::vector<double> shares(rows.size(), 0);
  for (size_t i = 0; i < shares.size(); ++i) {
    double weight = norm(held[i]);
    for (uint32_t e = rows.start[i]; e < rows.start[i + 1]; ++e) weight += norm(rows.weight[e]);
    if (weight > 0) shares[i] = 1 / weight;
  }
  return shares;
}

/// Values become the mean of their neighbours and of what holds them, forwards and backwards as often as `sweeps` says
/// (Gauss and Seidel). Those with a share of 0 stay.
template <class Weight, class Values>
void relax(const Couplings<Weight>& rows, const std::vector<Vec2>& held, const std::vector<double>& shares, int sweeps,
           Values& values, CancelToken& poll) {
  const size_t count = rows.size();
  for (int sweep = 0; sweep < 2 * sweeps; ++sweep) {
    for (size_t k = 0; k < count; ++k) {
      poll();
      const size_t i = sweep % 2 == 0 ? k : count - 1 - k;
      if (!(shares[i] > 0)) continue;
      Vec2 sum = held[i];
      for (uint32_t e = rows.start[i]; e < rows.start[i + 1]; ++e) {
        sum = sum + rows.weight[e] * values[rows.neighbour[e]];
      }
      values[i] = shares[i] * sum;
    }
  }
}

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
  Table<uint32_t> of;   ///< per row: its pair
  Table<Weight> carry;  ///< per row: a unit number, times which the pair's value is the row's; empty: all are 1

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
    if (rows.size() > kFewRows && count > kMostLeftRows * rows.size()) join_alone(rows, poll);
  }

  /// The system of the pairs (Galerkin's).
  Couplings<Weight> joined(const Couplings<Weight>& rows, ThreadPool& pool) const {
    std::vector<uint32_t> begin(count + 1, 0), members(rows.size());
    for (const uint32_t pair : of) ++begin[pair + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<uint32_t> next(begin.begin(), begin.end() - 1);
    for (uint32_t i = 0; i < rows.size(); ++i) members[next[of[i]]++] = i;
    SpareMemory<std::vector<uint32_t>> spare;
    return Couplings<Weight>::in_blocks(count, pool, [&](uint32_t first, uint32_t last, Couplings<Weight>& coarse) {
      std::vector<uint32_t> place = spare.take();  // of an edge to each pair, in the row that is being made
      place.resize(count, kNone);
      for (uint32_t pair = first; pair < last; ++pair) {
        for (uint32_t k = begin[pair]; k < begin[pair + 1]; ++k) add_row(rows, members[k], pair, place, coarse);
        for (uint32_t e = coarse.start.back(); e < coarse.neighbour.size(); ++e) place[coarse.neighbour[e]] = kNone;
        coarse.end_row();
      }
      spare.give_back(std::move(place));
    });
  }

 private:

  void add_row(const Couplings<Weight>& rows, uint32_t i, uint32_t pair, std::vector<uint32_t>& place,
               Couplings<Weight>& coarse) const {
    for (uint32_t e = rows.start[i]; e < rows.start[i + 1]; ++e) {
      const uint32_t other = of[rows.neighbour[e]];
      if (other == pair) continue;
      Weight weight = rows.weight[e];
      if constexpr (kTurns) weight = conj(carry[i]) * weight * carry[rows.neighbour[e]];
      if (place[other] == kNone) {
        place[other] = static_cast<uint32_t>(coarse.neighbour.size());
        coarse.add(other, weight);
      } else {
        coarse.weight[place[other]] = coarse.weight[place[other]] + weight;
      }
    }
  }

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
