// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/heat_flow.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "mesh/aggregates.h"
#include "mesh/constants.h"

namespace meander {
namespace {

using Points = std::vector<Vec3>;

/// A x = excess x + the sum over the edges of weight (x - x at the other end): symmetric and positive definite.
struct System {
  Couplings<double> edges;
  std::vector<double> excess, diagonal;

  uint32_t size() const { return edges.size(); }

  void add_up_diagonal() {
    diagonal = excess;
    for (uint32_t i = 0; i < size(); ++i) {
      for (uint32_t e = edges.start[i]; e < edges.start[i + 1]; ++e) diagonal[i] += edges.weight[e];
    }
  }
  Vec3 row(uint32_t i, const Points& x) const {
    Vec3 sum = diagonal[i] * x[i];
    for (uint32_t e = edges.start[i]; e < edges.start[i + 1]; ++e) sum -= edges.weight[e] * x[edges.neighbour[e]];
    return sum;
  }
  /// That of pairs that move as one.
  System joined(const Pairs<double>& pairs, ThreadPool& pool) const {
    System coarse{pairs.joined(edges, pool), std::vector<double>(pairs.count, 0), {}};
    for (uint32_t i = 0; i < size(); ++i) coarse.excess[pairs.of[i]] += excess[i];
    coarse.add_up_diagonal();
    return coarse;
  }
};

bool is_stiff(const System& system) {
  if (system.size() <= kCoarsestRows) return false;
  for (uint32_t i = 0; i < system.size(); ++i) {
    if (system.diagonal[i] > (1 + kStiffWeights) * system.excess[i]) return true;
  }
  return false;
}

/// Solves one system after another, in the memory of the first.
class Multigrid {
 public:
  Multigrid(System finest, ThreadPool& pool) : pool_(pool) {
    CancelToken poll = pool.poll(1u << 16);
    levels_.push_back({std::move(finest), {}, {}, {}, {}});
    while (is_stiff(levels_.back().system)) {
      const System& fine = levels_.back().system;
      Pairs<double> pairs(fine.edges, poll);
      const System middle = fine.joined(pairs, pool);
      const Pairs<double> fours(middle.edges, poll);
      if (10 * uint64_t{fours.count} > 9 * uint64_t{fine.size()}) break;  // hardly any edges are left
      System coarse = middle.joined(fours, pool);
      for (uint32_t& g : pairs.of) g = fours.of[g];
      levels_.back().group = std::move(pairs.of);
      levels_.push_back({std::move(coarse), {}, {}, {}, {}});
    }
    for (Level& level : levels_) {
      for (Points* points : {&level.x, &level.b, &level.next}) points->resize(level.system.size());
    }
  }

  const System& system() const { return levels_.front().system; }

  /// z, about A^-1 r; the map is linear and symmetric.
  void precondition(const Points& r, Points& z) {
    if (levels_.size() == 1) {
      for_all(r.size(), [&](uint32_t i) { z[i] = r[i] / system().diagonal[i]; });
      return;
    }
    levels_.front().b = r;
    cycle(0);
    z = levels_.front().x;
  }

  template <class Body>
  void for_all(size_t count, const Body& body) {
    pool_.for_each(count, kMeshGrain, body);
  }

 private:
  struct Level {
    System system;
    Table<uint32_t> group;  // of each row, in the next level
    Points x, b, next;
  };

  void relax(Level& level, int steps) {
    for (int step = 0; step < steps; ++step) {
      for_all(level.x.size(), [&](uint32_t i) {
        const Vec3 left = level.b[i] - level.system.row(i, level.x);
        level.next[i] = level.x[i] + kJacobiDamping / level.system.diagonal[i] * left;
      });
      level.x.swap(level.next);
    }
  }

  void cycle(size_t k) {
    Level& level = levels_[k];
    for_all(level.x.size(), [&](uint32_t i) { level.x[i] = kJacobiDamping / level.system.diagonal[i] * level.b[i]; });
    if (k + 1 == levels_.size()) return relax(level, kCoarsestSteps);
    relax(level, kHeatSteps - 1);
    for_all(level.x.size(), [&](uint32_t i) { level.next[i] = level.b[i] - level.system.row(i, level.x); });
    Level& coarse = levels_[k + 1];
    std::ranges::fill(coarse.b, Vec3::Zero());
    for (uint32_t i = 0; i < level.next.size(); ++i) coarse.b[level.group[i]] += level.next[i];
    cycle(k + 1);
    for_all(level.x.size(), [&](uint32_t i) { level.x[i] += coarse.x[level.group[i]]; });
    relax(level, kHeatSteps);
  }

