// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/far_share.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/point_tree.h"
#include "flow/constants.h"

namespace meander {
namespace {

/// Parts of a face are divided until they reach no farther from their middle, in r.
constexpr double kGrain = 0.7;

/// Places between two asks.
constexpr uint32_t kPlaces = 256;

/// Looks for places that are far from the nodes of a curve.
class FarPlaces {
 public:
  FarPlaces(const Domain& domain, const Curve& curve, ThreadPool& pool)
      : domain_(domain), s_(*domain.surface), tree_(positions(s_, curve), pool.poll(kPlaces)) {
    components_.reserve(curve.size());
    for (const SurfacePoint& p : curve.nodes) {
      components_.push_back(s_.component(p.face));
      if (domain.patches) patches_.push_back(domain.patches->patch_of(s_, p));
    }
  }

  /// The area of the part of a triangle in the plane of its face that is far.
  double area_in(uint32_t face, const std::array<Vec2, 3>& corners, CancelToken& poll) {
    poll();
    const Vec2 middle = (1.0 / 3) * (corners[0] + corners[1] + corners[2]);
    double reach = 0;
    for (const Vec2& corner : corners) reach = std::max(reach, norm(corner - middle));
    const SurfacePoint p = point_at(s_, face, middle);
    const double r = domain_.rest / domain_.correction * domain_.radius.at(s_, p), far = kFarFromNodes * r;
    const bool small = reach < kGrain * r;
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
  static std::vector<Vec3> positions(const Surface& s, const Curve& curve) {
    std::vector<Vec3> positions;
    positions.reserve(curve.size());
    for (const SurfacePoint& p : curve.nodes) positions.push_back(position(s, p));
    return positions;
  }
  static double length(const std::array<Vec2, 3>& corners, uint32_t k) {
    return norm(corners[(k + 1) % 3] - corners[k]);
  }

  /// Whether a node is nearer than `distance`, and not on another sheet.
  bool any_nearer(const SurfacePoint& p, double distance) {
    const Vec3 x = position(s_, p);
    const auto nearest = tree_.nearest(x, distance * distance);
    if (!nearest || !domain_.patches) return nearest.has_value();
    const uint32_t patch = domain_.patches->patch_of(s_, p), component = s_.component(p.face);
    if (is_seen(component, patch, nearest->index)) return true;
    tree_.within(x, distance * distance, found_);
    return std::ranges::any_of(found_, [&](uint32_t node) { return is_seen(component, patch, node); });
  }
  bool is_seen(uint32_t component, uint32_t patch, uint32_t node) const {
    return components_[node] == component && !domain_.patches->hidden(patch, patches_[node]) &&
           !domain_.patches->hidden(patches_[node], patch);
  }

  const Domain& domain_;
  const Surface& s_;
  PointTree tree_;
  std::vector<uint32_t> components_, patches_;  // per node
  std::vector<uint32_t> found_;
};

}  // namespace

double far_share(const Domain& domain, const Curve& curve, ThreadPool& pool) {
  const Surface& s = *domain.surface;
  FarPlaces places(domain, curve, pool);
  CancelToken poll = pool.poll(kPlaces);
  double area = 0;
  for (uint32_t f = 0; f < s.face_count(); ++f) {
    area += places.area_in(f, {s.corner(f, 0), s.corner(f, 1), s.corner(f, 2)}, poll);
  }
  return area / s.area();
}

}  // namespace meander
