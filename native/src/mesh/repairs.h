// SPDX-License-Identifier: GPL-3.0-or-later
//
// The passes that make a surface of a soup, each for one kind of fault. What only looks for a fault names it to people
// (mesh_faults.h), and says to the pass beside it what there is to repair: what is found is what is repaired.
//
// A pass adds what it did to the counts. All of them poll the soup's cancel, take a time that is about linear in
// vertices and faces, and depend on no distance but those that they are given and the size of the soup.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/tell.h"
#include "mesh/soup.h"

namespace meander {

/// What was done; see meander_surface_statistics.
struct PrepareCounts {
  uint32_t unused_vertices = 0, merged_vertices = 0, dropped_faces = 0, split_vertices = 0, cut_edges = 0,
           masked_faces = 0, clipped_faces = 0, welded_edges = 0, opened_edges = 0, doubled_faces = 0, split_edges = 0,
           small_parts = 0;
};

// ------------------------------------------------------------------------------------------------
// masks.cpp: what the caller leaves out

/// Leaves out the faces where the mask, with a value for each of the caller's faces, is 0.
void mask_faces(Soup& soup, std::span<const uint8_t> mask, PrepareCounts& counts);

/// Cuts away the parts where values, one for each of the caller's vertices, are below the threshold, along straight
/// lines across faces.
void clip(Soup& soup, std::span<const double> values, double threshold, PrepareCounts& counts);

// ------------------------------------------------------------------------------------------------
// doubled_polygons.cpp: two-sided faces, and copies in the same place

/// See find_doubled_polygons.
void drop_doubled_polygons(Soup& soup, std::span<const uint32_t> polygons, PrepareCounts& counts,
                           const Tell& tell = {});

// ------------------------------------------------------------------------------------------------
// near_vertices.cpp: vertices that are meant to be one

/// Vertices within `distance` of one with a lower index, which is not merged itself, become that one.
void merge_vertices(Soup& soup, double distance, PrepareCounts& counts);

// ------------------------------------------------------------------------------------------------
// empty_faces.cpp: faces that add nothing to a surface

/// Faces whose height over the longest side is not above a share of the soup's diagonal, rising.
std::vector<uint32_t> faces_without_area(const Soup& soup, double share);
/// Takes them out such that no slit is left: a short edge becomes a vertex; a face with a corner on its longest edge is
/// left out, and the one beyond that edge divided at the corner.
void dissolve_faces_without_area(Soup& soup, PrepareCounts& counts);
/// Leaves out those that cannot be dissolved, such as pieces that a mask has cut off.
void drop_faces_without_area(Soup& soup, PrepareCounts& counts);

/// Faces that have the vertices of one with a lower index, rising. None has a vertex twice.
std::vector<uint32_t> doubled_faces(Soup& soup);
void drop_doubled_faces(Soup& soup, PrepareCounts& counts);

// ------------------------------------------------------------------------------------------------
// flat_collapses.cpp: flat faces that stay flat whatever is divided

/// Lets flat faces lose an edge, the shortest of those along which a vertex can go to the other end while every face
/// stays in its plane and every border on its line, by the height below which a face counts as flat. Some faces at a
/// time: false if there was none to do it with.
bool collapse_flat_faces(Soup& soup, std::span<const uint32_t> flat, PrepareCounts& counts);

// ------------------------------------------------------------------------------------------------
// edge_splits.cpp and seams.cpp, which find them: boundary edges that lie on each other

/// Splits boundary edges at the vertices that lie on them, and divides their faces. True if there were any.
bool split_edges(Soup& soup, double distance, PrepareCounts& counts);
/// Makes boundary edges that lie on each other one. True if there were any.
bool weld_seams(Soup& soup, double distance, PrepareCounts& counts);

// ------------------------------------------------------------------------------------------------
// fans.cpp: vertices at which several fans of faces meet, which get a vertex each

/// After the faces have been parted into sheets; see find_sheets.
void split_into_sheets(Soup& soup, bool join_flattest, PrepareCounts& counts);
/// Where faces stay neighbours at edges with more than two: at bow-ties, at such edges if they are to be cut, and where
/// a mask has taken out what joined the fans.
void split_vertices(Soup& soup, bool bow_ties, bool crowded_edges, PrepareCounts& counts);

// ------------------------------------------------------------------------------------------------
// small_parts.cpp

/// Leaves out parts whose bounding box has a diagonal below `size`. Throws Failure(FailureKind::kInvalidMesh) where
/// that would be all of them.
void drop_small_parts(Soup& soup, double size, PrepareCounts& counts);

}  // namespace meander
