// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/strand_solver.h"

#include "model/constants.h"
#include "model/solve.h"

namespace meander {
namespace {

/// Shorter strands are one chunk each, which is nothing to share.
bool is_long(const Strand& strand) { return strand.count >= 2 * kLeastChunk; }

}  // namespace

void StrandSolver::for_strands(const Curve& curve, ThreadPool& pool,
                               const std::function<void(const Strand&, ThreadPool&, StrandSystem&)>& body) {
  for (const Strand& strand : curve.strands) {
    if (is_long(strand)) body(strand, pool, system_);
  }
  pool.for_blocks(curve.strands.size(), 1, [&](size_t, size_t begin, size_t end) {
    ThreadPool alone(1);
    StrandSystem system;
    for (size_t s = begin; s < end; ++s) {
      if (!is_long(curve.strands[s])) body(curve.strands[s], alone, system);
    }
  });
}

}  // namespace meander
