// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/sheets.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/disjoint_sets.h"

namespace meander {
namespace {

using Vec3 = Eigen::Vector3d;

/// A turn (turn_at_edge) from which on faces wound alike are taken for a sheet that lies on itself: their normals are
/// within 60 degrees of each other.
constexpr double kFolded = 1.5;

/// An edge, and a half-edge on it.
using EdgeSide = std::pair<VertexPair, uint32_t>;

/// Half-edges 3 f + k, from corner k of face f to the next.
class Sheeting {
 public:
  Sheeting(std::span<const Vec3> positions, std::span<const Triangle> faces)
      : positions_(positions), faces_(faces), twin_(3 * faces.size(), kNoTwin), flipped_(faces.size(), 0),
        at_cut_(positions.size(), 0) {}

  Sheets find(bool join_flattest) {
    pair_faces(join_flattest);
    open_one_sided();
    do {
      join_corners();
    } while (part_what_meets_again());
    name_bow_ties();
    return std::move(sheets_);
  }

 private:
  uint32_t from(uint32_t e) const { return faces_[e / 3][e % 3]; }
  uint32_t to(uint32_t e) const { return faces_[e / 3][(e % 3 + 1) % 3]; }
  uint32_t apex(uint32_t e) const { return faces_[e / 3][(e % 3 + 2) % 3]; }
  VertexPair edge(uint32_t e) const { return {std::min(from(e), to(e)), std::max(from(e), to(e))}; }
  /// The corner of the half-edge's face at one end of its edge.
  uint32_t corner_at(uint32_t e, uint32_t vertex) const {
    return from(e) == vertex ? e : 3 * (e / 3) + (e % 3 + 1) % 3;
  }

  void pair_faces(bool join_flattest);
  void pair_crowded(std::span<const EdgeSide> group, DisjointSets& parts);
  void open_one_sided();
  bool flood(uint32_t start, bool may_cut, std::vector<uint8_t>& seen, std::vector<uint32_t>& queue);
  void cut_folds(std::span<const uint32_t> faces);
  void open(uint32_t e);
  void join_corners();
  bool part_what_meets_again();
  void name_bow_ties();
  void unpair(uint32_t e) {
    if (twin_[e] == kNoTwin) return;
    twin_[twin_[e]] = kNoTwin;
    twin_[e] = kNoTwin;
  }
  void mark_cut(const VertexPair& edge) { at_cut_[edge[0]] = at_cut_[edge[1]] = 1; }

