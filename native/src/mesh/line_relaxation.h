// SPDX-License-Identifier: GPL-3.0-or-later
//
// A smooth field of lines in a time that grows with the number of vertices.
#pragma once

#include "mesh/vertex_geometry.h"

namespace meander {

/// A field close to the smoothest one, the least eigenvector of a connection Laplacian, which a factorization finds
/// exactly but not in linear time.
///
/// Vertices are joined in pairs along the edges that hold most, and pairs again, until every component is a single one;
/// a line of a pair is one line, carried along the edge. The coarsest field is the mean of `first`, and from level to
/// level every line becomes the mean of its neighbours, as the Laplacian weighs them, some times. The levels are those
/// of Jakob, Tarini, Panozzo and Sorkine-Hornung, "Instant Field-Aligned Meshes" (2015), as aggregates of algebraic
/// multigrid: the coarse Laplacians are Galerkin's.
///
/// `laplacian`  see VertexGeometry::line_laplacian
/// `first`      decides between fields that are equally smooth, as on a flat sheet
Lines relaxed_lines(const Eigen::SparseMatrix<Complex>& laplacian, const Lines& first, CancelPoll poll);

}  // namespace meander
