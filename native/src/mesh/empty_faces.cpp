// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "base/disjoint_sets.h"
#include "base/eigen.h"
#include "mesh/constants.h"
#include "mesh/repairs.h"

namespace meander {
namespace {

using Vec3 = Soup::Vec3;

/// One pass over faces without area that do not touch each other.
class Dissolving {
 public:
  Dissolving(Soup& soup, PrepareCounts& counts)
      : soup_(soup), counts_(counts), edges_(soup.edges()), state_(soup.faces().size(), kFree),
        sets_(soup.positions().size()) {}

  void dissolve(const std::vector<uint32_t>& flat) {
    CancelToken poll = soup_.poll();
    for (const uint32_t f : flat) {
      poll();
      if (state_[f] == kFree) dissolve(f);
    }
    soup_.leave_out_where([&](uint32_t f) { return state_[f] == kGone; });
    counts_.dropped_faces += soup_.rename([&](uint32_t v) { return sets_.find(v); });
  }

 private:
  enum State : uint8_t { kFree, kTouched, kGone };

  void dissolve(uint32_t f) {
    const Triangle v = soup_.faces()[f];
    size_t longest = 0, shortest = 0;
    double length[3];
    for (size_t k = 0; k < 3; ++k) {
      length[k] = (at(v[(k + 1) % 3]) - at(v[k])).norm();
      if (length[k] > length[longest]) longest = k;
      if (length[k] < length[shortest]) shortest = k;
    }
    state_[f] = kTouched;
    if (length[shortest] <= kFlatForRepair * soup_.diagonal()) {
      counts_.merged_vertices += sets_.join(v[shortest], v[(shortest + 1) % 3]);
      return;
    }
    const VertexPair pair = pair_of(v[longest], v[(longest + 1) % 3]);
    const EdgeSides sides = edges_->of(pair);
    const uint32_t beyond = sides.size() == 2 ? sides[sides[0].half_edge / 3 == f ? 1 : 0].half_edge : kNoTwin;
    if (beyond != kNoTwin && state_[beyond / 3] != kFree) return;  // in the next pass
    state_[f] = kGone;
    ++counts_.dropped_faces;
    if (beyond != kNoTwin) divide(beyond, v[(longest + 2) % 3]);
  }

  /// The face of a half-edge becomes two, which meet in it at vertex c.
  void divide(uint32_t half_edge, uint32_t c) {
    const Soup::Face g = soup_.face(half_edge / 3);
    const Soup::WeightedVertex a = soup_.place(g, half_edge % 3), b = soup_.place(g, (half_edge % 3 + 1) % 3),
                      d = soup_.place(g, (half_edge % 3 + 2) % 3);
    if (d.vertex == c) return;  // the same three corners: one of the two is enough
    state_[half_edge / 3] = kTouched;
    const Vec3 edge = at(b.vertex) - at(a.vertex);
    const double t = std::clamp((at(c) - at(a.vertex)).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    const Soup::WeightedVertex middle = Soup::between(a, b, t, c);
    soup_.set_face(half_edge / 3, soup_.part(g, a, middle, d));
    soup_.add_face(soup_.part(g, middle, b, d));
    state_.push_back(kTouched);
  }

  const Vec3& at(uint32_t v) const { return soup_.positions()[v]; }

  Soup& soup_;
  PrepareCounts& counts_;
  std::shared_ptr<const EdgeGroups> edges_;  // of before
  std::vector<State> state_;                 // per face
  DisjointSets sets_;
};

}  // namespace

std::vector<uint32_t> faces_without_area(const Soup& soup, double share) {
  std::vector<uint32_t> flat;
  CancelToken poll = soup.poll();
  for (uint32_t f = 0; f < soup.faces().size(); ++f) {
    poll();
    const auto corner = [&](size_t k) -> const Vec3& { return soup.positions()[soup.faces()[f][k]]; };
    const Vec3 a = corner(1) - corner(0), b = corner(2) - corner(0);
    const double longest = std::max({a.norm(), b.norm(), (b - a).norm()});
    if (!(a.cross(b).norm() > share * soup.diagonal() * longest)) flat.push_back(f);
  }
  return flat;
}

void dissolve_faces_without_area(Soup& soup, PrepareCounts& counts) {
  counts.dropped_faces += soup.drop_collapsed();
  size_t before = SIZE_MAX;
  for (int pass = 0; pass < kMostDissolvingPasses; ++pass) {
    const std::vector<uint32_t> flat = faces_without_area(soup, kFlatForRepair);
    if (flat.empty()) return;
    // At the end of a circle of very many corners all divisions are flat.
    const bool is_stuck = flat.size() >= before;
    before = flat.size();
    if (!is_stuck || !collapse_flat_faces(soup, flat, counts)) Dissolving(soup, counts).dissolve(flat);
  }
}

void drop_faces_without_area(Soup& soup, PrepareCounts& counts) {
  counts.dropped_faces += soup.leave_out(faces_without_area(soup, kFlatForRepair));
}

std::vector<uint32_t> doubled_faces(Soup& soup) {
  std::vector<uint32_t> doubled;
  std::vector<std::pair<uint32_t, uint32_t>> tips;  // the highest vertex of a face, and the face
  soup.edges()->for_each(soup.poll(), [&](const VertexPair& edge, EdgeSides sides) {
    if (sides.size() < 2) return;
    tips.clear();
    for (const auto& side : sides) {
      const uint32_t tip = apex(soup.faces(), side.half_edge);
      if (tip > edge[1]) tips.emplace_back(tip, side.half_edge / 3);
    }
    std::ranges::sort(tips);
    for (size_t i = 1; i < tips.size(); ++i) {
      if (tips[i].first == tips[i - 1].first) doubled.push_back(tips[i].second);
    }
  });
  std::ranges::sort(doubled);
  return doubled;
}

void drop_doubled_faces(Soup& soup, PrepareCounts& counts) {
  const uint32_t dropped = soup.leave_out(doubled_faces(soup));
  counts.dropped_faces += dropped;
  counts.doubled_faces += dropped;
}

}  // namespace meander
