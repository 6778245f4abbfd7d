// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/doubled_polygons.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "base/eigen.h"

#include "base/disjoint_sets.h"
#include "mesh/constants.h"
#include "mesh/divided_quads.h"
#include "mesh/repairs.h"
#include "mesh/shared_places.h"

namespace meander {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr uint32_t kNobody = UINT32_MAX;

class DoubleSearch {
 public:
  DoubleSearch(Soup& soup, std::span<const uint32_t> polygons)
      : soup_(soup), polygons_(polygons), poll_(soup.poll()), positions_(soup.positions()), faces_(soup.faces()),
        place_(shared_places(positions_, soup.used(), kOnePlace * soup.diagonal(), kDoublesCell, poll_)),
        patch_(faces_.size()) {}

  DoubledPolygons find(const Tell& tell) {
    const auto passed = [&](double share) {
      if (tell) tell(share);
    };
    passed(kDoublePlaces);
    find_edges();
    passed(kDoubleEdges);
    join_patches();
    sort_by_patch();
    passed(kDoublePatches);
    find_outlines();
    passed(kDoubleOutlines);
    find_copies();
    passed(kDoubleCopies);
    for (const Rule rule : {Rule::kAll, Rule::kWoundAlike}) leave_out(rule);
    return gone();
  }

 private:
  /// Which of the patches with one outline stay: the first one, or the first of either winding.
  enum class Rule { kAll, kWoundAlike };

  /// An edge of the outline of a patch.
  struct OutlineEdge {
    uint32_t patch, edge;
    bool forward;  ///< from the lower place to the higher one
  };
  struct Outline {
    std::span<const OutlineEdge> sides;
    uint32_t patch() const { return sides.front().patch; }
    /// Of outlines of the same edges: whether the patch is wound like the others that say so.
    bool forward() const { return sides.front().forward; }
  };
  /// A patch with an outline that others have too.
  struct Copy {
    uint32_t patch, set;  ///< sets are numbered from 0
    bool forward, goes = false, gone = false;
    uint32_t stays = kNobody;  ///< the copy that is kept in its place
  };

  uint32_t place(uint32_t corner) const { return place_[from(faces_, corner)]; }
  uint32_t polygon(uint32_t f) const { return polygons_.empty() ? soup_.source(f) : polygons_[soup_.source(f)]; }

  void find_edges();
  void join_patches();
  std::vector<uint8_t> join_polygons(DisjointSets& patches);
  void sort_by_patch();
  bool continue_each_other(uint32_t one, uint32_t other, const VertexPair& edge) const;
  bool in_one_plane(uint32_t one, uint32_t other, const VertexPair& edge) const;
  void find_outlines();
  void find_copies();
  bool same_shape(const Outline& first, const Outline& other);
  Vec3 normal_of(const Outline& outline, const Vec3& center) const;
  void leave_out(Rule rule);
  bool opens_a_surface(EdgeSides sides) const;
  std::vector<uint8_t> torn(DisjointSets& groups);
  DoubledPolygons gone();
  std::span<const uint32_t> faces_of(uint32_t patch) const {
    return {by_patch_.data() + first_[patch], by_patch_.data() + first_[patch + 1]};
  }
  template <class Visit>
  void for_each_edge(const Visit& visit) {
    uint32_t number = 0;
    edges_->for_each(poll_, [&](const VertexPair& edge, EdgeSides sides) { visit(number++, edge, sides); });
  }

  Soup& soup_;
  std::span<const uint32_t> polygons_;
  CancelToken poll_;
  std::span<const Vec3> positions_;
  std::span<const Triangle> faces_;
  std::vector<uint32_t> place_;      // per vertex
  std::vector<uint32_t> half_edges_; // of faces with three places
  std::optional<EdgeGroups> edges_;  // of these, between places
  std::vector<uint32_t> patch_;      // per face: the lowest one that it is a patch with
  std::vector<uint32_t> first_, by_patch_;
  std::vector<OutlineEdge> sides_;          // of all outlines, by patch
  std::vector<VertexPair> ends_;     // per edge
  std::vector<Copy> copies_;          // by set, and by patch
  std::vector<uint32_t> copy_of_;    // per patch, or kNobody
};

void DoubleSearch::find_edges() {
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    poll_();
    const uint32_t a = place(3 * f), b = place(3 * f + 1), c = place(3 * f + 2);
    if (a == b || b == c || c == a) continue;
    for (uint32_t k = 0; k < 3; ++k) half_edges_.push_back(3 * f + k);
  }
  const auto ends = [&](uint32_t i) {
    const VertexPair pair = edge(faces_, half_edges_[i]);
    return pair_of(place_[pair[0]], place_[pair[1]]);
  };
  edges_.emplace(half_edges_.size(), place_.size(), ends, soup_.pool());
}

