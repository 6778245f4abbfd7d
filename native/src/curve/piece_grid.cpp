// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/piece_grid.h"

#include <cmath>
#include <functional>
#include <numeric>

#include "curve/constants.h"

namespace meander {
namespace {

/// The pieces in one of the weights: from where to where, and what their extents come to one after the other.
struct Extent {
  size_t weight;
  double low = 1, high = 0, sum = 0;

  void add(double a, double b) {
    low = std::min({low, a, b});
    high = std::max({high, a, b});
    sum += std::abs(b - a);
  }
  /// How many of n pieces lie side by side, on an average; at most all.
  double across(double n) const { return sum > 0 ? std::min(n, n * (high - low) / sum) : n; }
  uint32_t cell(double value, double cells) const {
    return high > low ? static_cast<uint32_t>(std::clamp((value - low) / (high - low) * cells, 0.0, cells - 1)) : 0;
  }
};

}  // namespace

void PieceGrid::find_cells(std::span<const Piece> pieces) {
  std::array<Extent, 3> extents{{{0}, {1}, {2}}};
  for (const Piece& p : pieces) {
    const auto from = weights_across(p.from), to = weights_across(p.to);
    for (size_t k = 0; k < 3; ++k) extents[k].add(from[k], to[k]);
  }
  const double n = static_cast<double>(pieces.size());
  std::ranges::sort(extents, std::greater(), [n](const Extent& e) { return e.across(n); });
  const auto& [x, y, longest] = extents;
  const double finer = std::min(kFinestPieceCell, std::sqrt(n / (x.across(n) * y.across(n))));
  const double columns = std::clamp(std::round(finer * x.across(n)), 1.0, n);
  const double rows = std::clamp(std::round(finer * y.across(n)), 1.0, std::ceil(n / columns));
  cells_.clear();
  for (const Piece& p : pieces) {
    const auto from = weights_across(p.from), to = weights_across(p.to);
    const uint32_t x0 = x.cell(from[x.weight], columns), x1 = x.cell(to[x.weight], columns);
    const uint32_t y0 = y.cell(from[y.weight], rows), y1 = y.cell(to[y.weight], rows);
    cells_.push_back({std::min(x0, x1), std::max(x0, x1), std::min(y0, y1), std::max(y0, y1)});
  }
  columns_ = static_cast<uint32_t>(columns);
  end_.assign(static_cast<size_t>(columns * rows), 0);
}

bool PieceGrid::lay(std::span<const Piece> pieces) {
  find_cells(pieces);
  const size_t count = pieces.size();
  const double n = static_cast<double>(count);
  size_t entries = 0, pairs = 0;
  for (const Cells& c : cells_) entries += c.count();
  // With c cells for each of n pieces, n cells hold n c^2 / 2 pairs.
  const bool short_enough = entries < UINT32_MAX && static_cast<double>(entries) <= n * std::sqrt(n);
  if (short_enough) {
    for (const Cells& c : cells_) for_cells(c, [&](size_t cell) { pairs += end_[cell]++; });
  }
  if (!short_enough || pairs > count * (count - 1) / 2) {
    end_.clear();
    return false;
  }
  std::exclusive_scan(end_.begin(), end_.end(), end_.begin(), uint32_t{0});
  in_cell_.resize(entries);
  for (uint32_t i = 0; i < count; ++i) {
    for_cells(cells_[i], [&](size_t cell) { in_cell_[end_[cell]++] = i; });
  }
  return true;
}

}  // namespace meander
