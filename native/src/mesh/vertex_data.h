// SPDX-License-Identifier: GPL-3.0-or-later
//
// Values of the vertices of a surface.
#pragma once

#include "base/element_data.h"

namespace meander {

struct VertexElement;

/// One value for every vertex of a surface.
template <class Value>
using VertexData = ElementData<VertexElement, Value>;

}  // namespace meander
