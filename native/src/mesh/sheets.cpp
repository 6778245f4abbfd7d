// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/sheets.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/disjoint_sets.h"
#include "mesh/constants.h"
#include "mesh/mesh_check.h"

namespace meander {
namespace {

using Vec3 = Eigen::Vector3d;

/// Half-edges as in edge_groups.h.
class Sheeting {
 public:
  explicit Sheeting(Soup& soup)
      : poll_(soup.poll()), positions_(soup.positions()), faces_(soup.faces()), edges_(soup.edges()),
        twin_(3 * faces_.size(), kNoTwin), flipped_(faces_.size(), 0) {
    sheets_.at_cut.assign(positions_.size(), 0);
  }

  Sheets find(bool join_flattest) {
    pair_faces();
    if (join_flattest && !sheets_.crowded.empty()) pair_crowded();
    if (disagreeing_) open_one_sided();
    do {
      join_corners();
    } while (part_what_meets_again());
    return std::move(sheets_);
  }

 private:
  uint32_t from(uint32_t e) const { return meander::from(faces_, e); }
  VertexPair edge(uint32_t e) const { return meander::edge(faces_, e); }
  uint32_t corner_at(uint32_t e, uint32_t vertex) const { return meander::corner_at(faces_, e, vertex); }
  double turn(uint32_t one, uint32_t other, const VertexPair& at) const {
    return turn_at_edge(positions_, at, apex(faces_, one), apex(faces_, other));
  }

  void pair_faces();
  void pair_crowded();
  void open_one_sided();
  bool flood(uint32_t start, bool may_cut, std::vector<uint8_t>& seen, std::vector<uint32_t>& queue);
  void cut_folds(std::span<const uint32_t> faces);
  void open(uint32_t e);
  void join_corners();
  bool part_what_meets_again();
  bool part(std::span<const uint32_t> half_edges);
  void pair(uint32_t one, uint32_t other) {
    twin_[one] = other;
    twin_[other] = one;
    disagreeing_ = disagreeing_ || from(one) == from(other);
  }
  void unpair(uint32_t e) {
    if (twin_[e] == kNoTwin) return;
    twin_[twin_[e]] = kNoTwin;
    twin_[e] = kNoTwin;
  }
  void mark_cut(const VertexPair& edge) { sheets_.at_cut[edge[0]] = sheets_.at_cut[edge[1]] = 1; }

