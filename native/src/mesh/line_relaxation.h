// SPDX-License-Identifier: GPL-3.0-or-later
//
// A smooth field of lines in a time that grows with the number of faces.
#pragma once

#include <span>

#include "base/thread_pool.h"
#include "mesh/line_field.h"

namespace meander {

/// A field close to the smoothest one, the least eigenvector of a connection Laplacian, which a factorization finds
/// exactly but not in linear time. Without `along_boundary`, it is parallel to the x-axis on a flat sheet.
///
/// Faces have a line each. They are joined in pairs across the edges that hold most, and pairs again, until every
/// component is a single one; a line of a pair is one line, carried across the edge. The coarsest field is the mean of
/// the directions of least bending, with a little of the x-axis, and from level to level every line becomes the mean of
/// its neighbours some times. The levels are those of Jakob, Tarini, Panozzo and Sorkine-Hornung, "Instant
/// Field-Aligned Meshes" (2015), as aggregates of algebraic multigrid: the coarse Laplacians are Galerkin's. Lines are
/// carried by unfolding faces about their edges, so that not an angle has to be computed.
///
/// `turn`            a number of length 1, with half of whose angle the lines are turned at first: without a boundary
///                   that holds them they stay turned, and are as smooth
/// `along_boundary`  the boundary holds lines along itself, as much as another face would beyond it
/// `holding`         per face, or nothing: the square of a line that holds its own, times how much it does, where 1 is
///                   as much as what is across an edge as long as the way across it
LineField relaxed_field(const Surface& surface, Vec2 turn, bool along_boundary, ThreadPool& pool,
                        std::span<const Vec2> holding = {});

/// Along the boundary in the faces beside it, and the mean of those in the faces between, as far as kLineSweeps
/// faces away: for strips of a few faces across. No direction elsewhere. Every face has one line: between two legs of a
/// zigzag that are a face or two long, means around corners would lie across both.
LineField field_along_boundary(const Surface& surface, ThreadPool& pool);

}  // namespace meander
