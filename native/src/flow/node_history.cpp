// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/node_history.h"

namespace meander {
namespace {

template <class Value>
void carry_over(const NodeData<uint32_t>& origin, ThreadPool& pool, NodeData<Value>& values, NodeData<Value>& old) {
  if (values.empty()) return;
  old.resize(origin.size());
  pool.for_blocks(origin.size(), kNodeGrain, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) old[i] = values[origin[i]];
  });
  values.swap(old);
}

}  // namespace

void NodeHistory::follow(const NodeData<uint32_t>& origin, ThreadPool& pool) {
  try {
    carry_over(origin, pool, radii, old_radii_);
    carry_over(origin, pool, directions, old_directions_);
    carry_over(origin, pool, steps, old_steps_);
  } catch (...) {
    radii.clear();
    directions.clear();
    steps.clear();
    throw;
  }
}

}  // namespace meander
