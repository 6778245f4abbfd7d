// SPDX-License-Identifier: GPL-3.0-or-later
//
// How lists grow that there are dozens of, one entry a node.
#pragma once

#include <cstddef>
#include <vector>

namespace meander {

/// vector.resize(count), with room for an eighth more where it has to find new memory. By itself a vector takes up to
/// twice what it needs, and a curve that grows in small steps would keep all of that in every list of its nodes.
template <class Value, class Memory>
void resize_closely(std::vector<Value, Memory>& values, size_t count) {
  if (count > values.capacity()) values.reserve(count + count / 8);
  values.resize(count);
}

}  // namespace meander
