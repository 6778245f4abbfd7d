// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sums over the nodes of strands that grow.
#pragma once

#include "base/thread_pool.h"
#include "curve/curve.h"

namespace meander {

/// The sum of term(i) over the nodes that are not on guides, the same for any number of threads.
template <class Term>
double sum_over_free(const Curve& curve, ThreadPool& pool, const Term& term) {
  return pool.sum(curve.size(), [&](size_t k) -> double {
    const auto i = static_cast<uint32_t>(k);
    return curve.on_guide(i) ? 0 : term(i);
  });
}

/// How many there are.
inline double free_nodes(const Curve& curve, ThreadPool& pool) {
  if (!curve.has_guides()) return static_cast<double>(curve.size());
  return sum_over_free(curve, pool, [](uint32_t) { return 1; });
}

/// The mean of term(i) over the nodes that may move, without those that are fixed; 0 where there are none.
template <class Term>
double mean_over_movable(const Curve& curve, ThreadPool& pool, const Term& term) {
  const auto movable = [&](size_t i) { return curve.fixed[i] == 0; };
  const double count = pool.sum(curve.size(), [&](size_t i) -> double { return movable(i); });
  const double sum = pool.sum(curve.size(), [&](size_t i) -> double {
    return movable(i) ? term(static_cast<uint32_t>(i)) : 0;
  });
  return count > 0 ? sum / count : 0;
}

}  // namespace meander
