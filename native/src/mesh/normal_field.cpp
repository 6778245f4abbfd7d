// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/normal_field.h"

#include <algorithm>
#include <cmath>

namespace meander {
namespace {

/// Averaging passes over the one-ring; a pass spreads by about one edge length.
constexpr double kMostPasses = 40;

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const double n = v.norm();
  return n > 0 ? Vec3(v / n) : otherwise;
}

}  // namespace

void NormalField::find(CancelPoll& poll) const {
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
  const int passes = static_cast<int>(std::min(kMostPasses, std::floor(edges * edges)));
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

void NormalField::prepare(CancelPoll poll) const {
  std::call_once(found_, [&] { find(poll); });
}

Vec3 NormalField::blended(uint32_t f, double w0, double w1, double w2) const {
  prepare();
  const Triangle& t = surface_.face(f);
  return unit_or(w0 * normals_[t[0]] + w1 * normals_[t[1]] + w2 * normals_[t[2]], surface_.face_normal(f));
}

}  // namespace meander
