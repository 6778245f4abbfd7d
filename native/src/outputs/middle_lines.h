// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lines halfway between turns of the curve, as edges of a cut mesh.
#pragma once

#include "outputs/line_distance.h"

namespace meander {

/// Cuts faces that reach from the neighbourhood of one turn of the line to that of another one along the line halfway
/// between them, where the distance has its ridges. Every face then belongs to one turn and one side. Vertices stay,
/// edges are divided, and `distance` follows. `poll` is called for every edge and face; where it throws, what is left
/// of the two is of no use.
void add_middle_lines(CutMesh& mesh, LineDistance& distance, CancelToken poll = {});

}  // namespace meander
