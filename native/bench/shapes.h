// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces that need no file.
#pragma once

#include "mesh.h"

namespace meander::bench {

/// The unit sphere: 20 * 4^levels faces.
Mesh icosphere(int levels);

/// The unit sphere with bumps of a tenth of its radius.
Mesh bumpy_sphere(int levels);

/// Radii 1 and 0.4, 2 * around * across faces.
Mesh torus(uint32_t around, uint32_t across);

/// The flat unit square, 2 * n * n faces: the one surface with a boundary.
Mesh square(uint32_t n);

/// A cube with edges of length 2, cut into this many pieces along each axis: {1, 1, 1} gives 12
/// faces, {30, 30, 35} gives 12,000.
Mesh cube(const std::array<uint32_t, 3>& cuts);

}  // namespace meander::bench
