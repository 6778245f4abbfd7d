// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/normal_field.h"

#include <algorithm>
#include <cmath>

#include "mesh/constants.h"

namespace meander {
namespace {

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const double n = v.norm();
  return n > 0 ? Vec3(v / n) : otherwise;
}

}  // namespace

void NormalField::find(CancelToken& poll) const {
  const Surface& surface = surface_;
  normals_.assign(surface.vertex_count(), Vec3::Zero());
  for (uint32_t f = 0; f < surface.face_count(); ++f) {
    poll();
    for (uint32_t k = 0; k < 3; ++k) {
      normals_[surface.face(f)[k]] += surface.corner_angle(f, k) * surface.face_normal(f);
    }
  }
  for (Vec3& n : normals_) n = unit_or(n, Vec3::Zero());

  const double edges = 0.5 * radius_ / surface.mean_edge_length();
  const int passes = static_cast<int>(std::min(kMostNormalPasses, std::floor(edges * edges)));
  for (int pass = 0; pass < passes; ++pass) {
    std::vector<Vec3> sum(normals_);
    for (uint32_t f = 0; f < surface.face_count(); ++f) {
      poll();
      const Triangle& t = surface.face(f);
      const Vec3 all = normals_[t[0]] + normals_[t[1]] + normals_[t[2]];
      // Each neighbour is in two of the faces, so it counts half each time.
      for (uint32_t k = 0; k < 3; ++k) sum[t[k]] += 0.5 * (all - normals_[t[k]]);
    }
    for (size_t v = 0; v < sum.size(); ++v) normals_[v] = unit_or(sum[v], normals_[v]);
  }
}

void NormalField::prepare(CancelToken poll) const {
  std::call_once(found_, [&] { find(poll); });
}

Vec3 NormalField::blended(uint32_t f, double w0, double w1, double w2) const {
  prepare();
  const std::array<double, 3> w{w0, w1, w2};
  const Triangle& t = surface_.face(f);
  const Vec3& flat = surface_.face_normal(f);
  const Vec3 smooth = unit_or(w0 * normals_[t[0]] + w1 * normals_[t[1]] + w2 * normals_[t[2]], flat);
  const double upright = std::min({normals_[t[0]].dot(flat), normals_[t[1]].dot(flat), normals_[t[2]].dot(flat)});
  const double creased = std::clamp((kSmoothCorner - upright) / (kSmoothCorner - kCreasedCorner), 0.0, 1.0);
  if (creased == 0) return smooth;
  return unit_or(creased * beside_creases(f, w, smooth) + (1 - creased) * smooth, flat);
}

Vec3 NormalField::beside_creases(uint32_t f, const std::array<double, 3>& w, const Vec3& smooth) const {
  const Triangle& t = surface_.face(f);
  const Vec3& flat = surface_.face_normal(f);
  // Of edge k, opposite to corner k: how far it is, as a share of the reach, and the normal on it.
  std::array<double, 3> away;
  std::array<Vec3, 3> folded;
  for (uint32_t k = 0; k < 3; ++k) {
    const HalfEdge edge = 3 * f + next_corner(k);
    const HalfEdge twin = surface_.twin(edge);
    const double height = 2 * surface_.face_area(f) / norm(surface_.along(edge));
    away[k] = std::clamp(w[k] * height / (kNormalReach * radius_), 0.0, 1.0);
    folded[k] = twin == kNone ? flat : unit_or(flat + surface_.face_normal(face_of(twin)), flat);
  }
  Vec3 sum = away[0] * away[1] * away[2] * flat;
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t i = next_corner(k), j = next_corner(i);
    sum += (1 - away[k]) * away[i] * away[j] * folded[k];
    sum += away[k] * (1 - away[i]) * (1 - away[j]) * normals_[t[k]];
  }
  sum += (1 - away[0]) * (1 - away[1]) * (1 - away[2]) * smooth;
  return unit_or(sum, flat);
}

}  // namespace meander
