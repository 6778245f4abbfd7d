// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic/geodesic_trace.h"

#include <array>

#include "geodesic/constants.h"

namespace meander {

GeodesicWalk::GeodesicWalk(const Surface& surface, const SurfacePoint& start, Vec2 displacement)
    : surface_(surface), start_(start), direction_(unit(displacement)), wanted_(norm(displacement)) {
  if (!(wanted_ > 0)) {
    wanted_ = 0;
    ended_ = true;
    return;
  }
  // The corners seen from the start. Heights over the axis are sums of terms of one sign for the highest and
  // for the lowest corner, so that even a needle has one edge that runs upwards across the axis.
  const uint32_t f = start.face;
  const std::array<Vec2, 3> at{surface.corner(f, 0), surface.corner(f, 1), surface.corner(f, 2)};
  const std::array<double, 3> weight{start.weight(0), start.weight(1), start.weight(2)};
  const std::array<double, 3> height{cross(direction_, at[0]), cross(direction_, at[1]), cross(direction_, at[2])};
  const auto ahead = [&](uint32_t k, uint32_t i, uint32_t j) {
    return dot(direction_, weight[i] * (at[k] - at[i]) + weight[j] * (at[k] - at[j]));
  };
  const auto above = [&](uint32_t k, uint32_t i, uint32_t j) {
    return weight[i] * (height[k] - height[i]) + weight[j] * (height[k] - height[j]);
  };
  begin_in({ahead(0, 1, 2), ahead(1, 2, 0), ahead(2, 0, 1)}, {above(0, 1, 2), above(1, 2, 0), above(2, 0, 1)});
}

/// Lays the first face by its corners, x and y of each as the start sees them, and finds the edge that the walk leaves
/// it by. Without a branch, as walks go anywhere.
void GeodesicWalk::begin_in(const std::array<double, 3>& x, const std::array<double, 3>& y) {
  constexpr uint32_t kNoEdge = 3;
  static constexpr std::array<uint8_t, 8> kUpwards{kNoEdge, 0, 1, 1, 2, 0, 2, kNoEdge};  // by which corners are below
  const uint32_t k = kUpwards[(y[0] < 0 ? 1u : 0u) | (y[1] < 0 ? 2u : 0u) | (y[2] < 0 ? 4u : 0u)];
  ended_ = k == kNoEdge;
  if (ended_) return;
  const uint32_t left = next_corner(k), behind = prev_corner(k);
  face_.exit = 3 * start_.face + k;
  face_.ends[Unfolding::kRight] = {x[k], y[k]};
  face_.ends[Unfolding::kLeft] = {x[left], y[left]};
  face_.behind = {x[behind], y[behind]};
}

GeodesicWalk GeodesicWalk::other_way() const {
  if (face_.exit == kNone) return {surface_, start_, -wanted_ * direction_};
  GeodesicWalk other = *this;
  other.direction_ = -direction_;
  std::array<double, 3> x, y;
  const auto lay = [&](uint32_t k, Vec2 corner) {
    x[k] = -corner.x;
    y[k] = -corner.y;
  };
  const uint32_t k = corner_of(face_.exit);
  lay(k, face_.right());
  lay(next_corner(k), face_.left());
  lay(prev_corner(k), face_.behind);
  other.begin_in(x, y);
  return other;
}

bool GeodesicWalk::step() {
  if (ended_) return false;
  if (crossings_ > 0) {
    const Vec2 apex = face_.lay_next(surface_, entry_);
    face_.enter(entry_, apex, apex.y >= 0 ? 1 : 0);
  }
  // Does the axis meet the edge only beyond the end of the walk?
  const auto& [right, left] = face_.ends;
  ended_ = cross(right, left) >= wanted_ * (left.y - right.y) || crossings_ >= kMostFacesOfWalk;
  if (ended_) return false;
  entry_ = surface_.twin(face_.exit);
  ended_ = hit_boundary_ = entry_ == kNone;
  if (ended_) return false;
  ++crossings_;
  surface_.fetch_hinges(face_of(entry_));
  return true;
}

/// Where the axis meets the edge by which the walk leaves the face, as a share of the edge.
double GeodesicWalk::exit_at() const { return face_.right().y / (face_.right().y - face_.left().y); }

Crossing GeodesicWalk::crossing() const { return {face_.exit, entry_, clear_of_ends(exit_at())}; }

double GeodesicWalk::length() const {
  if (face_.exit == kNone) return 0;
  const auto& [right, left] = face_.ends;
  return hit_boundary_ ? cross(right, left) / (left.y - right.y) : wanted_;
}

SurfacePoint GeodesicWalk::end() const {
  if (face_.exit == kNone) return start_;
  const uint32_t k = corner_of(face_.exit);
  std::array<double, 3> w;
  if (hit_boundary_) {
    w[next_corner(k)] = exit_at();
    w[prev_corner(k)] = 0;
  } else {
    const auto& [right, left] = face_.ends;
    const Vec2 side = face_.behind - right, p = Vec2{wanted_, 0} - right, edge = left - right;
    const double area = cross(edge, side);
    w[next_corner(k)] = cross(p, side) / area;
    w[prev_corner(k)] = cross(edge, p) / area;
  }
  w[k] = 1 - w[next_corner(k)] - w[prev_corner(k)];
  return make_point(face_of(face_.exit), w[0], w[1], w[2]);
}

Vec2 GeodesicWalk::direction() const {
  if (face_.exit == kNone) return direction_;
  return unit(conj(face_.left() - face_.right()) * surface_.along(face_.exit));
}

Trace trace_geodesic(const Surface& surface, const SurfacePoint& start, Vec2 displacement,
                     std::vector<Crossing>& crossings) {
  GeodesicWalk walk(surface, start, displacement);
  while (walk.step()) crossings.push_back(walk.crossing());
  return {walk.end(), walk.direction(), walk.length(), walk.hit_boundary()};
}

}  // namespace meander
