// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/disjoint_sets.h"
#include "mesh/repairs.h"
#include "mesh/sheets.h"

namespace meander {
namespace {

/// Gives every fan of faces at a vertex a vertex of its own, except the first one, which keeps it. Those away from cut
/// edges are counted.
///
/// fan_of(c)   the lowest corner 3 f + k of the fan of corner c
/// is_split    per vertex: may it be split?
template <class FanOf, class IsSplit>
void part_fans(Soup& soup, const std::vector<uint8_t>& at_cut, const FanOf& fan_of, const IsSplit& is_split,
               PrepareCounts& counts) {
  CancelToken poll = soup.poll();
  std::vector<uint8_t> kept(soup.positions().size(), 0);
  for (uint32_t c = 0; c < 3 * soup.faces().size(); ++c) {
    poll();
    const uint32_t v = from(soup.faces(), c);
    if (!is_split(v)) continue;
    const uint32_t first = fan_of(c);
    if (first == c && kept[v]) {
      soup.set_corner(c, soup.copy_vertex(v));
      counts.split_vertices += !at_cut[v];
    } else if (first == c) {
      kept[v] = 1;
    } else {
      soup.set_corner(c, from(soup.faces(), first));
    }
  }
}

}  // namespace

void split_into_sheets(Soup& soup, bool join_flattest, PrepareCounts& counts) {
  const Sheets sheets = find_sheets(soup, join_flattest);
  counts.cut_edges += static_cast<uint32_t>(sheets.crowded.size());
  counts.opened_edges += static_cast<uint32_t>(sheets.opened.size());
  part_fans(soup, sheets.at_cut, [&](uint32_t c) { return sheets.fan[c]; }, [](uint32_t) { return true; }, counts);
}

void split_vertices(Soup& soup, bool bow_ties, bool crowded_edges, PrepareCounts& counts) {
  std::vector<uint8_t> at_cut(soup.positions().size(), 0);
  const auto faces = soup.faces();
  DisjointSets fans(3 * faces.size());
  for (uint32_t c = 0; c < 3 * faces.size(); ++c) {  // a face that names a vertex twice stays as it is
    if (from(faces, c) == to(faces, c)) fans.join(c, 3 * (c / 3) + (c % 3 + 1) % 3);
  }
  soup.edges()->for_each(soup.poll(), [&](const VertexPair& edge, EdgeSides sides) {
    if (sides.size() > 2 && crowded_edges) {
      ++counts.cut_edges;
      at_cut[edge[0]] = at_cut[edge[1]] = 1;
      return;
    }
    for (size_t k = 1; k < sides.size(); ++k) {
      const uint32_t one = sides[0].half_edge, other = sides[k].half_edge;
      for (const uint32_t v : edge) fans.join(corner_at(faces, one, v), corner_at(faces, other, v));
    }
  });
  const auto is_split = [&](uint32_t v) { return bow_ties || at_cut[v] || soup.at_mask()[v]; };
  part_fans(soup, at_cut, [&](uint32_t c) { return fans.find(c); }, is_split, counts);
}

}  // namespace meander
