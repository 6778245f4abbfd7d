// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/solve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include <Eigen/Cholesky>

#include "base/eigen.h"
#include "model/constants.h"
#include "model/coupled_solve.h"

namespace meander {
namespace {

using Complex = std::complex<double>;

/// L D L^T of a real symmetric pentadiagonal matrix: of rows `begin` to `end` of the system.
class Pentadiagonal {
 public:
  Pentadiagonal(const StrandSystem& a, size_t begin, size_t end)
      : n_(end - begin), inverse_(n_), first_(n_), second_(n_) {
    double d1 = 0, d2 = 0;  // D of the previous node and of the one before it
    for (size_t i = 0; i < n_; ++i) {
      double d = a.diagonal[begin + i];
      double f = i + 1 < n_ ? a.first[begin + i] : 0;
      if (i >= 1) {
        d -= d1 * first_[i - 1] * first_[i - 1];
        f -= d1 * first_[i - 1] * second_[i - 1];
      }
      if (i >= 2) d -= d2 * second_[i - 2] * second_[i - 2];
      inverse_[i] = 1 / d;
      first_[i] = f * inverse_[i];
      second_[i] = (i + 2 < n_ ? a.second[begin + i] : 0) * inverse_[i];
      d2 = d1;
      d1 = d;
    }
  }

  void solve(Vec2* x) const {
    for (size_t i = 0; i < n_; ++i) forward(x, i);
    for (size_t i = n_; i-- > 0;) backward(x, i);
  }

  /// The same for a right-hand side that is zero but in its first two entries. What those cause dies
  /// away within some hundred nodes: x comes back that long, and is zero beyond.
  void solve_front(std::vector<Vec2>& x) const {
    const double least = kNegligible * (size(x[0]) + size(x[1]));
    for (size_t i = 0; i < n_; ++i) {
      if (i >= 4 && size(x[i - 1]) + size(x[i - 2]) <= least) break;
      if (i >= x.size()) x.emplace_back();
      forward(x.data(), i);
    }
    for (size_t i = x.size(); i-- > 0;) {
      x[i] = inverse_[i] * x[i];
      if (i + 1 < x.size()) x[i] = x[i] - first_[i] * x[i + 1];
      if (i + 2 < x.size()) x[i] = x[i] - second_[i] * x[i + 2];
    }
  }

  /// The same for the last two entries, given and returned in reverse order.
  void solve_back(std::vector<Vec2>& x) const {
    x[0] = x[0] - first_[n_ - 2] * x[1];
    const double least = kNegligible * (size(x[0]) + size(x[1]));
    for (size_t k = 0; k < n_; ++k) {
      if (k >= 4 && size(x[k - 1]) + size(x[k - 2]) <= least) break;
      if (k >= x.size()) x.emplace_back();
      const size_t i = n_ - 1 - k;
      x[k] = inverse_[i] * x[k];
      if (k >= 1) x[k] = x[k] - first_[i] * x[k - 1];
      if (k >= 2) x[k] = x[k] - second_[i] * x[k - 2];
    }
  }

 private:
  static double size(Vec2 v) { return std::abs(v.x) + std::abs(v.y); }
  void forward(Vec2* x, size_t i) const {
    if (i >= 1) x[i] = x[i] - first_[i - 1] * x[i - 1];
    if (i >= 2) x[i] = x[i] - second_[i - 2] * x[i - 2];
  }
  void backward(Vec2* x, size_t i) const {
    x[i] = inverse_[i] * x[i];
    if (i + 1 < n_) x[i] = x[i] - first_[i] * x[i + 1];
    if (i + 2 < n_) x[i] = x[i] - second_[i] * x[i + 2];
  }

  size_t n_;
  std::vector<double> inverse_, first_, second_;
};

Table<Vec2> solve_dense(const StrandSystem& a) {
  const size_t n = a.diagonal.size();
  const auto index = [](size_t i) { return static_cast<Eigen::Index>(i); };
  Eigen::MatrixXcd h = Eigen::MatrixXcd::Zero(index(n), index(n));
  Eigen::VectorXcd right(index(n));
  const Complex rho(a.holonomy.x, a.holonomy.y);
  for (size_t i = 0; i < n; ++i) {
    h(index(i), index(i)) += a.diagonal[i];
    right(index(i)) = Complex(a.right[i].x, a.right[i].y);
    for (size_t step = 1; step <= 2; ++step) {
      const double value = step == 1 ? a.first[i] : a.second[i];
      if (value == 0) continue;
      Complex phase = 1;
      size_t j = i + step;
      for (; j >= n; j -= n) phase *= rho;
      h(index(i), index(j)) += value * phase;
      h(index(j), index(i)) += value * std::conj(phase);
    }
  }
  const Eigen::VectorXcd z = h.ldlt().solve(right);
  Table<Vec2> out(n);
  for (size_t i = 0; i < n; ++i) out[i] = {z(index(i)).real(), z(index(i)).imag()};
  return out;
}

/// A run of nodes, solved by itself, between two pairs of nodes that part it from its neighbours.
///
/// Its couplings with a pair have two entries in each of two columns, at its outermost nodes and the
/// ones next to them, in this order. As the band is real, the two columns are the x and the y of a Vec2.
struct Chunk {
  using Columns = std::array<Vec2, 2>;