  std::span<const Vec3> positions_;
  std::span<const Triangle> faces_;
  std::vector<uint32_t> twin_;      // per half-edge
  std::vector<uint8_t> flipped_;    // per face: 1 if it is to be flipped for its sheet to agree
  std::vector<uint8_t> at_cut_;     // per vertex: at an edge that was cut
  Sheets sheets_;
};

void Sheeting::pair_faces(bool join_flattest) {
  std::vector<EdgeSide> sides;
  sides.reserve(twin_.size());
  for (uint32_t e = 0; e < twin_.size(); ++e) sides.emplace_back(edge(e), e);
  std::sort(sides.begin(), sides.end());
  std::vector<std::span<const EdgeSide>> crowded;
  DisjointSets parts(faces_.size());  // faces that are neighbours in any case
  for (size_t i = 0; i < sides.size();) {
    size_t j = i + 1;
    while (j < sides.size() && sides[j].first == sides[i].first) ++j;
    if (j - i == 2) {
      twin_[sides[i].second] = sides[i + 1].second;
      twin_[sides[i + 1].second] = sides[i].second;
      parts.join(sides[i].second / 3, sides[i + 1].second / 3);
    } else if (j - i > 2) {
      sheets_.crowded.push_back(sides[i].first);
      mark_cut(sides[i].first);
      crowded.push_back(std::span(sides).subspan(i, j - i));
    }
    i = j;
  }
  for (const auto& group : crowded) {
    if (join_flattest && group.size() <= kMostAtEdge) pair_crowded(group, parts);
  }
}

void Sheeting::pair_crowded(std::span<const EdgeSide> group, DisjointSets& parts) {
  // Disagreeing, of different parts, turn, half-edges.
  std::vector<std::tuple<bool, bool, double, uint32_t, uint32_t>> pairs;
  const Vec3 &a = positions_[group[0].first[0]], &b = positions_[group[0].first[1]];
  for (size_t i = 0; i < group.size(); ++i) {
    for (size_t j = i + 1; j < group.size(); ++j) {
      const uint32_t one = group[i].second, other = group[j].second;
      const bool apart = parts.find(one / 3) != parts.find(other / 3);
      const double turn = turn_at_edge(a, b, positions_[apex(one)], positions_[apex(other)]);
      pairs.emplace_back(from(one) == from(other), apart, turn, one, other);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  for (const auto& [disagreeing, apart, turn, one, other] : pairs) {
    if (twin_[one] != kNoTwin || twin_[other] != kNoTwin) continue;
    twin_[one] = other;
    twin_[other] = one;
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
    for (uint32_t e = 3 * f; e < 3 * f + 3; ++e) {
      const uint32_t twin = twin_[e];
      if (twin == kNoTwin || from(e) != from(twin)) continue;
      const double turn =
          turn_at_edge(positions_[from(e)], positions_[to(e)], positions_[apex(e)], positions_[apex(twin)]);
      if (turn >= kFolded) open(e);
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
    if (twin_[e] == kNoTwin || twin_[e] < e) continue;
    for (const uint32_t v : {from(e), to(e)}) fans.join(corner_at(e, v), corner_at(twin_[e], v));
  }
  sheets_.fan.resize(twin_.size());
  for (uint32_t corner = 0; corner < twin_.size(); ++corner) sheets_.fan[corner] = fans.find(corner);
}

/// A fan has one vertex, so faces that were parted at an edge meet there again where both its ends are in the same
/// fans. Two whose orientation agrees may: they are neighbours after all. Of others none keeps its neighbour across
/// that edge, and where that does not part them, all but one are taken out as faces of their own. True if there were
/// any.
bool Sheeting::part_what_meets_again() {
  struct SideOfPart {
    VertexPair edge, fans;
    uint32_t half_edge;
    auto key() const { return std::tie(edge, fans, half_edge); }
  };
  std::vector<SideOfPart> sides;
  for (uint32_t e = 0; e < twin_.size(); ++e) {
    const VertexPair pair = edge(e);
    if (!(at_cut_[pair[0]] && at_cut_[pair[1]])) continue;
    sides.push_back({pair, {sheets_.fan[corner_at(e, pair[0])], sheets_.fan[corner_at(e, pair[1])]}, e});
  }
  std::sort(sides.begin(), sides.end(), [](const SideOfPart& a, const SideOfPart& b) { return a.key() < b.key(); });
  bool any = false;
  for (size_t i = 0; i < sides.size();) {
    size_t j = i + 1;
    while (j < sides.size() && sides[j].edge == sides[i].edge && sides[j].fans == sides[i].fans) ++j;
    const uint32_t one = sides[i].half_edge, other = sides[j - 1].half_edge;
    const bool agreeing = j - i == 2 && (flipped_[one / 3] ^ flipped_[other / 3]) == (from(one) == from(other) ? 1 : 0);
    if (j - i > 2 || (j - i == 2 && twin_[one] != other && !agreeing)) {
      any = true;
      bool joined = false;
      for (size_t k = i; k < j; ++k) {
        joined = joined || twin_[sides[k].half_edge] != kNoTwin;
        unpair(sides[k].half_edge);
      }
      for (size_t k = i + 1; k < j && !joined; ++k) {
        const uint32_t f = sides[k].half_edge / 3;
        for (uint32_t e = 3 * f; e < 3 * f + 3; ++e) {
          mark_cut(edge(e));
          unpair(e);
        }
      }
    }
    i = j;
  }
  return any;
}

void Sheeting::name_bow_ties() {
  std::vector<uint32_t> first(positions_.size(), kNoTwin);
  for (uint32_t corner = 0; corner < twin_.size(); ++corner) {
    const uint32_t v = faces_[corner / 3][corner % 3];
    if (at_cut_[v]) continue;
    if (first[v] == kNoTwin) first[v] = sheets_.fan[corner];
    if (first[v] != sheets_.fan[corner]) sheets_.bow_ties.push_back(v);
  }
  std::sort(sheets_.bow_ties.begin(), sheets_.bow_ties.end());
  const auto end = std::unique(sheets_.bow_ties.begin(), sheets_.bow_ties.end());
  sheets_.bow_ties.erase(end, sheets_.bow_ties.end());
}

}  // namespace

double turn_at_edge(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 along = (b - a).normalized();
  const auto away = [&](const Vec3& p) { return Vec3((p - a) - along.dot(p - a) * along).normalized(); };
  constexpr double kResolution = 1e6;
  return std::round((1 + away(c).dot(away(d))) * kResolution) / kResolution;
}

Sheets find_sheets(std::span<const Vec3> positions, std::span<const Triangle> faces, bool join_flattest) {
  return Sheeting(positions, faces).find(join_flattest);
}

}  // namespace meander
