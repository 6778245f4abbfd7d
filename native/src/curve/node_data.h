// SPDX-License-Identifier: GPL-3.0-or-later
//
// Values of the nodes of a curve.
#pragma once

#include "base/element_data.h"

namespace meander {

struct NodeElement;

/// One value for every node of a curve, which is also that of the segment that begins there.
template <class Value>
using NodeData = ElementData<NodeElement, Value>;

}  // namespace meander
