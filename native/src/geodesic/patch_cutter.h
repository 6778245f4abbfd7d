// SPDX-License-Identifier: GPL-3.0-or-later
//
// How surfaces are cut into patches.
#pragma once

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/disjoint_sets.h"
#include "base/large_pages.h"
#include "base/tell.h"
#include "geodesic/constants.h"
#include "geodesic/surface_patches.h"

namespace meander {

/// Cuts a surface: first into cells, which are small faces or parts of large ones; those that touch in the same voxel
/// then make a patch.
class SurfacePatches::Cutter {
 public:
  /// Refers to all three; what it finds of the patches goes into the first.
  Cutter(SurfacePatches& patches, const Surface& surface, const RadiusField& radius)
      : patches_(patches), s_(surface), radius_(radius), least_size_(kPatchSize * radius.least()) {}

  /// What is known of the patches besides. One entry for each.
  std::vector<Vec3> centre;
  std::vector<double> area, r, coherence;  // coherence: length of the mean normal
  std::vector<uint8_t> at_crease;
  std::vector<Vec3> creases;                    // points on them, kCreaseStep apart

  /// Fills what is above, and the faces, cells and traits of the patches. Once.
  void cut(ThreadPool& pool, const Tell& tell);

 private:
  struct Cell {
    uint64_t voxel;
    Vec3 middle;
    uint32_t face;
    double area;
  };

  static uint64_t voxel(const Vec3& p, double size, uint32_t level);
  double radius_at(uint32_t f) const;
  uint32_t level_at(uint32_t f) const;
  double size_at(uint32_t level) const { return std::ldexp(least_size_, static_cast<int>(level)); }
  bool gridded(uint32_t f) const { return (patches_.patch_of_face_[f] & kGridded) != 0; }
  uint32_t cell_at(uint32_t f, Vec2 p) const;
  std::pair<uint32_t, double> longest_side(uint32_t f) const;
  void lay_out_cells(ThreadPool& pool, const Tell& tell);
  Grid grid_of(uint32_t f, uint32_t first) const;
  void lay_grid(uint32_t f);
  void meet(DisjointSets& sets, uint32_t a, uint32_t b);
  void join_empty(DisjointSets& sets, const Grid& g);
  void join_in_grids(DisjointSets& sets);
  struct Seams;
  void join_across_edges(DisjointSets& sets, ThreadPool& pool, const Tell& tell);
  void look_across(HalfEdge e, Seams& seams) const;
  void sample_crease(HalfEdge e);
  void join_slivers(DisjointSets& sets, const Tell& tell);
  void number(DisjointSets& sets);
  void list_beside(ThreadPool& pool);
  void add_up();

  SurfacePatches& patches_;
  const Surface& s_;
  const RadiusField& radius_;
  double least_size_;
  Table<Cell> cells_;
  std::vector<std::array<uint32_t, 2>> beside_;  // pairs of cells that touch, and then of patches
  std::vector<std::pair<uint32_t, Crease>> crease_cells_;
};

}  // namespace meander
