// SPDX-License-Identifier: GPL-3.0-or-later
//
// The edges of any list of triangles, and the faces at each, however many: the one table of edges for all that need
// not be a surface yet.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/large_pages.h"
#include "base/thread_pool.h"

namespace meander {

using Triangle = std::array<uint32_t, 3>;

/// An edge by its vertices, the lower one first.
using VertexPair = std::array<uint32_t, 2>;
inline VertexPair pair_of(uint32_t a, uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// The half-edge 3 f + k goes from corner k of face f to the next one, and has the third one as its apex.
inline uint32_t from(std::span<const Triangle> faces, uint32_t e) { return faces[e / 3][e % 3]; }
inline uint32_t to(std::span<const Triangle> faces, uint32_t e) { return faces[e / 3][(e % 3 + 1) % 3]; }
inline uint32_t apex(std::span<const Triangle> faces, uint32_t e) { return faces[e / 3][(e % 3 + 2) % 3]; }
inline VertexPair edge(std::span<const Triangle> faces, uint32_t e) { return pair_of(from(faces, e), to(faces, e)); }
/// The corner of its face at one end of it, as 3 f + k.
inline uint32_t corner_at(std::span<const Triangle> faces, uint32_t e, uint32_t vertex) {
  return from(faces, e) == vertex ? e : 3 * (e / 3) + (e % 3 + 1) % 3;
}

/// Half-edges in groups: those between the same two vertices are one, in rising order. A value; any thread may read it.
class EdgeGroups {
 public:
  /// A half-edge as seen from the lower of its ends.
  struct HalfOfEdge {
    uint32_t high;  ///< its other end
    uint32_t half_edge;

    uint64_t order() const { return uint64_t{high} << 32 | half_edge; }
  };

  /// Those of faces.
  EdgeGroups(std::span<const Triangle> faces, size_t vertex_count, ThreadPool& pool)
      : sides_(3 * faces.size()), end_(vertex_count + 1, 0) {
    group(
        [faces](size_t begin, size_t end, const auto& visit) {
          auto side = static_cast<uint32_t>(begin);
          for (const Triangle& face : faces.subspan(begin / 3, (end - begin) / 3)) {
            for (size_t k = 0; k < 3; ++k) visit(side++, face[k], face[k == 2 ? 0 : k + 1]);
          }
        },
        pool);
  }

  /// Those of which `ends(i)` is the VertexPair, i < count.
  template <class Ends>
  EdgeGroups(size_t count, size_t vertex_count, const Ends& ends, ThreadPool& pool)
      : sides_(count), end_(vertex_count + 1, 0) {
    group(
        [&ends](size_t begin, size_t end, const auto& visit) {
          for (auto i = static_cast<uint32_t>(begin); i < end; ++i) {
            const VertexPair pair = ends(i);
            visit(i, pair[0], pair[1]);
          }
        },
        pool);
  }

  /// Calls visit(edge, sides) for the edges of which v is the lower end, by the other one.
  template <class Visit>
  void at_vertex(uint32_t v, const Visit& visit) const {
    std::span<const HalfOfEdge> left(sides_.data() + begin_of(v), sides_.data() + end_[v]);
    while (!left.empty()) {
      size_t count = 1;
      while (count < left.size() && left[count].high == left[0].high) ++count;
      visit(VertexPair{v, left[0].high}, left.first(count));
      left = left.subspan(count);
    }
  }

  /// The same for all edges, by both their ends, between which `poll` is asked.
  template <class Visit>
  void for_each(CancelToken poll, const Visit& visit) const {
    for (uint32_t v = 0; v + 1 < end_.size(); ++v) {
      at_vertex(v, visit);
      poll(1 + end_[v] - begin_of(v));
    }
  }

  /// The sides of one edge.
  std::span<const HalfOfEdge> of(const VertexPair& edge) const {
    const auto by_high = [](const HalfOfEdge& a, const HalfOfEdge& b) { return a.high < b.high; };
    const auto [first, last] = std::equal_range(sides_.begin() + begin_of(edge[0]), sides_.begin() + end_[edge[0]],
                                                HalfOfEdge{edge[1], 0}, by_high);
    return {first, last};
  }

 private:
  /// Sorts half-edges into `sides_`. `those_of(begin, end, visit)` calls visit(i, a, b) for the half-edges i of a range
  /// that begins at a multiple of three, between vertices a and b.
  template <class ThoseOf>
  void group(const ThoseOf& those_of, ThreadPool& pool) {
    // A counting sort: in the second pass `end_` is where the next side of a vertex goes. Every thread reads all
    // half-edges and handles some of the vertices, so that the sides of a vertex come in their order whatever the
    // number of threads. With more than a few threads reading would dominate.
    constexpr unsigned kMostReaders = 4;
    const size_t count = sides_.size(), vertex_count = end_.size() - 1;
    const size_t share = vertex_count / std::min(pool.size(), kMostReaders) + 1;
    // The pool asks whether to go on once for each of its loops here.
    constexpr size_t kAtOnce = size_t{3} << 18;
    const auto each = [&](const auto& put) {
      for (size_t first = 0; first < count; first += kAtOnce) {
        pool.for_blocks(vertex_count, share, [&](size_t, size_t begin, size_t end) {
          those_of(first, std::min(count, first + kAtOnce), [&](uint32_t i, uint32_t a, uint32_t b) {
            const uint32_t low = std::min(a, b);
            if (low >= begin && low < end) put(low, HalfOfEdge{std::max(a, b), i});
          });
        });
      }
    };
    each([&](uint32_t low, const HalfOfEdge&) { ++end_[low + 1]; });
    for (size_t v = 0; v < vertex_count; ++v) end_[v + 1] += end_[v];
    each([&](uint32_t low, const HalfOfEdge& side) { sides_[end_[low]++] = side; });
    pool.for_each(vertex_count, kMeshGrain, [&](uint32_t v) {
      std::sort(sides_.begin() + begin_of(v), sides_.begin() + end_[v],
                [](const HalfOfEdge& a, const HalfOfEdge& b) { return a.order() < b.order(); });
    });
  }

  std::ptrdiff_t begin_of(size_t v) const { return v == 0 ? 0 : end_[v - 1]; }

  Table<HalfOfEdge> sides_;           // by their lower ends, and then by their other ones
  std::vector<uint32_t> end_;  // per vertex
};

using EdgeSides = std::span<const EdgeGroups::HalfOfEdge>;

}  // namespace meander
