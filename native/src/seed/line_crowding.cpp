// SPDX-License-Identifier: GPL-3.0-or-later
#include "seed/line_crowding.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "seed/constants.h"

namespace meander {
double LineCrowding::ahead(const LineNetwork::Node& p) const {
  return within(p, {spacing_.least * p.radius, spacing_.least_from_walls * p.radius, 0});
}

double LineCrowding::at_start(const LineNetwork::Node& p, double apart, double enough) const {
  return within(p, {kRoomToBegin * apart * p.radius, kRoomToBegin * spacing_.from_walls * p.radius, enough});
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
      limit = std::min(limits.apart, kFromItself * std::abs(other.arc - p.arc) * p.radius);
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
    if (v.dot(nearest) < kBothSides * v.norm() * here) opposite = std::min(opposite, v.norm());
  }
  const bool in_the_middle = here > kOffMiddle * (here + opposite);
  return in_the_middle ? 0 : limit - here;
}

}  // namespace meander
