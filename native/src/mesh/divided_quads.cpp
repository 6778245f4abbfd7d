// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/divided_quads.h"

#include <algorithm>

namespace meander {

VertexPair DividedQuads::edge_at(uint32_t half_edge) const {
  const VertexPair ends = edge(faces_, half_edge);
  return pair_of(place_[ends[0]], place_[ends[1]]);
}

void DividedQuads::add(uint32_t one, uint32_t other, bool is_polygon) {
  const VertexPair diagonal = edge_at(one);
  std::array<uint32_t, 4> places = {diagonal[0], diagonal[1], place_[apex(faces_, one)], place_[apex(faces_, other)]};
  std::ranges::sort(places);
  if (std::ranges::adjacent_find(places) != places.end()) return;
  quads_.push_back({places, diagonal, one / 3, other / 3, is_polygon});
}

void DividedQuads::add_pair(uint32_t one, uint32_t other) { add(one, other, false); }

void DividedQuads::add_polygon(uint32_t one, uint32_t other) {
  for (uint32_t e = 3 * one; e < 3 * one + 3; ++e) {
    for (uint32_t o = 3 * other; o < 3 * other + 3; ++o) {
      if (edge_at(e) == edge_at(o)) return add(e, o, true);
    }
  }
}

void DividedQuads::add_edge_of_many(EdgeSides sides, std::span<const uint32_t> half_edges) {
  for (const auto& side : sides) at_many_[half_edges[side.half_edge] / 3] = 1;
}

std::vector<std::pair<uint32_t, uint32_t>> DividedQuads::with_both_diagonals(CancelToken poll) {
  std::ranges::stable_sort(quads_, [&](const Quad& a, const Quad& b) { return poll(), a.places < b.places; });
  std::vector<std::pair<uint32_t, uint32_t>> found;
  for (size_t i = 0, end = 0; i < quads_.size(); i = end) {
    while (end < quads_.size() && quads_[end].places == quads_[i].places) ++end;
    const std::span<const Quad> quads(quads_.data() + i, quads_.data() + end);
    if (!are_sides(quads)) continue;
    for (const Quad& quad : quads) found.emplace_back(quad.one, quad.other);
  }
  return found;
}

bool DividedQuads::are_sides(std::span<const Quad> quads) const {
  const auto is_like_the_first = [&](const Quad& quad) { return quad.diagonal == quads[0].diagonal; };
  if (std::ranges::all_of(quads, is_like_the_first)) return false;
  return std::ranges::all_of(quads, &Quad::is_polygon) || std::ranges::any_of(quads, [&](const Quad& quad) {
           return at_many_[quad.one] || at_many_[quad.other];
         });
}

}  // namespace meander