  ThreadPool& pool_;
  std::vector<Level> levels_;
};

using Three = Eigen::Array3d;

/// One dot product for each coordinate, added up in the same order for any number of threads.
Three dot(const Points& a, const Points& b, ThreadPool& pool) {
  std::vector<Three> sums(ThreadPool::block_count(a.size(), kMeshGrain), Three::Zero());
  pool.for_blocks(a.size(), kMeshGrain, [&](size_t block, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) sums[block] += a[i].array() * b[i].array();
  });
  Three sum = Three::Zero();
  for (const Three& part : sums) sum += part;
  return sum;
}

Three ratio(const Three& a, const Three& b) {
  Three result = Three::Zero();
  for (int k = 0; k < 3; ++k) {
    if (b[k] != 0) result[k] = a[k] / b[k];
  }
  return result;
}

/// Conjugate gradients for the three coordinates side by side, from x on.
void solve(Multigrid& grid, const Points& b, Points& x, ThreadPool& pool, const Tell& tell) {
  const size_t n = x.size();
  Points r(n), z(n), p(n), q(n);
  grid.for_all(n, [&](uint32_t i) { r[i] = b[i] - grid.system().row(i, x); });
  grid.precondition(r, z);
  p = z;
  Three rz = dot(r, z, pool);
  const Three first = dot(r, r, pool);
  for (int k = 0; k < kMostHeatIterations; ++k) {
    grid.for_all(n, [&](uint32_t i) { q[i] = grid.system().row(i, p); });
    const Three alpha = ratio(rz, dot(p, q, pool));
    grid.for_all(n, [&](uint32_t i) {
      x[i].array() += alpha * p[i].array();
      r[i].array() -= alpha * q[i].array();
    });
    if ((dot(r, r, pool) <= kHeatResidual * kHeatResidual * first).all()) return;
    if (tell) tell((k + 1) / (k + kUsualHeatIterations));
    grid.precondition(r, z);
    const Three next = dot(r, z, pool);
    const Three beta = ratio(next, rz);
    rz = next;
    grid.for_all(n, [&](uint32_t i) { p[i].array() = z[i].array() + beta * p[i].array(); });
  }
}

/// The equations of the vertices that move, and their right-hand side.
struct Equations {
  std::vector<uint32_t> vertex;  // of each row
  System system;
  Points b, x;
};

Equations equations(const Surface& surface, const VertexData<double>& width, CancelToken poll) {
  const auto n = static_cast<uint32_t>(surface.vertex_count());
  std::vector<double> area(n, 0);
  std::vector<uint32_t> row(n, kNone), degree;
  Equations e;
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    poll();
    for (const uint32_t v : surface.face(f)) area[v] += surface.face_area(f) / 3;
  }
  for (uint32_t v = 0; v < n; ++v) {
    if (!(width[v] > 0) || !(area[v] > 0) || surface.on_boundary(v)) continue;
    row[v] = static_cast<uint32_t>(e.vertex.size());
    e.vertex.push_back(v);
    e.system.excess.push_back(area[v]);
    e.x.push_back(surface.position(v));
    e.b.push_back(area[v] * surface.position(v));
  }
  // A vertex that moves is inside of the surface: each of its edges leaves it once as a half-edge.
  const auto for_each_half_edge = [&](const auto& visit) {
    for (HalfEdge h = 0; h < 3 * surface.face_count(); ++h) {
      poll();
      const Triangle& t = surface.face(face_of(h));
      const uint32_t from = t[corner_of(h)], to = t[next_corner(corner_of(h))];
      if (row[from] != kNone) visit(h, from, to);
    }
  };
  const auto cotangent = [&](HalfEdge h) {
    const uint32_t f = face_of(h);
    const Vec2 p = surface.corner(f, prev_corner(corner_of(h)));
    const Vec2 u = surface.corner(f, corner_of(h)) - p, w = surface.corner(f, next_corner(corner_of(h))) - p;
    return std::clamp(dot(u, w) / cross(u, w), kLeastCotangent, kMostCotangent);
  };
  Couplings<double>& edges = e.system.edges;
  edges.start.assign(e.vertex.size() + 1, 0);
  for_each_half_edge([&](HalfEdge, uint32_t from, uint32_t to) {
    if (row[to] != kNone) ++edges.start[row[from] + 1];
  });
  for (size_t i = 0; i < e.vertex.size(); ++i) edges.start[i + 1] += edges.start[i];
  edges.neighbour.resize(edges.start.back());
  edges.weight.resize(edges.start.back());
  std::vector<uint32_t> next(edges.start.begin(), edges.start.end() - 1);
  for_each_half_edge([&](HalfEdge h, uint32_t from, uint32_t to) {
    const double weight = 0.25 * (cotangent(h) + cotangent(surface.twin(h))) * width[from] * width[to];
    if (row[to] == kNone) {
      e.system.excess[row[from]] += weight;
      e.b[row[from]] += weight * surface.position(to);
      return;
    }
    edges.neighbour[next[row[from]]] = row[to];
    edges.weight[next[row[from]]++] = weight;
  });
  e.system.add_up_diagonal();
  return e;
}

}  // namespace

VertexData<Vec3> smoothed_positions(const Surface& surface, const VertexData<double>& width, ThreadPool& pool,
                                    const Tell& tell) {
  VertexData<Vec3> positions(surface.vertex_count(), Vec3::Zero());
  for (uint32_t v = 0; v < positions.size(); ++v) positions[v] = surface.position(v);
  constexpr uint32_t kPieces = 1u << 16;
  TellingPoll equating(pool.poll(1), kPieces, 7 * surface.face_count(), part_of(tell, 0, kHeatEquated));
  Equations e = equations(surface, width, equating.token());
  if (e.vertex.empty()) return positions;
  Multigrid grid(std::move(e.system), pool);
  if (tell) tell(kHeatGridMade);
  solve(grid, e.b, e.x, pool, part_of(tell, kHeatGridMade, 1));
  if (tell) tell(1);
  for (size_t i = 0; i < e.vertex.size(); ++i) positions[e.vertex[i]] = e.x[i];
  return positions;
}

}  // namespace meander