  CancelToken poll_;
  std::span<const Vec3> positions_;
  std::span<const Triangle> faces_;
  std::shared_ptr<const EdgeGroups> edges_;
  std::vector<uint32_t> twin_;      // per half-edge
  std::vector<uint8_t> flipped_;    // per face: 1 if it is to be flipped for its sheet to agree
  bool disagreeing_ = false;        // some neighbours are wound alike
  Sheets sheets_;
};

void Sheeting::pair_faces() {
  edges_->for_each(poll_, [&](const VertexPair& edge, EdgeSides sides) {
    if (sides.size() == 2) pair(sides[0].half_edge, sides[1].half_edge);
    if (sides.size() <= 2) return;
    sheets_.crowded.push_back(edge);
    mark_cut(edge);
  });
}

void Sheeting::pair_crowded() {
  DisjointSets parts(faces_.size());  // faces that are neighbours in any case
  for (uint32_t e = 0; e < twin_.size(); ++e) {
    poll_();
    if (twin_[e] != kNoTwin) parts.join(e / 3, twin_[e] / 3);
  }
  // Disagreeing, of different parts, turn, half-edges.
  std::vector<std::tuple<bool, bool, double, uint32_t, uint32_t>> pairs;
  for (const VertexPair& edge : sheets_.crowded) {
    const EdgeSides group = edges_->of(edge);
    poll_(group.size() * group.size());
    if (group.size() > kMostAtEdge) continue;
    pairs.clear();
    for (size_t i = 0; i < group.size(); ++i) {
      for (size_t j = i + 1; j < group.size(); ++j) {
        const uint32_t one = group[i].half_edge, other = group[j].half_edge;
        const bool apart = parts.find(one / 3) != parts.find(other / 3);
        pairs.emplace_back(from(one) == from(other), apart, turn(one, other, edge), one, other);
      }
    }
    std::ranges::sort(pairs);
    for (const auto& [disagreeing, apart, turn, one, other] : pairs) {
      if (twin_[one] == kNoTwin && twin_[other] == kNoTwin) pair(one, other);
    }
  }
}

/// Only where a component cannot be oriented it is cut: first where faces lie folded on each other, wound alike, as
/// where a tessellation runs over itself, since there every face is wound well; what is one-sided still, where the
/// flood meets itself.
void Sheeting::open_one_sided() {
  std::vector<uint8_t> seen(faces_.size(), 0);
  std::vector<uint32_t> queue;
  for (uint32_t start = 0; start < faces_.size(); ++start) {
    if (seen[start] || flood(start, false, seen, queue)) continue;
    cut_folds(queue);
    for (const uint32_t f : queue) seen[f] = flipped_[f] = 0;
    flood(start, true, seen, queue);
  }
  std::sort(sheets_.opened.begin(), sheets_.opened.end());
}

/// A flood from face to face, as the check of meshes has it. Where it meets itself with the other orientation, the
/// surface is cut if it may be; false if it did. `queue` becomes the faces that were reached.
bool Sheeting::flood(uint32_t start, bool may_cut, std::vector<uint8_t>& seen, std::vector<uint32_t>& queue) {
  bool two_sided = true;
  seen[start] = 1;
  queue.assign(1, start);
  for (size_t head = 0; head < queue.size(); ++head) {
    poll_();
    const uint32_t f = queue[head];
    for (uint32_t e = 3 * f; e < 3 * f + 3; ++e) {
      if (twin_[e] == kNoTwin) continue;
      const uint32_t g = twin_[e] / 3;
      const auto wanted = static_cast<uint8_t>(flipped_[f] ^ (from(e) == from(twin_[e]) ? 1 : 0));
      if (!seen[g]) {
        seen[g] = 1;
        flipped_[g] = wanted;
        queue.push_back(g);
      } else if (flipped_[g] != wanted) {
        two_sided = false;
        if (may_cut) open(e);
      }
    }
  }
  return two_sided;
}

void Sheeting::cut_folds(std::span<const uint32_t> faces) {
  for (const uint32_t f : faces) {
    poll_();
    for (uint32_t e = 3 * f; e < 3 * f + 3; ++e) {
      const uint32_t twin = twin_[e];
      if (twin == kNoTwin || from(e) != from(twin)) continue;
      if (turn(e, twin, {from(e), to(faces_, e)}) >= kFoldedTurn) open(e);
    }
  }
}

/// Parts the faces of an edge, which is named unless it has been as one with more than two.
void Sheeting::open(uint32_t e) {
  if (!std::binary_search(sheets_.crowded.begin(), sheets_.crowded.end(), edge(e))) sheets_.opened.push_back(edge(e));
  mark_cut(edge(e));
  unpair(e);
}

void Sheeting::join_corners() {
  DisjointSets fans(twin_.size());
  for (uint32_t e = 0; e < twin_.size(); ++e) {
    poll_();
    if (twin_[e] == kNoTwin || twin_[e] < e) continue;
    for (const uint32_t v : {from(e), to(faces_, e)}) fans.join(corner_at(e, v), corner_at(twin_[e], v));
  }
  sheets_.fan.resize(twin_.size());
  for (uint32_t corner = 0; corner < twin_.size(); ++corner) {
    poll_();
    sheets_.fan[corner] = fans.find(corner);
  }
}

/// A fan has one vertex, so faces that were parted at an edge meet there again where both its ends are in the same
/// fans. Two whose orientation agrees may: they are neighbours after all. Of others none keeps its neighbour across
/// that edge, and where that does not part them, all but one are taken out as faces of their own. True if there were
/// any.
bool Sheeting::part_what_meets_again() {
  const std::vector<uint8_t> at_cut = sheets_.at_cut;
  if (std::ranges::find(at_cut, 1) == at_cut.end()) return false;
  bool any = false;
  std::vector<std::tuple<uint32_t, uint32_t, uint32_t>> sides;  // the fans at both ends, half-edge
  edges_->for_each(poll_, [&](const VertexPair& edge, EdgeSides group) {
    if (group.size() < 2 || !at_cut[edge[0]] || !at_cut[edge[1]]) return;
    sides.clear();
    for (const auto& [high, e] : group) {
      sides.emplace_back(sheets_.fan[corner_at(e, edge[0])], sheets_.fan[corner_at(e, edge[1])], e);
    }
    std::ranges::sort(sides);
    std::vector<uint32_t> together;
    for (size_t i = 0; i < sides.size(); ++i) {
      const auto [low, high, e] = sides[i];
      together.push_back(e);
      if (i + 1 < sides.size() && std::get<0>(sides[i + 1]) == low && std::get<1>(sides[i + 1]) == high) continue;
      any = part(together) || any;
      together.clear();
    }
  });
  return any;
}

/// The same of half-edges between the same two fans.
bool Sheeting::part(std::span<const uint32_t> half_edges) {
  const uint32_t one = half_edges.front(), other = half_edges.back();
  const bool agreeing = (flipped_[one / 3] ^ flipped_[other / 3]) == (from(one) == from(other) ? 1 : 0);
  if (half_edges.size() < 2 || (half_edges.size() == 2 && (twin_[one] == other || agreeing))) return false;
  bool joined = false;
  for (const uint32_t e : half_edges) {
    joined = joined || twin_[e] != kNoTwin;
    unpair(e);
  }
  for (const uint32_t first : half_edges.subspan(joined ? half_edges.size() : 1)) {
    for (uint32_t e = 3 * (first / 3); e < 3 * (first / 3) + 3; ++e) {
      mark_cut(edge(e));
      unpair(e);
    }
  }
  return true;
}

}  // namespace

double turn_at_edge(std::span<const Vec3> positions, const VertexPair& edge, uint32_t c, uint32_t d) {
  const Vec3 &a = positions[edge[0]], &b = positions[edge[1]];
  const Vec3 along = (b - a).normalized();
  const auto away = [&](const Vec3& p) { return Vec3((p - a) - along.dot(p - a) * along).normalized(); };
  return std::round((1 + away(positions[c]).dot(away(positions[d]))) * kTurnResolution) / kTurnResolution;
}

Sheets find_sheets(Soup& soup, bool join_flattest) { return Sheeting(soup).find(join_flattest); }

std::vector<uint32_t> bow_ties(const Soup& soup, const Sheets& sheets) {
  std::vector<uint32_t> first(soup.positions().size(), kNoTwin), ties;
  CancelToken poll = soup.poll();
  for (uint32_t corner = 0; corner < sheets.fan.size(); ++corner) {
    poll();
    const uint32_t v = from(soup.faces(), corner);
    if (sheets.at_cut[v]) continue;
    if (first[v] == kNoTwin) first[v] = sheets.fan[corner];
    if (first[v] != sheets.fan[corner]) ties.push_back(v);
  }
  std::ranges::sort(ties);
  ties.erase(std::unique(ties.begin(), ties.end()), ties.end());
  return ties;
}

}  // namespace meander