void DoubleSearch::join_patches() {
  DisjointSets patches(faces_.size());
  const std::vector<uint8_t> is_quad = join_polygons(patches);
  for_each_edge([&](uint32_t, const VertexPair& edge, EdgeSides sides) {
    ends_.push_back(edge);
    if (sides.size() != 2) return;
    const uint32_t one = half_edges_[sides[0].half_edge], other = half_edges_[sides[1].half_edge];
    if (patches.find(one / 3) == patches.find(other / 3) || is_quad[one / 3] || is_quad[other / 3]) return;
    if (continue_each_other(one, other, edge) && in_one_plane(one, other, edge)) patches.join(one / 3, other / 3);
  });
  for (uint32_t f = 0; f < faces_.size(); ++f) patch_[f] = patches.find(f);
}

/// Joins polygons of more than two triangles, and quads that are there with both diagonals, whoever has divided them.
/// Returns per face whether it is in such a quad.
std::vector<uint8_t> DoubleSearch::join_polygons(DisjointSets& patches) {
  std::vector<uint32_t> order(faces_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, [&](uint32_t f, uint32_t g) { return poll_(), polygon(f) < polygon(g); });
  DividedQuads quads(place_, faces_);
  std::vector<uint8_t> is_triangle(faces_.size(), 0), is_quad(faces_.size(), 0);
  for (size_t i = 0, end = 0; i < order.size(); i = end) {
    while (end < order.size() && polygon(order[end]) == polygon(order[i])) ++end;
    if (end - i == 1) is_triangle[order[i]] = 1;
    if (end - i == 2) quads.add_polygon(order[i], order[i + 1]);
    for (size_t k = i + 1; k < end && end - i > 2; ++k) patches.join(order[i], order[k]);
  }
  for_each_edge([&](uint32_t, const VertexPair& edge, EdgeSides sides) {
    const uint32_t e = half_edges_[sides[0].half_edge];
    if (sides.size() != 2) return quads.add_edge_of_many(sides, half_edges_);
    const uint32_t o = half_edges_[sides[1].half_edge];
    if (is_triangle[e / 3] && is_triangle[o / 3] && continue_each_other(e, o, edge)) quads.add_pair(e, o);
  });
  for (const auto& [one, other] : quads.with_both_diagonals(poll_)) {
    patches.join(one, other);
    is_quad[one] = is_quad[other] = 1;
  }
  return is_quad;
}

