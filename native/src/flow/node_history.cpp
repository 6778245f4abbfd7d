// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/node_history.h"

namespace meander {
namespace {

template <class Value>
void carry_over(const NodeData<uint32_t>& origin, ThreadPool& pool, NodeData<Value>& values, NodeData<Value>& spare) {
  if (values.empty()) return;
  spare.resize(origin.size());
  pool.for_blocks(origin.size(), kNodeGrain, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) spare[i] = values[origin[i]];
  });
  values.swap(spare);
}

}  // namespace

void NodeHistory::follow(const NodeData<uint32_t>& origin, ThreadPool& pool, NodeHistory& spare) {
  carry_over(origin, pool, radii, spare.radii);
  carry_over(origin, pool, directions, spare.directions);
  carry_over(origin, pool, balls, spare.balls);
  carry_over(origin, pool, steps, spare.steps);
}

}  // namespace meander
