// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/line_crowding.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meander {
namespace {

/// A line comes no nearer to itself than by this share of the way along it: it may turn back, by three quarters of a
/// circle, but not wind round a limb that is thinner than a spacing. near_target along the surface on spot, in the
/// median of three orders of its faces, is .9895, .9845 with .45, and .9843 with .6.
constexpr double kOwn = 0.3;

/// And another begins where there is this much of the room that it is to have.
constexpr double kRoom = 0.97;

/// The boundary is on both sides of a place where two directions to it are so opposed (a cosine), and the place is in
/// the middle of a narrow strip where it is farther from the nearer side than this share of the width.
constexpr double kOpposite = -0.8, kFromMiddle = 0.3;

}  // namespace

double LineCrowding::ahead(const LineNetwork::Node& p) const {
  return within(p, {spacing_.least * p.radius, spacing_.least_from_walls * p.radius, 0});
}

double LineCrowding::at_start(const LineNetwork::Node& p, double apart, double enough) const {
  return within(p, {kRoom * apart * p.radius, kRoom * spacing_.from_walls * p.radius, enough});
}

double LineCrowding::within(const LineNetwork::Node& p, const Limits& limits) const {
  const double boundary = spacing_.from_boundary * p.radius;
  double most = 0;
  bool beside = false;
  std::vector<Vec3> beside_boundary;  // from the place to the boundary near it
  network_.near(p, std::max({limits.apart, limits.walls, 2 * boundary}), [&](uint32_t i, double distance) {
    const LineNetwork::Node& other = network_.nodes()[i];
    double limit = limits.apart;
    if (other.line == LineNetwork::kBoundary) {
      beside |= distance < boundary;
      if (distance < 2 * boundary) beside_boundary.push_back(other.place - p.place);
      return false;
    } else if (other.line == LineNetwork::kWall || other.line < trunks_) {
      limit = limits.walls;
    } else if (other.line == p.line) {
      limit = std::min(limits.apart, kOwn * std::abs(other.arc - p.arc) * p.radius);
    }
    most = std::max(most, limit - distance);
    return most > limits.enough;
  });
  if (!beside || most > limits.enough) return most;
  return std::max(most, of_boundary(beside_boundary, boundary));
}

/// The same of the boundary, which is to be as far as `limit` or, in a strip on whose both sides it is, and on the
/// other within twice that, no nearer than a share of its width: a line along the middle of it has room for itself,
/// also round a corner, where the outer side is farther.
double LineCrowding::of_boundary(const std::vector<Vec3>& beside, double limit) {
  const Vec3& nearest = *std::ranges::min_element(beside, {}, [](const Vec3& v) { return v.squaredNorm(); });
  const double here = nearest.norm();
  double opposite = std::numeric_limits<double>::infinity();
  for (const Vec3& v : beside) {
    if (v.dot(nearest) < kOpposite * v.norm() * here) opposite = std::min(opposite, v.norm());
  }
  const bool in_the_middle = here > kFromMiddle * (here + opposite);
  return in_the_middle ? 0 : limit - here;
}

}  // namespace meander