  size_t begin = 0, end = 0;
  bool has_front = false, has_back = false;
  Columns front{}, back{};
  /// What the band makes of them: from the first node on, and from the last one backwards.
  std::vector<Vec2> solved_front, solved_back;

  size_t size() const { return end - begin; }
};

/// The transposed columns times a vector whose outermost entries are v0 and v1.
std::array<Vec2, 2> project(const Chunk::Columns& columns, Vec2 v0, Vec2 v1) {
  return {columns[0].x * v0 + columns[1].x * v1, columns[0].y * v0 + columns[1].y * v1};
}

/// Solves a chunk for the right-hand side, in x, and for its couplings.
void eliminate(const StrandSystem& a, Chunk& chunk, Table<Vec2>& x) {
  const size_t n = x.size(), begin = chunk.begin, end = chunk.end;
  const Pentadiagonal band(a, begin, end);
  std::copy_n(a.right.data() + begin, end - begin, x.data() + begin);
  band.solve(x.data() + begin);
  if (chunk.has_front) {
    const size_t q = (begin + n - 1) % n, p = q - 1;
    chunk.front = {Vec2{a.second[p], a.first[q]}, Vec2{0, a.second[q]}};
    chunk.solved_front.assign(chunk.front.begin(), chunk.front.end());
    band.solve_front(chunk.solved_front);
  }
  if (chunk.has_back) {
    chunk.back = {Vec2{a.first[end - 1], a.second[end - 1]}, Vec2{a.second[end - 2], 0}};
    chunk.solved_back.assign(chunk.back.begin(), chunk.back.end());
    band.solve_back(chunk.solved_back);
  }
}

/// The first unknown of a pair, or its second (`k` 1), in the system of all pairs.
Eigen::Index row(size_t pair, int k) { return static_cast<Eigen::Index>(2 * pair) + k; }

Complex number(Vec2 v) { return {v.x, v.y}; }

/// What couples the two nodes of every pair, as if there were no chunks between the pairs.
void add_pairs(const StrandSystem& a, const std::vector<Chunk>& chunks, size_t pairs, Eigen::MatrixXcd& schur,
               Eigen::VectorXcd& right) {
  for (size_t s = 0; s < pairs; ++s) {
    const size_t p = chunks[s].end;
    for (int k = 0; k < 2; ++k) {
      schur(row(s, k), row(s, k)) = a.diagonal[p + static_cast<size_t>(k)];
      right(row(s, k)) = number(a.right[p + static_cast<size_t>(k)]);
    }
    schur(row(s, 0), row(s, 1)) = schur(row(s, 1), row(s, 0)) = a.first[p];
  }
}

/// The unknowns of the pairs: the Schur complement of the chunks, Hermitian and positive definite.
std::vector<Vec2> solve_pairs(const StrandSystem& a, const std::vector<Chunk>& chunks, const Table<Vec2>& x) {
  const size_t pairs = a.closed ? chunks.size() : chunks.size() - 1;
  const auto count = static_cast<Eigen::Index>(2 * pairs);
  Eigen::MatrixXcd schur = Eigen::MatrixXcd::Zero(count, count);
  Eigen::VectorXcd right(count);
  add_pairs(a, chunks, pairs, schur, right);
  for (size_t c = 0; c < chunks.size(); ++c) {
    const Chunk& chunk = chunks[c];
    const size_t before = (c + chunks.size() - 1) % chunks.size();
    // Past the join the unknowns are turned.
    const Complex turn = c == 0 ? number(a.holonomy) : Complex(1);
    if (chunk.has_front) {
      const auto block = project(chunk.front, chunk.solved_front[0], chunk.solved_front[1]);
      const auto vector = project(chunk.front, x[chunk.begin], x[chunk.begin + 1]);
      for (int k = 0; k < 2; ++k) {
        const Vec2 v = block[static_cast<size_t>(k)];
        schur(row(before, k), row(before, 0)) -= v.x;
        schur(row(before, k), row(before, 1)) -= v.y;
        right(row(before, k)) -= turn * number(vector[static_cast<size_t>(k)]);
      }
    }
    if (chunk.has_back) {
      const auto block = project(chunk.back, chunk.solved_back[0], chunk.solved_back[1]);
      const auto vector = project(chunk.back, x[chunk.end - 1], x[chunk.end - 2]);
      for (int k = 0; k < 2; ++k) {
        const Vec2 v = block[static_cast<size_t>(k)];
        schur(row(c, k), row(c, 0)) -= v.x;
        schur(row(c, k), row(c, 1)) -= v.y;
        right(row(c, k)) -= number(vector[static_cast<size_t>(k)]);
      }
    }
    // What reaches from one end of the chunk to the other.
    if (!chunk.has_front || chunk.solved_back.size() + 1 < chunk.size()) continue;
    const size_t last = chunk.size() - 1;
    const Vec2 v0 = last < chunk.solved_back.size() ? chunk.solved_back[last] : Vec2{};
    const auto block = project(chunk.front, v0, chunk.solved_back[last - 1]);
    for (int k = 0; k < 2; ++k) {
      const double entries[2] = {block[static_cast<size_t>(k)].x, block[static_cast<size_t>(k)].y};
      for (int l = 0; l < 2; ++l) {
        schur(row(before, k), row(c, l)) -= turn * entries[l];
        schur(row(c, l), row(before, k)) -= std::conj(turn) * entries[l];
      }
    }
  }
  const Eigen::VectorXcd z = schur.ldlt().solve(right);
  std::vector<Vec2> out(2 * pairs);
  for (size_t i = 0; i < out.size(); ++i) {
    const Complex value = z(static_cast<Eigen::Index>(i));
    out[i] = {value.real(), value.imag()};
  }
  return out;
}

void substitute(const StrandSystem& a, const std::vector<Chunk>& chunks, size_t c, const std::vector<Vec2>& pairs,
                Table<Vec2>& x) {
  const Chunk& chunk = chunks[c];
  if (chunk.has_front) {
    const size_t before = (c + chunks.size() - 1) % chunks.size();
    const Vec2 back = c == 0 ? conj(a.holonomy) : Vec2{1, 0};
    const Vec2 p = back * pairs[2 * before], q = back * pairs[2 * before + 1];
    for (size_t i = 0; i < chunk.solved_front.size(); ++i) {
      const Vec2 column = chunk.solved_front[i];
      x[chunk.begin + i] = x[chunk.begin + i] - column.x * p - column.y * q;
    }
  }
  if (chunk.has_back) {
    const Vec2 p = pairs[2 * c], q = pairs[2 * c + 1];
    for (size_t i = 0; i < chunk.solved_back.size(); ++i) {
      const Vec2 column = chunk.solved_back[i];
      x[chunk.end - 1 - i] = x[chunk.end - 1 - i] - column.x * p - column.y * q;
    }
    x[chunk.end] = p;
    x[chunk.end + 1] = q;
  }
}

std::vector<Chunk> cut(const StrandSystem& a, size_t least_chunk) {
  const size_t n = a.diagonal.size();
  const size_t count = std::clamp<size_t>(n / std::max(least_chunk, kShortestChunk), 1, kMostChunks);
  std::vector<Chunk> chunks(count);
  for (size_t c = 0; c < count; ++c) {
    chunks[c].has_front = a.closed || c > 0;
    chunks[c].has_back = a.closed || c + 1 < count;
    chunks[c].begin = c * n / count;
    chunks[c].end = (c + 1) * n / count - (chunks[c].has_back ? 2 : 0);
  }
  return chunks;
}

}  // namespace

Table<Vec2> solve(const StrandSystem& system, ThreadPool& pool, size_t least_chunk) {
  if (!system.diagonal_block.empty()) return solve_coupled(system);
  if (system.closed && system.diagonal.size() < kLeastBanded) return solve_dense(system);
  std::vector<Chunk> chunks = cut(system, least_chunk);
  Table<Vec2> x(system.right.size());
  pool.for_blocks(chunks.size(), 1, [&](size_t c, size_t, size_t) { eliminate(system, chunks[c], x); });
  if (!system.closed && chunks.size() == 1) return x;
  const std::vector<Vec2> pairs = solve_pairs(system, chunks, x);
  pool.for_blocks(chunks.size(), 1, [&](size_t c, size_t, size_t) { substitute(system, chunks, c, pairs, x); });
  return x;
}

}  // namespace meander
