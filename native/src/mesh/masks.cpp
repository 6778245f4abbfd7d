// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>

#include "mesh/constants.h"
#include "mesh/repairs.h"

namespace meander {
namespace {

/// Cuts faces along the edge of a mask; heights are those over its threshold.
class Clip {
 public:
  Clip(Soup& soup, std::span<const double> values, double threshold) : soup_(soup) {
    for (const double value : values) height_.push_back(value - threshold);
    find_sides();
  }

  void cut(PrepareCounts& counts) {
    CancelToken poll = soup_.poll();
    for (uint32_t f = 0; f < soup_.faces().size(); ++f) {
      poll();
      const Soup::Face face = soup_.face(f);
      size_t in = 0, out = 0;
      double sum = 0;  // where all three corners lie on the edge, the middle decides
      for (const uint32_t v : face.corners) {
        in += side_[v] == kIn;
        out += side_[v] == kOut;
        sum += height_[v];
      }
      if (out == 0 && (in > 0 || sum >= 0)) {
        kept_.push_back(face);
        continue;
      }
      for (const uint32_t v : face.corners) soup_.at_mask()[v] = 1;
      ++(in == 0 ? counts.masked_faces : counts.clipped_faces);
      if (in > 0) cut_face(face);
    }
    soup_.set_faces(kept_);
  }

 private:
  enum SideOfMask : uint8_t { kOut, kOn, kIn };

  /// On which side of the mask's edge every vertex lies. A vertex that the edge passes closely is taken to lie on it;
  /// its neighbours are then cut there.
  void find_sides() {
    for (const double h : height_) side_.push_back(h > 0 ? kIn : (h < 0 ? kOut : kOn));
    const std::vector<SideOfMask> before = side_;
    for (const Triangle& face : soup_.faces()) {
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t a = face[k], b = face[(k + 1) % 3];
        if (before[a] == kOn || before[b] == kOn || before[a] == before[b]) continue;
        const double t = height_[a] / (height_[a] - height_[b]);
        if (t < kSnapToVertex) side_[a] = kOn;
        if (t > 1 - kSnapToVertex) side_[b] = kOn;
      }
    }
  }

  /// The vertex at which the mask's edge cuts an edge.
  uint32_t cut_edge(const VertexPair& edge) {
    const auto [low, high] = edge;
    const auto next = static_cast<uint32_t>(soup_.positions().size());
    const auto [found, is_new] = cuts_.try_emplace(edge, next);
    if (is_new) {
      const double t = height_[low] / (height_[low] - height_[high]);
      const Soup::Vec3 &a = soup_.positions()[low], &b = soup_.positions()[high];
      soup_.add_vertex(a + t * (b - a), {low, high, t});
      soup_.at_mask()[next] = 1;
    }
    return found->second;
  }

  /// Keeps what is left of a face, corner by corner: a triangle, or a quadrangle where two corners are in.
  void cut_face(const Soup::Face& face) {
    std::vector<Soup::WeightedVertex> ring;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = face.corners[k], b = face.corners[(k + 1) % 3];
      const Soup::WeightedVertex here = soup_.place(face, k), next = soup_.place(face, (k + 1) % 3);
      if (side_[a] != kOut) ring.push_back(here);
      if (side_[a] == kOn || side_[b] == kOn || side_[a] == side_[b]) continue;
      const double t = height_[a] / (height_[a] - height_[b]);
      ring.push_back(Soup::between(here, next, t, cut_edge(pair_of(a, b))));
    }
    const auto keep = [&](size_t i, size_t j, size_t k) {
      kept_.push_back(soup_.part(face, ring[i], ring[j], ring[k]));
    };
    if (ring.size() == 3) return keep(0, 1, 2);
    // The shorter diagonal; not quite, so that rounding does not decide between equal ones.
    const auto diagonal = [&](size_t i, size_t j) {
      return (soup_.positions()[ring[j].vertex] - soup_.positions()[ring[i].vertex]).norm();
    };
    if (diagonal(0, 2) <= 1.001 * diagonal(1, 3)) {
      keep(0, 1, 2);
      keep(0, 2, 3);
    } else {
      keep(1, 2, 3);
      keep(1, 3, 0);
    }
  }

  Soup& soup_;
  std::vector<double> height_;                    // per vertex
  std::vector<SideOfMask> side_;                        // per vertex
  std::map<VertexPair, uint32_t> cuts_;          // the vertex on an edge
  std::vector<Soup::Face> kept_;
};

}  // namespace

void mask_faces(Soup& soup, std::span<const uint8_t> mask, PrepareCounts& counts) {
  counts.masked_faces += soup.leave_out_where([&](uint32_t f) {
    if (mask[soup.source(f)]) return false;
    for (const uint32_t v : soup.faces()[f]) soup.at_mask()[v] = 1;
    return true;
  });
}

void clip(Soup& soup, std::span<const double> values, double threshold, PrepareCounts& counts) {
  Clip(soup, values, threshold).cut(counts);
}

}  // namespace meander
