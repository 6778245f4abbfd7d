// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "base/eigen.h"
#include "mesh/constants.h"
#include "mesh/repairs.h"

namespace meander {
namespace {

using Vec3 = Soup::Vec3;

/// One pass over flat faces whose surroundings do not touch each other.
class FlatCollapses {
 public:
  FlatCollapses(Soup& soup, std::span<const uint32_t> flat)
      : soup_(soup), least_(kFlatForRepair * soup.diagonal()), edges_(soup.edges()),
        is_flat_(soup.faces().size(), 0), taken_(soup.positions().size(), 0) {
    for (const uint32_t f : flat) is_flat_[f] = 1;
    find_faces_around();
  }

  uint32_t collapse(std::span<const uint32_t> flat) {
    CancelToken poll = soup_.poll();
    uint32_t count = 0;
    for (const uint32_t f : flat) {
      poll();
      count += collapse(f);
    }
    return count;
  }

 private:
  void find_faces_around() {
    first_.assign(soup_.positions().size() + 1, 0);
    for (const Triangle& t : soup_.faces()) {
      for (const uint32_t v : t) ++first_[v + 1];
    }
    for (size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    around_.resize(3 * soup_.faces().size());
    std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
    for (uint32_t f = 0; f < soup_.faces().size(); ++f) {
      for (const uint32_t v : soup_.faces()[f]) around_[next[v]++] = f;
    }
  }
  std::span<const uint32_t> around(uint32_t v) const {
    return std::span(around_).subspan(first_[v], first_[v + 1] - first_[v]);
  }
  const Vec3& at(uint32_t v) const { return soup_.positions()[v]; }

  /// The shortest edge that may go.
  bool collapse(uint32_t f) {
    const Triangle t = soup_.faces()[f];
    std::array<size_t, 3> order{0, 1, 2};
    const auto length = [&](size_t k) { return (at(t[(k + 1) % 3]) - at(t[k])).squaredNorm(); };
    std::ranges::stable_sort(order, [&](size_t j, size_t k) { return length(j) < length(k); });
    for (const size_t k : order) {
      const uint32_t a = t[k], b = t[(k + 1) % 3];
      if (is_taken(a) || is_taken(b)) continue;
      for (const auto& [goes, stays] : {VertexPair{std::max(a, b), std::min(a, b)}, pair_of(a, b)}) {
        if (!may_become(goes, stays)) continue;
        move(goes, stays);
        return true;
      }
    }
    return false;
  }

  /// Has something around it already changed in this pass?
  bool is_taken(uint32_t v) const {
    return std::ranges::any_of(around(v), [&](uint32_t f) {
      return std::ranges::any_of(soup_.faces()[f], [&](uint32_t w) { return taken_[w] != 0; });
    });
  }

  bool may_become(uint32_t goes, uint32_t stays) {
    find_neighbours(goes, beside_);
    find_neighbours(stays, beyond_);
    const size_t common = static_cast<size_t>(std::ranges::count_if(
        beside_, [&](uint32_t v) { return std::ranges::binary_search(beyond_, v); }));
    // Otherwise the surface would be pinched.
    if (common != edges_->of(pair_of(goes, stays)).size()) return false;
    return keeps_borders(goes, stays) && keeps_planes(goes, stays);
  }

  void find_neighbours(uint32_t v, std::vector<uint32_t>& found) const {
    found.clear();
    for (const uint32_t f : around(v)) {
      for (const uint32_t w : soup_.faces()[f]) {
        if (w != v) found.push_back(w);
      }
    }
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
  }

  /// A vertex of a border, or of an edge with many faces, goes along it, where it is straight.
  bool keeps_borders(uint32_t goes, uint32_t stays) const {
    const auto is_border = [&](uint32_t v) { return edges_->of(pair_of(goes, v)).size() != 2; };
    uint32_t other = stays;
    int count = 0;
    for (const uint32_t v : beside_) {
      if (!is_border(v)) continue;
      ++count;
      if (v != stays) other = v;
    }
    if (count == 0) return true;
    if (count != 2 || !is_border(stays)) return false;
    const Vec3 along = at(other) - at(stays), way = at(goes) - at(stays);
    const double length = along.norm(), share = way.dot(along);
    return length > 0 && share >= 0 && share <= length * length && way.cross(along).norm() <= least_ * length;
  }

  /// Does every face at the vertex stay in its plane, and on its side of it?
  bool keeps_planes(uint32_t goes, uint32_t stays) const {
    Vec3 sum = Vec3::Zero();
    for (const uint32_t f : around(goes)) {
      if (!is_flat_[f]) sum += normal(soup_.faces()[f]);
    }
    const Vec3 way = at(stays) - at(goes);
    for (const uint32_t f : around(goes)) {
      Triangle t = soup_.faces()[f];
      if (std::ranges::find(t, stays) != t.end()) continue;
      const Vec3 up = (is_flat_[f] ? sum : normal(t)).normalized();
      std::ranges::replace(t, goes, stays);
      const double height = normal(t).dot(up) / longest_side(t);
      if (is_flat_[f] ? height < -least_ : height <= least_ || std::abs(way.dot(up)) > 2 * least_) return false;
    }
    return true;
  }
  Vec3 normal(const Triangle& t) const { return (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])); }
  double longest_side(const Triangle& t) const {
    return std::max({(at(t[1]) - at(t[0])).norm(), (at(t[2]) - at(t[1])).norm(), (at(t[0]) - at(t[2])).norm()});
  }

  void move(uint32_t goes, uint32_t stays) {
    taken_[goes] = taken_[stays] = 1;
    for (const uint32_t f : around(goes)) {
      const Triangle& t = soup_.faces()[f];
      for (uint32_t k = 0; k < 3; ++k) {
        if (t[k] == goes) soup_.set_corner(3 * f + k, stays);
      }
    }
  }

  Soup& soup_;
  double least_;
  std::shared_ptr<const EdgeGroups> edges_;  // of before
  std::vector<uint8_t> is_flat_, taken_;     // per face, per vertex
  std::vector<uint32_t> first_, around_;     // faces at each vertex
  std::vector<uint32_t> beside_, beyond_;
};

}  // namespace

bool collapse_flat_faces(Soup& soup, std::span<const uint32_t> flat, PrepareCounts& counts) {
  const uint32_t merged = FlatCollapses(soup, flat).collapse(flat);
  counts.merged_vertices += merged;
  counts.dropped_faces += soup.drop_collapsed();
  return merged > 0;
}

}  // namespace meander
