// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/line_relaxation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace meander {
namespace {

/// So often lines become the means of their neighbours on each level, forwards and backwards. Not measured.
constexpr int kSweeps = 12;

constexpr uint32_t kAlone = UINT32_MAX;

/// What is off the diagonal of one row of a Laplacian.
struct Neighbour {
  uint32_t index;
  Complex number;
};

/// The Laplacian of one level, and how its lines follow from those of the next, coarser one.
struct Level {
  std::vector<size_t> start;  // per row, and the end
  std::vector<Neighbour> neighbours;
  std::vector<uint32_t> coarse;
  std::vector<Complex> carry;  // a line is this times its coarse one

  size_t size() const { return start.size() - 1; }
  auto of(size_t i) const { return std::span(neighbours).subspan(start[i], start[i + 1] - start[i]); }
};

Level finest(const Eigen::SparseMatrix<Complex>& laplacian) {
  Level level;
  level.start.push_back(0);
  for (Eigen::Index i = 0; i < laplacian.outerSize(); ++i) {
    // Columns, of a Hermitian matrix: conjugate rows.
    for (Eigen::SparseMatrix<Complex>::InnerIterator k(laplacian, i); k; ++k) {
      if (k.row() != i) level.neighbours.push_back({static_cast<uint32_t>(k.row()), std::conj(k.value())});
    }
    level.start.push_back(level.neighbours.size());
  }
  return level;
}

/// Joins every vertex with the neighbour that holds it most among those that are alone still. The number of pairs.
uint32_t pair_up(Level& level, CancelPoll& poll) {
  level.coarse.assign(level.size(), kAlone);
  level.carry.assign(level.size(), 1);
  uint32_t count = 0;
  for (size_t i = 0; i < level.size(); ++i) {
    poll();
    if (level.coarse[i] != kAlone) continue;
    const Neighbour* best = nullptr;
    for (const Neighbour& n : level.of(i)) {
      if (level.coarse[n.index] == kAlone && (!best || std::norm(n.number) > std::norm(best->number))) best = &n;
    }
    level.coarse[i] = count;
    if (best && std::norm(best->number) > 0) {
      level.coarse[best->index] = count;
      level.carry[best->index] = -std::conj(best->number) / std::sqrt(std::norm(best->number));
    }
    ++count;
  }
  return count;
}

Level coarser(const Level& fine, uint32_t count, CancelPoll& poll) {
  std::vector<std::vector<uint32_t>> members(count);
  for (uint32_t i = 0; i < fine.size(); ++i) members[fine.coarse[i]].push_back(i);
  Level level;
  level.start.push_back(0);
  std::vector<size_t> place(count, SIZE_MAX);
  for (uint32_t c = 0; c < count; ++c) {
    poll();
    const size_t first = level.neighbours.size();
    for (const uint32_t i : members[c]) {
      for (const Neighbour& n : fine.of(i)) {
        const uint32_t other = fine.coarse[n.index];
        if (other == c) continue;
        const Complex number = std::conj(fine.carry[i]) * n.number * fine.carry[n.index];
        if (place[other] == SIZE_MAX || place[other] < first) {
          place[other] = level.neighbours.size();
          level.neighbours.push_back({other, number});
        } else {
          level.neighbours[place[other]].number += number;
        }
      }
    }
    level.start.push_back(level.neighbours.size());
  }
  return level;
}

void relax(const Level& level, std::vector<Complex>& lines, CancelPoll& poll) {
  const size_t count = level.size();
  for (int sweep = 0; sweep < 2 * kSweeps; ++sweep) {
    for (size_t k = 0; k < count; ++k) {
      poll();
      const size_t i = sweep % 2 == 0 ? k : count - 1 - k;
      Complex sum = 0;
      double weight = 0;
      for (const Neighbour& n : level.of(i)) {
        sum -= n.number * lines[n.index];
        weight += std::sqrt(std::norm(n.number));
      }
      if (weight > 0) lines[i] = sum / weight;
    }
  }
}

}  // namespace

Lines relaxed_lines(const Eigen::SparseMatrix<Complex>& laplacian, const Lines& first, CancelPoll poll) {
  std::vector<Level> levels{finest(laplacian)};
  std::vector<Complex> lines(first.begin(), first.end());
  while (true) {
    Level& fine = levels.back();
    const uint32_t count = pair_up(fine, poll);
    if (count == fine.size()) break;
    std::vector<Complex> sums(count, 0);
    for (size_t i = 0; i < fine.size(); ++i) sums[fine.coarse[i]] += std::conj(fine.carry[i]) * lines[i];
    lines = std::move(sums);
    levels.push_back(coarser(fine, count, poll));
  }
  for (Complex& line : lines) {
    if (!(std::norm(line) > 0)) line = 1;
  }
  for (size_t k = levels.size() - 1; k-- > 0;) {
    const Level& level = levels[k];
    std::vector<Complex> finer(level.size());
    for (size_t i = 0; i < level.size(); ++i) finer[i] = level.carry[i] * lines[level.coarse[i]];
    lines = std::move(finer);
    relax(level, lines, poll);
    // Means of lines that disagree are short, and those of such means would vanish.
    for (Complex& line : lines) {
      const double square = std::norm(line);
      if (square > 0) line /= std::sqrt(square);
    }
  }
  Lines result(first.size());
  for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = lines[static_cast<size_t>(i)];
  return result;
}

}  // namespace meander
