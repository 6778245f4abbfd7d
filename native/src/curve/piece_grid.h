// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which of many pieces in one face may meet: those that share a cell of a grid.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "curve/curve.h"

namespace meander {

/// Where a point of a face lies across it, seen from each of two sides and from the first corner: its second and third
/// weight and their sum, all exact, since they are multiples of kGrain.
inline std::array<double, 3> weights_across(Vec2 b) { return {b.x, b.y, b.x + b.y}; }

/// A grid over the pieces of a face, in those two of three weights in which they are shortest: where strands lie side
/// by side in a sliver, each across the corner at its tip, it is a row of strips along them. Keeps its memory.
class PieceGrid {
 public:
  /// Lays the grid over pieces of one face, with about as many cells as there are pieces. False, and then there are no
  /// pairs to ask for, where the pieces are so long that cells would hold more pairs than there are.
  bool lay(std::span<const Piece> pieces);

  /// Calls visit(i, j), i < j, once for each pair of pieces that share a cell. Whatever meets shares one.
  template <class Visit>
  void for_pairs(const Visit& visit) const {
    uint32_t first = 0;
    for (uint32_t cell = 0; cell < end_.size(); first = end_[cell++]) {
      for (uint32_t k = first; k < end_[cell]; ++k) {
        for (uint32_t l = k + 1; l < end_[cell]; ++l) {
          if (first_shared(in_cell_[k], in_cell_[l]) == cell) visit(in_cell_[k], in_cell_[l]);
        }
      }
    }
  }

 private:
  /// The cells that a piece may lie in.
  struct Cells {
    uint32_t left, right, low, high;
    size_t count() const { return size_t{right - left + 1} * (high - low + 1); }
  };

  void find_cells(std::span<const Piece> pieces);
  template <class Visit>
  void for_cells(const Cells& c, const Visit& visit) const {
    for (uint32_t y = c.low; y <= c.high; ++y) {
      for (uint32_t x = c.left; x <= c.right; ++x) visit(size_t{y} * columns_ + x);
    }
  }
  uint32_t first_shared(uint32_t i, uint32_t j) const {
    return std::max(cells_[i].low, cells_[j].low) * columns_ + std::max(cells_[i].left, cells_[j].left);
  }

  uint32_t columns_ = 0;
  std::vector<Cells> cells_;       // of each piece
  std::vector<uint32_t> end_;      // per cell, row by row: where its pieces end in in_cell_
  std::vector<uint32_t> in_cell_;  // pieces in rising order
};

}  // namespace meander