void DoubleSearch::sort_by_patch() {
  first_.assign(faces_.size() + 1, 0);
  for (const uint32_t patch : patch_) ++first_[patch + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  by_patch_.resize(faces_.size());
  std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
  for (uint32_t f = 0; f < faces_.size(); ++f) by_patch_[next[patch_[f]]++] = f;
}

/// Do two faces lie on different sides of their edge?
bool DoubleSearch::continue_each_other(uint32_t one, uint32_t other, const VertexPair& edge) const {
  const Vec3 &a = positions_[edge[0]], &b = positions_[edge[1]];
  const Vec3 c = positions_[apex(faces_, one)] - a, d = positions_[apex(faces_, other)] - a;
  return (b - a).cross(c).dot((b - a).cross(d)) < 0;
}

bool DoubleSearch::in_one_plane(uint32_t one, uint32_t other, const VertexPair& edge) const {
  const Vec3 &a = positions_[edge[0]], &b = positions_[edge[1]];
  const Vec3 c = positions_[apex(faces_, one)] - a, d = positions_[apex(faces_, other)] - a;
  const Vec3 n = (b - a).cross(c), m = (b - a).cross(d);
  // The plane of the larger one.
  const double distance = n.squaredNorm() > m.squaredNorm() ? n.normalized().dot(d) : m.normalized().dot(c);
  return std::abs(distance) <= kOnePlace * soup_.diagonal();
}

/// An edge is one of the outline where an odd number of the patch's faces is at it.
void DoubleSearch::find_outlines() {
  std::vector<std::pair<uint32_t, bool>> at_edge;  // patch, and the direction in which a face goes there
  for_each_edge([&](uint32_t number, const VertexPair& edge, EdgeSides group) {
    at_edge.clear();
    for (const auto& side : group) {
      const uint32_t e = half_edges_[side.half_edge];
      at_edge.emplace_back(patch_[e / 3], place(e) == edge[0]);
    }
    std::ranges::sort(at_edge);
    for (size_t i = 0; i < at_edge.size();) {
      size_t end = i, forward = 0;
      for (; end < at_edge.size() && at_edge[end].first == at_edge[i].first; ++end) forward += at_edge[end].second;
      if ((end - i) % 2 == 1) sides_.push_back({at_edge[i].first, number, 2 * forward > end - i});
      i = end;
    }
  });
  const auto in_patches = [&](const OutlineEdge& a, const OutlineEdge& b) { return poll_(), a.patch < b.patch; };
  std::ranges::stable_sort(sides_, in_patches);
}

void DoubleSearch::find_copies() {
  std::vector<Outline> outlines;
  for (size_t i = 0; i < sides_.size();) {
    size_t end = i;
    while (end < sides_.size() && sides_[end].patch == sides_[i].patch) ++end;
    outlines.push_back({std::span(sides_).subspan(i, end - i)});
    i = end;
  }
  const auto compare = [](const Outline& a, const Outline& b) {
    return std::lexicographical_compare_three_way(
        a.sides.begin(), a.sides.end(), b.sides.begin(), b.sides.end(),
        [](const OutlineEdge& one, const OutlineEdge& other) { return one.edge <=> other.edge; });
  };
  std::ranges::stable_sort(outlines, [&](const Outline& a, const Outline& b) { return poll_(), compare(a, b) < 0; });
  copy_of_.assign(faces_.size(), kNobody);
  uint32_t set = 0;
  for (size_t i = 0; i < outlines.size();) {
    const Outline& first = outlines[i];
    size_t end = i + 1;
    const size_t before = copies_.size();
    for (; end < outlines.size() && compare(first, outlines[end]) == 0; ++end) {
      if (!same_shape(first, outlines[end])) continue;
      if (copies_.size() == before) copies_.push_back({first.patch(), set, first.forward()});
      copies_.push_back({outlines[end].patch(), set, outlines[end].forward()});
    }
    set += copies_.size() > before;
    i = end;
  }
  for (uint32_t t = 0; t < copies_.size(); ++t) copy_of_[copies_[t].patch] = t;
}

/// Are two patches with the same outline the same surface? Triangles are, quads, and polygons; what several of them
/// make is where all of it is in one plane.
bool DoubleSearch::same_shape(const Outline& first, const Outline& other) {
  const auto is_one = [&](const Outline& outline) {
    const auto faces = faces_of(outline.patch());
    if (outline.sides.size() == 4 && faces.size() == 2) return true;
    return std::ranges::all_of(faces, [&](uint32_t f) { return polygon(f) == polygon(faces[0]); });
  };
  if (is_one(first) && is_one(other)) return true;
  const Vec3 center = positions_[ends_[first.sides[0].edge][0]];
  const Vec3 normal = normal_of(first, center);
  const auto in_plane = [&](uint32_t f) {
    return std::ranges::all_of(faces_[f], [&](uint32_t v) {
      return std::abs(normal.dot(positions_[v] - center)) <= kOnePlace * soup_.diagonal();
    });
  };
  return std::ranges::all_of(faces_of(first.patch()), in_plane) &&
         std::ranges::all_of(faces_of(other.patch()), in_plane);
}

/// Newell's, from the edges of the outline in any order.
Vec3 DoubleSearch::normal_of(const Outline& outline, const Vec3& center) const {
  Vec3 sum = Vec3::Zero();
  for (const OutlineEdge& side : outline.sides) {
    const Vec3 a = positions_[ends_[side.edge][0]] - center, b = positions_[ends_[side.edge][1]] - center;
    sum += side.forward ? a.cross(b) : b.cross(a);
  }
  return sum.normalized();
}

/// Is a face that goes the only neighbour of one that stays, by their vertices?
bool DoubleSearch::opens_a_surface(EdgeSides sides) const {
  const auto copy_at = [&](uint32_t e) { return copy_of_[patch_[e / 3]]; };
  for (const auto& [high, i] : sides) {
    const uint32_t e = half_edges_[i], copy = copy_at(e);
    if (copy == kNobody || !copies_[copy].goes) continue;
    uint32_t neighbour = kNobody, count = 0;
    for (const auto& [other_high, k] : sides) {
      const uint32_t other = half_edges_[k];
      if (other == e || edge(faces_, other) != edge(faces_, e)) continue;
      if (copy_at(other) != kNobody && copies_[copy_at(other)].gone) continue;
      neighbour = copy_at(other);
      ++count;
    }
    const auto stays = [&](const Copy& other) { return !other.goes && other.set != copies_[copy].set; };
    if (count == 1 && (neighbour == kNobody || stays(copies_[neighbour]))) return true;
  }
  return false;
}

/// Twins go in groups of those side by side, each all or not at all.
void DoubleSearch::leave_out(Rule rule) {
  for (uint32_t t = 0, first = 0; t < copies_.size(); ++t) {
    Copy& copy = copies_[t];
    if (copies_[first].set != copy.set) first = t;
    if (copy.gone) continue;
    for (uint32_t s = first; s < t && !copy.goes; ++s) {
      if (copies_[s].gone || (rule == Rule::kWoundAlike && copies_[s].forward != copy.forward)) continue;
      copy.goes = true;
      copy.stays = s;
    }
  }
  DisjointSets groups(copies_.size());
  const std::vector<uint8_t> torn = this->torn(groups);
  for (uint32_t t = 0; t < copies_.size(); ++t) {
    Copy& copy = copies_[t];
    if (copy.goes && !torn[groups.find(t)]) copy.gone = true;
    copy.goes = false;
  }
}

/// Per group, by its name, whether its copies had better stay: where an odd number of an even one is left at an edge,
/// and a surface has lost its neighbour there, that would be open. A sheet with a free edge closes nothing; where it
/// meets a surface it is a fin of it.
std::vector<uint8_t> DoubleSearch::torn(DisjointSets& groups) {
  std::vector<uint8_t> opens(copies_.size(), 0), is_free(copies_.size(), 0);
  for_each_edge([&](uint32_t, const VertexPair&, EdgeSides sides) {
    uint32_t going = kNobody, here = 0, left = 0;
    for (const auto& side : sides) {
      const uint32_t copy = copy_of_[patch_[half_edges_[side.half_edge] / 3]];
      if (copy != kNobody && copies_[copy].gone) continue;
      ++here;
      if (copy == kNobody || !copies_[copy].goes) {
        ++left;
        continue;
      }
      if (going != kNobody) groups.join(going, copy);
      going = copy;
    }
    if (going == kNobody) return;
    if (left == 1) is_free[going] = 1;
    if (here % 2 == 0 && left % 2 == 1 && left > 1 && opens_a_surface(sides)) opens[going] = 1;
  });
  std::vector<uint8_t> torn(copies_.size(), 0), fin(copies_.size(), 0);
  for (uint32_t t = 0; t < copies_.size(); ++t) {
    if (opens[t]) torn[groups.find(t)] = 1;
    if (is_free[t]) fin[groups.find(t)] = 1;
  }
  for (uint32_t t = 0; t < copies_.size(); ++t) {
    if (fin[t]) torn[t] = 0;
  }
  return torn;
}

DoubledPolygons DoubleSearch::gone() {
  DoubledPolygons doubled;
  std::vector<uint32_t> at_place(place_.size(), kNobody);
  for (const Copy& copy : copies_) {
    if (!copy.gone) continue;
    const auto staying = faces_of(copies_[copy.stays].patch);
    for (const uint32_t f : staying) {
      for (const uint32_t v : faces_[f]) at_place[place_[v]] = std::min(at_place[place_[v]], v);
    }
    for (const uint32_t f : faces_of(copy.patch)) {
      doubled.faces.push_back(f);
      for (const uint32_t v : faces_[f]) {
        const uint32_t other = at_place[place_[v]];
        if (other != kNobody && other != v) doubled.vertices.emplace_back(v, other);
      }
    }
    for (const uint32_t f : staying) {
      for (const uint32_t v : faces_[f]) at_place[place_[v]] = kNobody;
    }
  }
  std::ranges::sort(doubled.faces);
  return doubled;
}

}  // namespace

DoubledPolygons find_doubled_polygons(Soup& soup, std::span<const uint32_t> polygons, const Tell& tell) {
  return DoubleSearch(soup, polygons).find(tell);
}

void drop_doubled_polygons(Soup& soup, std::span<const uint32_t> polygons, PrepareCounts& counts, const Tell& tell) {
  const DoubledPolygons doubled = find_doubled_polygons(soup, polygons, tell);
  const uint32_t dropped = soup.leave_out(doubled.faces);
  counts.dropped_faces += dropped;
  counts.doubled_faces += dropped;
  if (doubled.vertices.empty()) return;
  DisjointSets sets(soup.positions().size());
  for (const auto& [one, other] : doubled.vertices) sets.join(one, other);
  counts.dropped_faces += soup.rename([&](uint32_t v) { return sets.find(v); });
}

}  // namespace meander
