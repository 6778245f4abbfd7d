// SPDX-License-Identifier: GPL-3.0-or-later
//
// One implicit step of the heat flow: vertices move to an average of the surface around them.
#pragma once

#include "base/tell.h"
#include "base/thread_pool.h"
#include "mesh/surface.h"
#include "mesh/vertex_data.h"

namespace meander {

/// The vertices of a surface, smoothed as by a Gaussian of the given width at each of them: x of
/// (M + L / 2) x = M x0, with the areas M of the vertices and a Laplacian L whose cotangent weights are multiplied by
/// the widths at both ends of an edge (Desbrun, Meyer, Schröder, Barr, "Implicit fairing of irregular meshes using
/// diffusion and curvature flow", 1999). Vertices of width 0 and those on the boundary stay where they are to the last
/// bit.
///
/// Solved by conjugate gradients, preconditioned by a multigrid cycle over pairs of pairs of vertices (Notay, "An
/// aggregation-based algebraic multigrid method", 2010), so that the time is linear in the vertices that move, whatever
/// the width is in edges.
///
/// `width`  of the Gaussian (sigma) at every vertex, at least 0, in the surface's own unit
VertexData<Vec3> smoothed_positions(const Surface& surface, const VertexData<double>& width, ThreadPool& pool,
                                    const Tell& tell = {});

}  // namespace meander
