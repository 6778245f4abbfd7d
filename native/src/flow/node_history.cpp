// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/node_history.h"

namespace meander {
namespace {

/// One list after the other, each in memory of its own for as long as that takes: kept from call to call, all of them
/// together would be there a third time, beside the state and the next one.
template <class Value>
void carry_over(const NodeData<uint32_t>& origin, ThreadPool& pool, NodeData<Value>& values) {
  if (values.empty()) return;
  NodeData<Value> carried;
  carried.resize(origin.size());
  pool.for_blocks(origin.size(), kNodeGrain, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) carried[i] = values[origin[i]];
  });
  values.swap(carried);
}

}  // namespace

void NodeHistory::follow(const NodeData<uint32_t>& origin, ThreadPool& pool) {
  carry_over(origin, pool, radii);
  carry_over(origin, pool, directions);
  carry_over(origin, pool, balls);
  carry_over(origin, pool, steps);
}

}  // namespace meander
