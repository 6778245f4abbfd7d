// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a flow starts from: strands and density, as the caller passes them.
#pragma once

#include "api/handles.h"
#include "mesh/vertex_data.h"
#include "seed/seed.h"

namespace meander {

/// The strands of a seed; throws Failure.
SeedStrands checked_seed(const meander_seed* given);

/// The density at the vertices of the surface, or none; throws Failure.
VertexData<double> checked_density(const double* density, size_t count, const Surface& surface, const MeshMap* map);

}  // namespace meander
