// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/far_share.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/point_tree.h"
#include "flow/constants.h"

namespace meander {
namespace {

/// Places between two asks.
constexpr uint32_t kPlacesPerPoll = 256;

/// Looks for places that are far from the nodes of a curve.
class FarPlaces {
 public:
  FarPlaces(const Domain& domain, const Curve& curve, ThreadPool& pool)
      : domain_(domain), s_(*domain.surface), tree_(positions(s_, curve, pool), pool.poll(kPlacesPerPoll)),
        components_(curve.size()), patches_(domain.patches ? curve.size() : 0) {
    pool.for_each(curve.size(), kNodeGrain, [&](uint32_t i) {
      const SurfacePoint& p = curve.nodes[i];
      components_[i] = s_.component(p.face);
      if (domain.patches) patches_[i] = domain.patches->patch_of(s_, p);
    });
  }

  /// The area of the part of a triangle in the plane of its face that is far. Any number of threads may ask.
  double area_in(uint32_t face, const std::array<Vec2, 3>& corners, CancelToken& poll) const {
    poll();
    const Vec2 middle = (1.0 / 3) * (corners[0] + corners[1] + corners[2]);
    double reach = 0;
    for (const Vec2& corner : corners) reach = std::max(reach, norm(corner - middle));
    const SurfacePoint p = point_at(s_, face, middle);
    const double r = domain_.rest / domain_.correction * domain_.radius.at(s_, p), far = kFarFromNodes * r;
    const bool small = reach < kFarGrain * r;
    // What is so near to a node that all of the triangle is near to it need not be divided.
    if (small || reach < far) {
      if (any_nearer(p, small ? far : far - reach)) return 0;
      if (small) return 0.5 * std::abs(cross(corners[1] - corners[0], corners[2] - corners[0]));
    }
    uint32_t longest = 0;
    for (uint32_t k = 1; k < 3; ++k) {
      if (length(corners, k) > length(corners, longest)) longest = k;
    }
    const Vec2 a = corners[longest], b = corners[(longest + 1) % 3], c = corners[(longest + 2) % 3];
    const Vec2 between = 0.5 * (a + b);
    return area_in(face, {a, between, c}, poll) + area_in(face, {between, b, c}, poll);
  }

 private:
  static std::vector<Vec3> positions(const Surface& s, const Curve& curve, ThreadPool& pool) {
    std::vector<Vec3> positions(curve.size());
    pool.for_each(curve.size(), kNodeGrain, [&](uint32_t i) { positions[i] = position(s, curve.nodes[i]); });
    return positions;
  }
  static double length(const std::array<Vec2, 3>& corners, uint32_t k) {
    return norm(corners[(k + 1) % 3] - corners[k]);
  }

  /// Whether a node is nearer than `distance`, and not on another sheet.
  bool any_nearer(const SurfacePoint& p, double distance) const {
    const Vec3 x = position(s_, p);
    const auto nearest = tree_.nearest(x, distance * distance);
    if (!nearest || !domain_.patches) return nearest.has_value();
    const uint32_t patch = domain_.patches->patch_of(s_, p), component = s_.component(p.face);
    if (is_seen(component, patch, nearest->index)) return true;
    std::vector<uint32_t> found;
    tree_.within(x, distance * distance, found);
    return std::ranges::any_of(found, [&](uint32_t node) { return is_seen(component, patch, node); });
  }
  bool is_seen(uint32_t component, uint32_t patch, uint32_t node) const {
    return components_[node] == component && !domain_.patches->hidden(patch, patches_[node]) &&
           !domain_.patches->hidden(patches_[node], patch);
  }

  const Domain& domain_;
  const Surface& s_;
  PointTree tree_;
  std::vector<uint32_t> components_, patches_;  // per node
};

}  // namespace

double far_share(const Domain& domain, const Curve& curve, ThreadPool& pool) {
  const Surface& s = *domain.surface;
  const FarPlaces places(domain, curve, pool);
  std::vector<double> areas(s.face_count());
  constexpr size_t kFaces = 16;
  pool.for_blocks(s.face_count(), kFaces, [&](size_t, size_t begin, size_t end) {
    CancelToken poll = pool.poll(kPlacesPerPoll);
    for (auto f = static_cast<uint32_t>(begin); f < end; ++f) {
      areas[f] = places.area_in(f, {s.corner(f, 0), s.corner(f, 1), s.corner(f, 2)}, poll);
    }
  });
  return std::accumulate(areas.begin(), areas.end(), 0.0) / s.area();
}

}  // namespace meander
